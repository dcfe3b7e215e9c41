#include <CGAL/Crude_registration.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Camera = CGAL::Crude_registration::Range_camera<Kernel>;
namespace CR = CGAL::Crude_registration;

// Registers two simulated scans of one body, and compares the answer with the truth.
int main()
{
  CGAL::Surface_mesh<Kernel::Point_3> statue;
  CR::make_statue(statue, 96, CR::parameters::random_seed(1));
  const CR::Simulated_scene scene(statue);
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(statue);

  Camera camera = Camera::framing(box, Kernel::Vector_3(-1, 0, -0.2), 300);
  camera.noise = 0.1;
  const auto source = scene.range_image(camera);
  camera = Camera::framing(box, Kernel::Vector_3(-1, -1, -0.2), 300);
  camera.noise = 0.1;
  camera.seed = 1;
  const auto target = scene.range_image(camera);

  const CR::Scan<Kernel> a(source.image), b(target.image);
  const auto result = CR::register_scans(a, b);
  std::cout << result.status() << ", overlap " << result.overlap() << '\n'
            << "found: " << result.transformation() << '\n'
            << "true:  " << target.scene_from_scan.inverse() * source.scene_from_scan << '\n';
  return result.status() == CR::REGISTERED ? EXIT_SUCCESS : EXIT_FAILURE;
}
