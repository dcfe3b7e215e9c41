#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <iostream>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;

int main()
{
  CGAL::Surface_mesh<Kernel::Point_3> statue;
  CR::make_statue(statue, 16);
  const auto camera =
      CR::Range_camera<Kernel>::framing(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), Kernel::Vector_3(1, 0, 0), 32);
  const auto scan = CR::simulate_range_image(statue, camera);
  std::cout << scan.image.points().size() << " samples\n";
  return scan.image.points().empty() ? 1 : 0;
}
