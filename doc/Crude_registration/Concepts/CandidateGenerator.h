/*!
\ingroup PkgCrudeRegistrationConcepts
\cgalConcept

The concept `CandidateGenerator` describes the second step of a registration: the way to propose motions for two scans.
A generator is given to `CGAL::Crude_registration::register_meshes()`, to
`CGAL::Crude_registration::register_scans()` and to the constructors of `CGAL::Crude_registration::Scan` as the named
parameter `candidates`; the functions keep a copy of it.

A generator only says which motions are worth a look. Whatever it proposes is judged, refined and concluded upon in the
same way: a generator that proposes nonsense makes the answer `NOT_REGISTERED`, not a wrong one.

\cgalHeading{Direction and Frames}

The registration asks for motions of either scan to the other one: it may exchange the two, so that the smaller one is
looked for in the larger one, and turns the answer round itself. A generator has to be able to propose motions in both
directions, and always proposes those that map its first argument into the frame of its second one. Frames and the unit
of length are those of what the scans were made from.

\cgalHeading{Determinism}

The answer of a registration depends on nothing but the scans and the parameters as long as this is true of what the
generator proposes: neither on time, addresses, the number of threads nor the order of a hash table.

\cgalRefines `CopyConstructible`

\cgalHasModel `CGAL::Crude_registration::Oriented_pair_candidates`
\cgalHasModel `CGAL::Crude_registration::Trihedron_candidates`

\sa `CandidateRounds`
\sa `RegistrationVisitor`
*/
class CandidateGenerator
{
public:
  /// \name Operations
  /// @{

  /*!
  starts to propose motions of `source` to `target`.

  Both scans outlive what is returned, which may keep them by reference; the generator may not.

  \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`: whether
          more than one thread may be used
  \tparam Kernel the kernel of the scans

  \return a model of `CandidateRounds` for `Kernel`

  \throws std::invalid_argument where a scan lacks what the generator needs; this and all else that is thrown is passed
          on to the caller of the registration
  */
  template <class ConcurrencyTag, class Kernel>
  unspecified_type rounds(const CGAL::Crude_registration::Scan<Kernel>& source,
                          const CGAL::Crude_registration::Scan<Kernel>& target) const;

  /// @}
};
