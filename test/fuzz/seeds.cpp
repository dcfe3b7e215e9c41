// Writes the files that fuzzing starts from: fuzz_seeds FOLDER.

#include "Mesh_bytes.h"

#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/Simple_cartesian.h>

#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
#include <boost/iostreams/close.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#endif
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
#include <png.h>
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Image = CR::Range_image<Kernel>;

namespace {

void write(const std::filesystem::path& folder, const std::string& name, const std::string& bytes)
{
  std::filesystem::create_directories(folder);
  std::ofstream out(folder / name, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw std::runtime_error("cannot write to " + folder.string());
}

template <class T>
std::string binary(T value, bool big_endian)
{
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

Image image(std::size_t columns, std::size_t rows)
{
  Image image(columns, rows);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < rows; ++r)
      if ((c + 2 * r) % 5 != 0) image.set_sample(c, r, Kernel::Point_3(double(c), double(r), 0.1 * double(c * r % 7)));
  return image;
}

// As the scans of the Stanford repository are; this program runs on little-endian machines.
std::string binary_range_image(bool big_endian)
{
  const Image scan = image(5, 4);
  std::string file = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
                     "_endian 1.0\nobj_info num_cols 5\nobj_info num_rows 4\nelement vertex " +
                     std::to_string(scan.points().size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar confidence\n"
                     "element range_grid 20\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : scan.points()) {
    for (int i = 0; i < 3; ++i) file += binary(float(p[i]), big_endian);
    file += '\7';
  }
  for (const auto i : scan.grid()) file += i < 0 ? std::string(1, '\0') : '\1' + binary(std::int32_t(i), big_endian);
  return file;
}

std::string ascii_range_image(const Image& scan)
{
  std::ostringstream out;
  CR::write_range_image(out, scan);
  return out.str();
}

std::string binary_stl()
{
  std::string file(80, ' ');
  file += binary(std::uint32_t(2), false);
  for (const auto& t : {std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 0}}) {
    for (int i = 0; i < 3; ++i) file += binary(0.f, false);
    for (const float x : t) file += binary(x, false);
    file += std::string(2, '\0');
  }
  return file;
}

std::vector<std::string> pcd_files()
{
  const auto head = [](const std::string& format) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4\nTYPE F F F U F "
           "F F\nCOUNT 1 1 1 1 1 "
           "1 1\nWIDTH 2\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " +
           format + "\n";
  };
  std::string text, bytes, packed;
  for (int i = 0; i < 4; ++i) text += std::to_string(i % 2) + " " + std::to_string(i / 2) + " 3 255 0 0 1\n";
  for (int i = 0; i < 28; ++i) bytes += binary(float(i % 7 == 6 ? 1 : i % 5), false);
  for (std::size_t i = 0; i < bytes.size(); i += 16) packed += '\xf' + bytes.substr(i, 16);
  return {head("ascii") + text, head("binary") + bytes,
          head("binary_compressed") + binary(std::uint32_t(packed.size()), false) +
              binary(std::uint32_t(bytes.size()), false) + packed,
          head("binary_compressed") + binary(std::uint32_t(6), false) + binary(std::uint32_t(112), false) +
              std::string("\0\0\xe0\x66\0\0", 6)};
}

std::string npy_file(int dimensions)
{
  std::string header = dimensions == 2 ? "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 6), }\n"
                                       : "{'descr': '>f4', 'fortran_order': True, 'shape': (2, 3, 3), }\n";
  std::string file = "\x93NUMPY\1" + std::string(1, '\0') + binary(std::uint16_t(header.size()), false) + header;
  for (int i = 0; i < 18; ++i)
    file += dimensions == 2 ? binary(i % 6 == 5  ? 1.
                                     : i % 6 > 2 ? 0.
                                                 : double(i),
                                     false)
                            : binary(float(i * i % 7), true);
  return file;
}

// Points, normals and colours by columns.
std::string colored_npy_file()
{
  const std::string header = "{'descr': '<f4', 'fortran_order': True, 'shape': (3, 9), }\n";
  std::string file = "\x93NUMPY\1" + std::string(1, '\0') + binary(std::uint16_t(header.size()), false) + header;
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 3; ++row)
      file += binary(column < 3   ? float(column * row + 1)
                     : column < 5 ? 0.f
                     : column < 6 ? 1.f
                                  : float(100 * row + column),
                     false);
  return file;
}

std::string las_file(int minor)
{
  std::string file(375, '\0');
  file.replace(0, 4, "LASF");
  file[24] = 1;
  file[25] = char(minor);
  file.replace(96, 4, binary(std::uint32_t(375), false));
  file.replace(105, 2, binary(std::uint16_t(20), false));
  file.replace(107, 4, binary(std::uint32_t(3), false));
  file.replace(247, 8, binary(std::uint64_t(3), false));
  for (std::size_t i = 0; i < 3; ++i) file.replace(131 + 8 * i, 8, binary(0.01, false));
  for (int i = 0; i < 15; ++i) file += binary(std::int32_t(100 * i * i), false);
  return file;
}

std::string depth_image()
{
  std::string file;
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
  const std::vector<std::uint16_t> depths = {1000, 1001, 0, 1003, 1004, 1007};
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  head.width = 3;
  head.height = 2;
  head.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = 1000;
  file.resize(size);
  if (!png_image_write_to_memory(&head, file.data(), &size, 0, depths.data(), 0, nullptr))
    throw std::runtime_error("cannot write a PNG image");
  file.resize(size);
#endif
  return file;
}

// A mesh that a node places, and points; binary, and as text, with its buffer in base64.
std::string gltf_file(bool is_binary)
{
  std::string buffer;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) buffer += binary(x, false);
  buffer += std::string("\0\1\2\0", 4);
  const std::string uri =
      is_binary ? "" : ",\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAA==\"";
  std::string text =
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"scale\":[1,2,"
      "3],"
      "\"rotation\":[0,0,0,1],\"children\":[1]},{\"mesh\":1,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]}],\"meshes\":["
      "{"
      "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0,\"COLOR_0\":0},\"indices\":1}]},{\"primitives\":[{"
      "\"attributes\":{\"POSITION\":0},\"mode\":" +
      std::string(is_binary ? "5" : "0") +
      "}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},{\"bufferView\":1,"
      "\"componentType\":5121,\"type\":\"SCALAR\",\"count\":3}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{"
      "\"buffer\":0,\"byteOffset\":36,\"byteLength\":3}],\"buffers\":[{\"byteLength\":40" +
      uri + "}]}";
  if (!is_binary) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return "glTF" + binary(std::uint32_t(2), false) + binary(std::uint32_t(12 + 8 + text.size() + 8 + 40), false) +
         binary(std::uint32_t(text.size()), false) + "JSON" + text + binary(std::uint32_t(40), false) +
         std::string("BIN\0", 4) + buffer;
}

std::string packed([[maybe_unused]] const std::string& text)
{
  std::string file;
#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
  boost::iostreams::filtering_ostream out;
  out.push(boost::iostreams::gzip_compressor());
  out.push(boost::iostreams::back_inserter(file));
  out << text;
  boost::iostreams::close(out);
#endif
  return file;
}

// A bent sheet of (n + 1)^2 vertices, `shift` further along.
Byte_mesh sheet(int n, double shift)
{
  Byte_mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n + shift, y = double(j) / n;
      mesh.points.push_back({std::int8_t(std::lround(100 * (double(i) / n))), std::int8_t(std::lround(100 * y)),
                             std::int8_t(std::lround(25 * std::sin(5 * x + 2 * y * y) + 20 * std::cos(4 * y + x)))});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.faces.push_back({std::uint8_t(a), std::uint8_t(a + 1), std::uint8_t(a + n + 2)});
      mesh.faces.push_back({std::uint8_t(a), std::uint8_t(a + n + 2), std::uint8_t(a + n + 1)});
    }
  return mesh;
}

void write_meshes(const std::filesystem::path& folder, const std::string& name, const Byte_mesh& a, const Byte_mesh& b)
{
  std::vector<std::uint8_t> bytes = {0};
  append(a, bytes);
  append(b, bytes);
  write(folder, name, std::string(bytes.begin(), bytes.end()));
}

void write_seeds(const std::filesystem::path& folder)
{
  Image known = image(4, 3), directed = image(3, 3);
  known.set_sensor(CR::Sensor<Kernel>::perspective(Kernel::Point_3(1, 2, 9)));
  directed.set_sensor(CR::Sensor<Kernel>::orthographic(Kernel::Vector_3(0, 0, -1)));
  const std::vector<std::string> images = {ascii_range_image(image(6, 5)), ascii_range_image(known),
                                           ascii_range_image(directed), binary_range_image(false),
                                           binary_range_image(true)};
  for (std::size_t i = 0; i < images.size(); ++i)
    write(folder / "read_range_image", std::to_string(i) + ".ply", images[i]);

  // The first byte is the number of the extension in read_scan.cpp.
  const std::vector<std::string> ply = {
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n",
      images[0], images[3], images[4]};
  std::vector<std::vector<std::string>> scans = {
      ply,
      {"OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n4 0 2 1 3\n", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n"
                                                                       "0 1 0 1 1 1 1\n3 0 1 2\n"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1/1/1 2//1 3\nf -4 -1 -3\n"},
      {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid\n",
       binary_stl()},
      {"2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 0 0 0.5\n1 0 1 0.5\n0 0 0 0\n2 0 1 "
       "1\n"},
      {"1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n", "3\n1 2 3 7 8 9\n4 5 6\n7 8 9\n",
       "Scan\n0 1 2 3 0 0 1\n1 4 5 6 0 1 0\n2 7 nan 9 0 0 0\n", "// X Y Z\n1,5 2,5 3\n4 5,5 6\n",
       "x y z nx ny nz red green blue\n1 2 3 0 0 1 255 0 10\n4 5 6 0 1 0 1 2 3\n",
       "1 2 3 -7 255 0 10\n4 5 6 -8 1 2 3\n"},
      {"id,\"x\",y,z\n9,1,2,3\n9,-4,5.5,6\n", "1,5;2;3\n4;5;6\n",
       "\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n0,0,0\n0,0,0\n",
       "x,y,z,r,g,b,intensity\n1,2,3,0.5,0.1,1,7\n4,5,6,0,0,0,1\n"},
      {"GOCAD TSURF 1\nHEADER {\nname: a\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n"}};
  std::vector<std::vector<std::string>> others = {pcd_files(),
                                                  {npy_file(2), npy_file(3), colored_npy_file()},
                                                  {las_file(2), las_file(4)},
                                                  {depth_image()},
                                                  {packed("1 2 3\n4 5 6\n")},
                                                  {gltf_file(true)},
                                                  {gltf_file(false)}};
  scans.insert(scans.end(), others.begin(), others.end());
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (std::size_t k = 0; k < scans[i].size(); ++k)
      write(folder / "read_scan", std::to_string(i) + "_" + std::to_string(k), char(i) + scans[i][k]);

  const Byte_mesh triangle = {{{{0, 0, 0}}, {{50, 0, 0}}, {{0, 70, 0}}}, {{{0, 1, 2}}}};
  const Byte_mesh tetrahedron = {{{{0, 0, 0}}, {{50, 0, 0}}, {{0, 70, 0}}, {{0, 0, 90}}},
                                 {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}}};
  write_meshes(folder / "register_meshes", "sheets", sheet(9, 0), sheet(9, 0.2));
  write_meshes(folder / "register_meshes", "same", sheet(7, 0), sheet(7, 0));
  write_meshes(folder / "register_meshes", "small", tetrahedron, triangle);
  write_meshes(folder / "register_meshes", "mixed", tetrahedron, sheet(5, 0));
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2) {
    std::cerr << "usage: fuzz_seeds FOLDER\n";
    return 1;
  }
  try {
    write_seeds(argv[1]);
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
  return 0;
}
