// What reads any bytes, of which each function is a target: compiled once, as they share the readers.

#include "readers.h"

#include <CGAL/Crude_registration/IO/apply_motion.h>
#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Image = CR::Range_image<Kernel>;
using Scan = CR::Scan_file<Kernel>;

namespace {

// In memory where there is such a place; one file a process.
const std::string& file_name(const char* extension)
{
  static const std::string folder = std::filesystem::is_directory("/dev/shm")
                                        ? std::string("/dev/shm")
                                        : std::filesystem::temp_directory_path().string();
  static std::string name;
  name = folder + "/crude_registration_fuzz_" + std::to_string(getpid()) + extension;
  return name;
}

bool is_finite(const Kernel::Point_3& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

} // namespace

int run_read_range_image(const std::uint8_t* data, std::size_t size)
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

int run_read_scan(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  constexpr std::array<const char*, 15> extensions = {".ply", ".off", ".obj", ".stl", ".ptx",    ".xyz", ".csv", ".ts",
                                                      ".pcd", ".npy", ".las", ".png", ".xyz.gz", ".glb", ".gltf"};
  const std::string& name = file_name(extensions[data[0] % extensions.size()]);
  {
    std::ofstream out(name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(data + 1), std::streamsize(size - 1));
  }
  const std::string moved = name + ".moved";
  try {
    const Scan scan = CR::read_scan<Kernel>(name, {500, 500, 3, 2, 1000});
    if (scan.kind == Scan::MESH && (!CGAL::is_valid_polygon_mesh(scan.mesh) || scan.mesh.is_empty())) std::abort();
    if (scan.kind == Scan::POINTS && scan.points.empty()) std::abort();
    const std::size_t samples = scan.kind == Scan::POINTS ? scan.points.size() : scan.image.points().size();
    if (!scan.normals.empty() && scan.normals.size() != samples) std::abort();
    for (const auto& n : scan.normals)
      if (!(n.squared_length() < 1.1)) std::abort();
    for (const auto& p : scan.points)
      if (!is_finite(p)) std::abort();
    for (const auto v : scan.mesh.vertices())
      if (!is_finite(scan.mesh.point(v))) std::abort();
    for (const auto& p : scan.image.points())
      if (!is_finite(p)) std::abort();
    CR::apply_motion(name, moved, CGAL::Aff_transformation_3<Kernel>(0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30));
  } catch (const CR::IO_error&) {
  }
  std::remove(name.c_str());
  std::remove(moved.c_str());
  return 0;
}
