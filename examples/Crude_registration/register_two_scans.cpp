#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/triangulate_scan.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh.h>

#include <iostream>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Moves the scan of the first file into the frame of the second one's: a PLY file with the name of the third argument.
int main(int argc, char* argv[])
{
  if (argc != 4) return 1;
  const auto source = CR::read_scan<Kernel>(argv[1]), target = CR::read_scan<Kernel>(argv[2]); // files of any kind
  const auto result = CR::register_scans(CR::Scan<Kernel>(source), CR::Scan<Kernel>(target));  // no parameter is needed
  std::cout << result.status() << ", confidence " << result.confidence() << ' ' << result.reason() << '\n';
  if (result.status() != CR::REGISTERED) return 1;

  CGAL::Surface_mesh<Kernel::Point_3> moved = CR::triangulate_scan(source);
  CGAL::Polygon_mesh_processing::transform(result.transformation(), moved); // now in the target's frame
  return CGAL::IO::write_PLY(argv[3], moved) ? 0 : 1;
}
