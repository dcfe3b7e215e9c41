#include <CGAL/Crude_registration.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace CR = CGAL::Crude_registration;

// Moves the mesh of the first file into the frame of the second one's, in the third file.
int main(int argc, char* argv[])
{
  Mesh source, target;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], source) || !CGAL::IO::read_polygon_mesh(argv[2], target))
    return EXIT_FAILURE;

  const auto result = CR::register_meshes(source, target); // no parameter is needed
  std::cout << result.status() << ", confidence " << result.confidence() << ' ' << result.reason() << '\n';
  if (result.status() != CR::REGISTERED) return EXIT_FAILURE;

  CGAL::Polygon_mesh_processing::transform(result.transformation(), source);
  return CGAL::IO::write_polygon_mesh(argv[3], source) ? EXIT_SUCCESS : EXIT_FAILURE;
}
