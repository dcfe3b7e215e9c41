#include <CGAL/Crude_registration/IO/apply_motion.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Writes the first file anew, moved into the frame of the second one's scan: by the name of the third argument.
int main(int argc, char* argv[])
{
  if (argc != 4) return 1;
  const auto source = CR::read_scan<Kernel>(argv[1]), target = CR::read_scan<Kernel>(argv[2]); // files of any kind
  const auto result = CR::register_scans(CR::Scan<Kernel>(source), CR::Scan<Kernel>(target));  // no parameter is needed
  std::cout << result.status() << ", confidence " << result.confidence() << ' ' << result.reason() << '\n';
  if (result.status() != CR::REGISTERED) return 1;
  CR::apply_motion(argv[1], argv[3], result.transformation()); // with its colours and all else that is in it
}
