// Registers two simulated scans and writes the motion, to the last bit, to a file: consumer FILE

#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <fstream>
#include <iostream>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "consumer FILE\n";
    return 1;
  }
  CGAL::Surface_mesh<Kernel::Point_3> statue;
  CR::make_statue(statue, 48);
  const auto scan = [&](double angle) {
    const auto camera = CR::Range_camera<Kernel>::framing(
        CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), Kernel::Vector_3(-std::cos(angle), -std::sin(angle), -0.2), 120);
    return CR::Scan<Kernel>(CR::simulate_range_image(statue, camera).image);
  };
  const auto result = CR::register_scans<CGAL::Parallel_if_available_tag>(scan(0), scan(0.6));
  std::cout << result.status() << ' ' << result.reason() << '\n';
  if (result.status() != CR::REGISTERED) return 1;
  std::ofstream out(argv[1]);
  out << std::hexfloat << result.confidence() << '\n';
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) out << result.transformation().m(i, j) << (j < 3 ? ' ' : '\n');
  return out ? 0 : 1;
}
