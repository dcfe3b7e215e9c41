// Any bytes as a PLY file with a range grid: an image, or an IO_error. What was read is written and read again.

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/Simple_cartesian.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace CR = CGAL::Crude_registration;
using Image = CR::Range_image<CGAL::Simple_cartesian<double>>;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::istringstream in(std::string(data, data + size));
  Image image;
  try {
    CR::read_range_image(in, image);
  } catch (const CR::IO_error&) {
    return 0;
  }
  std::stringstream file;
  CR::write_range_image(file, image);
  Image again;
  CR::read_range_image(file, again);
  if (image.points() != again.points() || image.grid() != again.grid() || image.columns() != again.columns())
    std::abort();
  return 0;
}
