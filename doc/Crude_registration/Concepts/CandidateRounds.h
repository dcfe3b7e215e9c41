/*!
\ingroup PkgCrudeRegistrationConcepts
\cgalConcept

The concept `CandidateRounds` describes what `CandidateGenerator::rounds()` returns: motions of one scan to another one
that may be right, in rounds. A next round is asked for as long as no motion is certain. Rounds best go from what is
quickly found for most scans to what is found with more work for the others.

\cgalRefines `MoveConstructible`

\cgalHasModel the type that `CGAL::Crude_registration::Oriented_pair_candidates::rounds()` returns
\cgalHasModel the type that `CGAL::Crude_registration::Trihedron_candidates::rounds()` returns

\sa `CandidateGenerator`
*/
class CandidateRounds
{
public:
  /// \name Operations
  /// @{

  /*!
  proposes the motions of the next round, best first.

  Each motion is rigid, without a reflection, and maps the source into the frame of the target, in the frames of what
  the scans were made from. None has to be exact: the judge refines every motion by some steps, which bring it to the
  place when it is off by about the distance of neighbouring points of
  `CGAL::Crude_registration::Scan::points()`. It looks closely at the 16 of a round that are best then, no more than
  three of which are of the same place; repetitions cost time and nothing else. A round may be empty.

  \param go_on may be called at any time and by any thread. Where it says `false`, the run has been ended, by its time
         budget or its visitor: what is returned is then of no use, and is best returned at once. Work of more than some
         hundredths of a second has to ask now and then, as nothing else can end it.
  */
  std::vector<CGAL::Aff_transformation_3<Kernel>> operator()(const std::function<bool()>& go_on);

  /*!
  returns whether there are no more rounds. The motions of the round that was the last one are judged like those of any
  other; where this is `true` before the first round, nothing is proposed.
  */
  bool is_done() const;

  /// @}
};
