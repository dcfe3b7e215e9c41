/*!
\ingroup PkgCrudeRegistrationConcepts
\cgalConcept

The concept `RegistrationVisitor` describes what is told how far a registration is, and may end it. A visitor is given to
`CGAL::Crude_registration::register_meshes()`, `CGAL::Crude_registration::register_scans()` and the constructors of
`CGAL::Crude_registration::Scan` as the named parameter `visitor`: as it is, of which the function keeps a copy, or in a
`std::reference_wrapper`, where its state is to be read afterwards.

Both members are called in turn, about once a millisecond, and by the thread alone that called the function. What they
throw ends the run and is passed on to its caller. A visitor that never ends a run has no influence on the answer.

\cgalRefines `CopyConstructible`
*/
class RegistrationVisitor
{
public:
  /// \name Operations
  /// @{

  /// is told the share of the work that is done at most, from 0 to 1. It does not get less within one run. A run whose
  /// first round of candidates makes a motion certain ends long before it is 1; a generator of your own says nothing
  /// about its work, and leaves it at 0.
  void progress(double share);

  /// says whether the run is to go on. After `false` the visitor is not called again, and the run returns within a tenth
  /// of a second: the registration with the best motion so far, which is then never `REGISTERED`, the constructors of
  /// `Scan` by `Preparation_interrupted`.
  bool go_further();

  /// @}
};
