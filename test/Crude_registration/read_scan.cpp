// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE read_scan
#include <boost/test/unit_test.hpp>

#include "scan_files.h"

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
#include <boost/iostreams/close.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#endif
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
#include <png.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace generated;
using Mesh = CGAL::Surface_mesh<Point>;

namespace {

// A tetrahedron without its bottom, as CGAL writes it.
Mesh open_tetrahedron()
{
  Mesh mesh;
  const auto h = CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1.5), mesh);
  CGAL::Euler::remove_face(h, mesh);
  mesh.collect_garbage();
  return mesh;
}

// the same faces, vertices by their points
bool same(const Mesh& a, const Mesh& b)
{
  const auto faces = [](const Mesh& mesh) {
    std::vector<std::vector<Point>> result;
    for (Mesh::Face_index f : mesh.faces()) {
      std::vector<Point> points;
      for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) points.push_back(mesh.point(v));
      std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
      result.push_back(points);
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  return a.number_of_vertices() == b.number_of_vertices() && faces(a) == faces(b);
}

} // namespace

BOOST_AUTO_TEST_CASE(points_as_text)
{
  BOOST_TEST(are(read("a.xyz", "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n"), three));
  BOOST_TEST(are(read("a.txt", "1\t2\t3\r\n-4\t5.5\t6\r\n0.1\t0\t-1e-3"), three)); // no end of line at the end
  BOOST_TEST(are(read("a.csv", "1,2,3\n-4,5.5,6\n0.1,0,-1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "1 , 2 , 3\n -4 ,5.5,6\n0.1,0,-1e-3,\n"), three));
  BOOST_TEST(are(read("a.asc", "1;2;3\n-4;5.5;6\n0.1;0;-1e-3\n"), three));
  BOOST_TEST(are(read("noname", "\n  1 2 3 \n\n  -4 5.5 6\n0.1 0 -1e-3\n\n"), three));
}

BOOST_AUTO_TEST_CASE(comments_and_further_columns_are_passed_over)
{
  BOOST_TEST(are(read("a.xyz", "# a scan\n//X Y Z\n1 2 3 # first\n  # second\n-4 5.5 6 0.5 255 abc\n0.1 0 -1e-3 nan\n"),
                 three));
}

BOOST_AUTO_TEST_CASE(the_number_of_points_may_stand_first)
{
  BOOST_TEST(are(read("a.pts", "3\n1 2 3 7 8 9 10\n-4 5.5 6 1\n0.1 0 -1e-3\n"), three));
  BOOST_TEST(are(read("a.txt", "# points\n3\n1,2,3\n-4,5.5,6\n0.1,0,-1e-3\n"), three));
  CHECK_ERROR("a.pts", "4\n1 2 3\n4 5 6\n7 8 9\n", ": ", "3 points, but its first line says 4");
  CHECK_ERROR("a.pts", "2\n1 2 3\n4 5 6\n7 8 9\n", ": ", "3 points, but its first line says 2");
  CHECK_ERROR("a.pts", "99999999999999999999\n1 2 3\n", ":1: ", "number of points");
  CHECK_ERROR("a.pts", "1\n1 2 3\n1\n4 5 6\n", ":3: ", "y");
}

BOOST_AUTO_TEST_CASE(columns_may_be_named)
{
  BOOST_TEST(are(read("a.csv", "x,y,z\n1,2,3\n-4,5.5,6\n0.1,0,-1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "id,\"Z\",\"X\",name,\"Y\",w\n9,3,1,a b,2\n9,6,-4,,5.5,1\n9,-1e-3,0.1,c,0,2\n"), three));
  BOOST_TEST(are(read("a.txt", "X Y Z R\n1 2 3 0\n-4 5.5 6 0\n0.1 0 -1e-3 0\n"), three));
  CHECK_ERROR("a.csv", "a,b,c\n1,2,3\n", ":1: ", "names x, y and z");
  CHECK_ERROR("a.csv", "id,x,y,z\n1,2,3\n", ":2: ", "ends before a coordinate");
  CHECK_ERROR("a.csv", "x,y,z\n", ": ", "no points");
}

BOOST_AUTO_TEST_CASE(heads_that_programs_write)
{
  const std::string points = "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n";
  BOOST_TEST(are(read("a.xyz", "\xef\xbb\xbf" + points), three));
  BOOST_TEST(are(read("a.off", "\xef\xbb\xbfOFF\n3 0 0\n" + points), three));
  BOOST_TEST(are(read("a.txt", "Scan 1\nexported 2020\n" + points), three));
  BOOST_TEST(are(read("a.txt", "Scan\n3\n" + points), three));
  BOOST_TEST(are(read("a.csv", "\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n-4,5.5,6\n0.1,0,-1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "Y [m],X (m),Z\n2,1,3\n5.5,-4,6\n0,0.1,-1e-3\n"), three));
  BOOST_TEST(are(read("a.asc", "//Z Y X\n3 2 1\n6 5.5 -4\n-1e-3 0 0.1\n"), three)); // names in a comment
  BOOST_TEST(are(read("a.asc", "# z y x\n# by hand\n3 2 1\n6 5.5 -4\n-1e-3 0 0.1\n"), three));
  BOOST_TEST(are(read("a.asc", "# x y z of 3\n" + points), three)); // and other words
  BOOST_TEST(are(read("a.asc", "% written by hand\n" + points), three));
  BOOST_TEST(are(read("a.txt", "\"1\" \"2\" \"3\"\n\"-4\" 5.5 \"6\"\n0.1 0 -1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "name,x,y,z\n\"a, b\",1,2,3\n\"c\",-4,5.5,6\n,0.1,0,-1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "name,x,y,z\n,mm,mm,mm\na,1,2,3\nb,-4,5.5,6\nc,0.1,0,-1e-3\n"), three));
  CHECK_ERROR("a.csv", "name,x,y,z\na,1,2,3\nb,4,,6\n", ":3: ", "a coordinate is not a number");
  // names of other columns are not guessed at
  CHECK_ERROR("a.csv", "range,azimuth,height\n1,2,3\n4,5,6\n", ":1: ", "names x, y and z");
  CHECK_ERROR("a.txt", std::string("\xff\xfe") + "1\0 \0", ": ", "UTF-16");
}

BOOST_AUTO_TEST_CASE(a_comma_may_be_that_of_a_number)
{
  BOOST_TEST(are(read("a.csv", "1;2;3\n-4;5,5;6\n0,1;0;-1e-3\n"), three));
  BOOST_TEST(are(read("a.csv", "\"x\";\"y\";\"z\"\n1;\"2\";3\n-4;\"5,5\";6\n0,1;0;-0,001\n"), three));
  BOOST_TEST(are(read("a.txt", "1,0 2,0 3,0\n-4 5,5 6\n0,1 0 -1e-3\n"), three));
  BOOST_TEST(are(read("a.txt", "1,0\t2\t3\n-4\t5,5\t6\n0,1\t0\t-1e-3\n"), three));
  BOOST_TEST(are(read("a.txt", "1, 2, 3\n-4, 5.5, 6\n0.1, 0, -1e-3\n"), three));
}

BOOST_AUTO_TEST_CASE(a_first_column_that_counts_is_no_coordinate)
{
  for (const char* text : {"0 1 2 3\n1 -4 5.5 6\n2 0.1 0 -1e-3\n", "7,1,2,3,9\n9,-4,5.5,6,9\n23,0.1,0,-1e-3,9\n",
                           "1;1;2;3\n2;-4;5,5;6\n3;0,1;0;-1e-3\n"}) {
    const Scan scan = read("a.txt", text);
    BOOST_TEST(are(scan, three));
    BOOST_TEST(scan.notes.size() == 1);
  }
  // whole coordinates that do not grow, or are not whole, are coordinates
  BOOST_TEST(read("a.txt", "1 2 3 4\n2 3 4 5\n2 4 5 6\n").points[0] == Point(1, 2, 3));
  BOOST_TEST(read("a.txt", "1.0 2 3 4\n2.0 3 4 5\n3.0 4 5 6\n").points[0] == Point(1, 2, 3));
  BOOST_TEST(read("a.txt", "x y z w\n1 2 3 4\n2 3 4 5\n3 4 5 6\n").points[0] == Point(1, 2, 3));
  CHECK_ERROR("a.txt", "1 2 3\n2 3.5 4\n3 4 5\n", ": ", "the first column counts the points");
  BOOST_TEST(read("a.txt", "x y z\n1 2 3\n2 3.5 4\n3 4 5\n").points.size() == 3);
}

BOOST_AUTO_TEST_CASE(normals_of_points)
{
  using Vector_3 = Kernel::Vector_3;
  const std::vector<Vector_3> normals = {Vector_3(0, 0, 1), Vector_3(0, -1, 0), Vector_3(0, 0, 0)};
  const Scan six = read("a.xyz", "1 2 3 0 0 1\n-4 5.5 6 0 -0.995 0\n0.1 0 -1e-3 nan nan nan\n");
  BOOST_TEST(are(six, three));
  BOOST_TEST((six.normals == normals));
  const Scan named = read("a.csv", "NY,x,NZ,y,z,nx\n0,1,7,2,3,0\n-2,-4,0,5.5,6,0\n0,0.1,0,0,-1e-3,0\n");
  BOOST_TEST(are(named, three));
  BOOST_TEST((named.normals == normals));
  const Scan numbered = read("a.txt", "4 1 2 3 0 0 1\n5 -4 5.5 6 0 -1 0\n6 0.1 0 -1e-3 0 0 0\n");
  BOOST_TEST((numbered.normals == normals));
  // three columns of another kind, and more or fewer of them
  for (const char* text :
       {"1 2 3 255 0 9\n-4 5.5 6 0 1 0\n0.1 0 -1e-3 0 0 0\n", "1 2 3 0 0 0\n-4 5.5 6 0 0 0\n0.1 0 -1e-3 0 0 0\n",
        "1 2 3 0 0 1\n-4 5.5 6 0 1\n0.1 0 -1e-3 0 0 1\n", "1 2 3 0 0 1 5\n-4 5.5 6 0 1 0 5\n0.1 0 -1e-3 0 0 1 5\n"}) {
    const Scan other = read("a.xyz", text);
    BOOST_TEST(are(other, three));
    BOOST_TEST(other.normals.empty());
  }
  CHECK_ERROR("a.csv", "x,y,z,nx,ny,nz\n1,2,3,0,0,one\n", ":2: ", "a coordinate of the normal is not a number: 'one'");
  // they go with their points
  const Scan holed = read("a.xyz", "1 2 3 0 0 1\nnan 0 0 1 0 0\n-4 5.5 6 0 -1 0\n0.1 0 -1e-3 0 0 0\n");
  BOOST_TEST(are(holed, three));
  BOOST_TEST((holed.normals == normals));
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                             "property double z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n";
  const Scan ply = read("a.ply", header + "1 2 3 0 0 1\n-4 5.5 6 0 -3 0\n0.1 0 -1e-3 0 0 nan\n");
  BOOST_TEST(are(ply, three));
  BOOST_TEST((ply.normals == normals));
}

BOOST_AUTO_TEST_CASE(points_that_are_no_samples)
{
  const auto check = [](const std::string& name, const std::string& contents, std::size_t missing) {
    const Scan scan = read(name, contents);
    BOOST_TEST_CONTEXT(name << ": " << contents)
    {
      BOOST_TEST(are(scan, three));
      BOOST_TEST(scan.missing == missing);
    }
  };
  check("a.xyz", "nan nan nan\n1 2 3\n-4 5.5 6\n0 inf 0\n0.1 0 -1e-3\n-NaN 1 2\n", 3);
  check("a.csv", "x,y,z\n1,2,3\nNaN,NaN,NaN\n-4,5.5,6\n0.1,0,-1e-3\n", 1);
  check("a.pts", "4\n1 2 3\n-4 5.5 6\n0.1 0 -1e-3\nnan nan nan\n", 1);
  check("m.off", "OFF\n4 0 0\n1 2 3\n-4 5.5 6\n0.1 0 -1e-3\nnan 0 0\n", 1);
  check("m.obj", "v 1 2 3\nv -4 5.5 6\nv nan 0 0\nv 0.1 0 -1e-3\n", 1);
  check("p.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "end_header\n1 2 3\n-4 5.5 6\nnan nan nan\n0.1 0 -1e-3\n",
        1);
  // (0, 0, 0), where no sample can be
  const Scan zero = read("a.xyz", "1 2 3\n0 0 0\n4 5 6\n0 0 0\n0 0 0\n");
  BOOST_TEST(zero.points.size() == 2);
  BOOST_TEST(zero.missing == 3);
  BOOST_TEST(read("a.xyz", "1 2 3\n0 0 0\n4 5 6\n").points.size() == 3);
  BOOST_TEST(read("a.xyz", "1 2 3\n0 0 0\n0 0 0\n-4 -5 -6\n").points.size() == 4); // within the box
  CHECK_ERROR("a.xyz", "nan nan nan\nnan nan nan\n", ": ", "none of the 2 points is a sample");
  CHECK_ERROR("a.xyz", "0 0 nan\n0 0 0\n0 0 0\n", ": ", "");
  // a mesh loses the faces of such vertices, and a range image the cell
  const Scan mesh = read("m.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n0 nan 1\n7 7 7\n3 0 1 2\n3 0 2 3\n");
  BOOST_TEST(mesh.mesh.number_of_faces() == 1);
  BOOST_TEST(mesh.missing == 1);
  CHECK_ERROR("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 inf 0\n3 0 1 2\n", ": ", "a vertex that is NaN");
  const Scan image = read("r.ply", "ply\nformat ascii 1.0\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 4\n"
                                   "property float x\nproperty float y\nproperty float z\nelement range_grid 4\n"
                                   "property list uchar int vertex_indices\nend_header\n0 0 0\nnan 0 0\n0 1 0\n1 1 0\n"
                                   "1 3\n1 0\n1 1\n1 2\n");
  BOOST_TEST(image.missing == 1);
  BOOST_TEST((image.image.grid() == std::vector<std::int32_t>{2, 0, -1, 1}));
}

BOOST_AUTO_TEST_CASE(wrong_texts)
{
  CHECK_ERROR("a.xyz", "", ": ", "empty");
  CHECK_ERROR("a.xyz", "\n\n", ": ", "no points");
  CHECK_ERROR("a.xyz", "# nothing\n", ": ", "no points");
  CHECK_ERROR("a.pts", "0\n", ": ", "no points");
  CHECK_ERROR("a.xyz", "1 2 3\n4 5\n", ":2: ", "ends before z");
  CHECK_ERROR("a.xyz", "1 2 3\n4 x 6\n", ":2: ", "y is not a number: 'x'");
  CHECK_ERROR("a.xyz", "hello world\n", ": ", "no line starts with a number, and the first is 'hello world'");
  CHECK_ERROR("a.xyz", "4 x 6\n1 2 3\n", ":1: ", "y is not a number: 'x'");
  CHECK_ERROR("a.xyz", "1 2 3\nend of scan\n", ":2: ", "x is not a number: 'end'");
  CHECK_ERROR("a.txt", "1,5 2,5 3\n4.5,1 2 3\n", ":2: ", "x is not a number: '4.5,1'");
  CHECK_ERROR("a.csv", "1.000,5;2,5;3,5\n", ": ", "'1.000,5"); // thousands
  CHECK_ERROR("a.csv", "\"1\",\"2,\"3\"\n", ":1: ", "y");
  CHECK_ERROR("a.csv", "1,2,3\n4,,6\n", ":2: ", "y");
  CHECK_ERROR("a.xyz",
              std::string("\x7f"
                          "ELF\0\0",
                          6),
              ": ", "format");
}

BOOST_AUTO_TEST_CASE(range_images)
{
  Image image = orthographic_image(30, 20, 1, 1, [](double x, double y) { return 0.1 * x * y; });
  image.set_sensor(Sensor::perspective(Point(1, 2, 3)));
  const std::string name = (folder().path() / "SCAN.PLY").string();
  CR::write_range_image(name, image);
  const Scan scan = CR::read_scan<Kernel>(name);
  BOOST_TEST((scan.kind == Scan::RANGE_IMAGE));
  BOOST_TEST((scan.image.points() == image.points()));
  BOOST_TEST((scan.image.grid() == image.grid()));
  BOOST_TEST(scan.image.sensor().viewpoint() == Point(1, 2, 3));
  BOOST_TEST(scan.points.empty());
  BOOST_TEST(scan.mesh.is_empty());
}

BOOST_AUTO_TEST_CASE(ptx_files)
{
  // 3 columns of 2 samples, turned by 90 degrees about z and shifted
  const std::string head = "3\n2\n10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
  const std::string samples = "1 0 0 0.5\n1 0 1 0.5 1 2 3\n0 0 0 0\n2 0 1 0.5\n3 1 0 0.5\n0 0 0 0\n";
  const Scan scan = read("a.ptx", head + samples);
  BOOST_TEST((scan.kind == Scan::RANGE_IMAGE));
  const Image& image = scan.image;
  BOOST_TEST(image.columns() == 3);
  BOOST_TEST(image.rows() == 2);
  BOOST_TEST(image.points().size() == 4);
  const auto at = [&](std::size_t column, std::size_t row) {
    return image.points()[std::size_t(image.index(column, row))];
  };
  BOOST_TEST(at(0, 0) == Point(10, 21, 30));
  BOOST_TEST(at(0, 1) == Point(10, 21, 31));
  BOOST_TEST(image.index(1, 0) == -1);
  BOOST_TEST(at(1, 1) == Point(10, 22, 31));
  BOOST_TEST(at(2, 0) == Point(9, 23, 30));
  BOOST_TEST(image.index(2, 1) == -1);
  BOOST_TEST(image.sensor().viewpoint() == Point(10, 20, 30));

  BOOST_TEST(scan.missing == 2);

  std::string wrong;
  CHECK_ERROR("a.ptx", "three\n", ":1: ", "number of columns");
  CHECK_ERROR("a.ptx", "3 2\n", ":1: ", "more than");
  CHECK_ERROR("a.ptx", "3\n-2\n", ":2: ", "positive");
  CHECK_ERROR("a.ptx", "3\n", ":1: ", "ends before the number of rows");
  CHECK_ERROR("a.ptx", "3\n2\n1 2\n", ":3: ", "ends before z");
  CHECK_ERROR("a.ptx", "1000000000\n1000000000\n1 2 3\n", ":2: ", "too short");
  CHECK_ERROR("a.ptx", head.substr(0, head.size() - 12), ":9: ", "motion");
  CHECK_ERROR("a.ptx", head + "1 0 0 0\n", ":11: ", "after 1 of 6");
  CHECK_ERROR("a.ptx", head + samples + head, ":17: ", "of several scans in a file");
  CHECK_ERROR("a.ptx", head + "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n", ": ", "no samples");
  BOOST_TEST(read("a.ptx", head + "1 nan 0 0\n" + samples.substr(samples.find('\n') + 1)).missing == 3);
  wrong = head + samples;
  wrong.replace(wrong.find("10 20 30"), 8, "10 inf 30");
  CHECK_ERROR("a.ptx", wrong, ":3: ", "infinite");
  CHECK_ERROR("a.ptx", head + "1 1e90 0 0\n" + samples.substr(samples.find('\n') + 1), ": ", "1e75");
  wrong = head + samples;
  wrong.replace(wrong.find("-1 0 0 0"), 8, "-2 0 0 0");
  CHECK_ERROR("a.ptx", wrong, ":10: ", "not rigid");
  wrong = head + samples;
  wrong.replace(wrong.find("30 1\n"), 5, "30 2\n");
  CHECK_ERROR("a.ptx", wrong, ":10: ", "0 0 0 1");
  wrong = head + samples;
  wrong.replace(wrong.find("0 0 1 0"), 7, "0 0 -1 0");
  CHECK_ERROR("a.ptx", wrong, ":10: ", "not rigid");
}

BOOST_AUTO_TEST_CASE(ptx_files_of_several_scans)
{
  const auto scan_at = [](const std::string& x) {
    return "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" + x + " 0 0 1\n1 0 0 0.5\n0 0 0 0.5\n";
  };
  const std::string name = folder().file("several.ptx", scan_at("10") + scan_at("20") + scan_at("30"));
  const std::vector<std::string> names = CR::internal::names_of_scans(name);
  BOOST_TEST((names == std::vector<std::string>{name + "#1", name + "#2", name + "#3"}));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Scan scan = CR::read_scan<Kernel>(names[i]);
    BOOST_TEST((scan.image.points() == std::vector<Point>{Point(10 * double(i + 1) + 1, 0, 0)}));
    BOOST_TEST(scan.image.sensor().viewpoint() == Point(10 * double(i + 1), 0, 0));
  }
  const auto complaint = [](const std::string& file) {
    try {
      CR::read_scan<Kernel>(file);
    } catch (const CR::IO_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(complaint(name).find(":13: more samples than columns times rows: of several scans in a file") !=
             std::string::npos);
  BOOST_TEST(complaint(name + "#4") == name + ": the file has 3 scans: there is no number 4");
  BOOST_TEST(complaint(name + "#0").find("cannot be opened") != std::string::npos);
  BOOST_TEST(complaint(folder().file("a.xyz", "1 2 3\n") + "#2").find("only a PTX file") != std::string::npos);
  BOOST_TEST(are(read("a#2.xyz", "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n"), three)); // a name like others
  const std::string one = folder().file("one.ptx", scan_at("10"));
  BOOST_TEST(CR::internal::names_of_scans(one) == std::vector<std::string>{one});
  BOOST_TEST(CR::read_scan<Kernel>(one + "#1").image.points().size() == 1);
  const std::string cut = folder().file("cut.ptx", scan_at("10") + scan_at("20").substr(0, 40));
  BOOST_TEST(complaint(cut + "#2").find("cut.ptx:20: ") != std::string::npos);
  BOOST_CHECK_THROW(CR::internal::names_of_scans(cut), CR::IO_error);
}

#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
namespace {

std::string packed(const std::string& text)
{
  std::string result;
  boost::iostreams::filtering_ostream out;
  out.push(boost::iostreams::gzip_compressor());
  out.push(boost::iostreams::back_inserter(result));
  out << text;
  boost::iostreams::close(out);
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(packed_files)
{
  const std::string points = "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n", good = packed(points);
  BOOST_TEST(are(read("a.xyz.gz", good), three));
  BOOST_TEST(are(read("a.xyz", good), three)); // by its content
  BOOST_TEST(are(read("a.xyz.gz", points), three));
  BOOST_TEST(are(read("a.xyz.gz", packed("1 2 3\n") + packed("-4 5.5 6\n0.1 0 -1e-3\n")), three));
  BOOST_TEST(are(read("a.OBJ.GZ", packed("v 1 2 3\nv -4 5.5 6\nv 0.1 0 -1e-3\n")), three));
  BOOST_TEST(are(read("a.obj.gz", packed("v 1 2 3\nv -4 5.5 6\nv 0.1 0 -1e-3\n")), three));
  CHECK_ERROR("a.xyz.gz", packed("1 2 3\n4 x 6\n"), ":2: ", "y is not a number: 'x'");
  CHECK_ERROR("a.xyz.gz", packed(""), ": ", "empty");
  for (std::size_t size = 2; size < good.size(); ++size)
    CHECK_ERROR("a.xyz.gz", good.substr(0, size), ": ", "damaged or cut short");
  std::string bad = good;
  bad[good.size() - 6] = char(bad[good.size() - 6] + 1); // the check sum
  CHECK_ERROR("a.xyz.gz", bad, ": ", "damaged");
}
#endif

#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
namespace {

std::string png_of(std::size_t columns, std::size_t rows, const std::vector<std::uint16_t>& values)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(rows);
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = 10000 + 4 * values.size();
  std::string result(size, '\0');
  BOOST_REQUIRE(png_image_write_to_memory(&image, result.data(), &size, 0, values.data(), 0, nullptr));
  result.resize(size);
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(depth_images)
{
  const std::string good = png_of(3, 2, {1000, 0, 2000, 500, 65535, 1});
  const CR::Depth_camera camera = {500, 250, 1, 0.5, 1000};
  const std::string file = folder().file("depth.png", good);
  const Scan scan = CR::read_scan<Kernel>(file, camera);
  BOOST_TEST((scan.kind == Scan::RANGE_IMAGE));
  BOOST_TEST(scan.image.columns() == 3);
  BOOST_TEST(scan.image.rows() == 2);
  BOOST_TEST(scan.missing == 1);
  BOOST_TEST(scan.image.sensor().viewpoint() == Point(0, 0, 0));
  BOOST_TEST((scan.image.grid() == std::vector<std::int32_t>{0, -1, 1, 2, 3, 4}));
  const std::vector<Point> expected = {Point(-1 / 500., -0.5 / 250., 1), Point(2 / 500., -1 / 250., 2),
                                       Point(-0.5 / 500., 0.25 / 250., 0.5), Point(0, 65.535 / 500., 65.535),
                                       Point(1e-3 / 500., 5e-4 / 250., 1e-3)};
  BOOST_REQUIRE(scan.image.points().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    BOOST_TEST(CGAL::squared_distance(scan.image.points()[i], expected[i]) < 1e-24);

  CHECK_ERROR("depth.png", good, ": ", "only with its camera");
  const auto complaint = [&](const std::string& contents, const CR::Depth_camera& by) {
    try {
      CR::read_scan<Kernel>(folder().file("depth.png", contents), by);
    } catch (const CR::IO_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(complaint(good, {500, 250, 1, 0.5, 0}).find("only with its camera") != std::string::npos);
  BOOST_TEST(complaint(good, {-500, 250, 1, 0.5, 1}).find("only with its camera") != std::string::npos);
  BOOST_TEST(complaint(good.substr(0, good.size() - 20), camera).find("the file ends within the image") !=
             std::string::npos);
  BOOST_TEST(complaint(png_of(2, 1, {0, 0}), camera).find("no samples") != std::string::npos);
  std::string huge = good;
  huge.replace(16, 8, std::string("\0\x08\0\0\0\x08\0\0", 8)); // its check sum is wrong then, too
  BOOST_TEST(complaint(huge, camera) != "");
  for (std::size_t at = 8; at < good.size(); ++at) {
    std::string changed = good;
    changed[at] = char(changed[at] ^ 0x55);
    complaint(changed, camera); // read or refused
  }
}
#endif

BOOST_AUTO_TEST_CASE(meshes_that_cgal_writes)
{
  const Mesh mesh = open_tetrahedron();
  for (const char* name : {"m.off", "m.obj", "m.stl", "m.ply", "m.ts"})
    for (bool binary : {false, true}) {
      const std::string file = (folder().path() / name).string();
      if (binary && std::string(name) == "m.off") continue;
      BOOST_REQUIRE(CGAL::IO::write_polygon_mesh(file, mesh, CGAL::parameters::use_binary_mode(binary)));
      const Scan scan = CR::read_scan<Kernel>(file);
      BOOST_TEST_CONTEXT(name << (binary ? " binary" : " ascii"))
      {
        BOOST_TEST((scan.kind == Scan::MESH));
        BOOST_TEST(same(scan.mesh, mesh));
        BOOST_TEST(scan.points.empty());
      }
    }
}

BOOST_AUTO_TEST_CASE(off_files)
{
  const std::string faces = "3 0 1 2\n4 0 2 1 3 255 0 0\n";
  const Scan plain = read("m.off", "OFF\n# comment\n4 2 0\n\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + faces);
  BOOST_TEST((plain.kind == Scan::MESH));
  BOOST_TEST(plain.mesh.number_of_faces() == 2);
  BOOST_TEST(same(plain.mesh, read("m.dat", "OFF 4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + faces).mesh)); // by its content
  BOOST_TEST(
      same(plain.mesh,
           read("m.off", "COFF\n4 2 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n0 0 1 1 1 1 1\n" + faces).mesh));
  BOOST_TEST(same(plain.mesh,
                  read("m.off", "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n" + faces).mesh));
  BOOST_TEST(are(read("m.off", "OFF\n3 0 0\n1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n"), three));

  CHECK_ERROR("m.off", "PFF\n1 0 0\n1 2 3\n", ":1: ", "PFF");
  CHECK_ERROR("m.off", "4OFF\n1 0 0\n1 2 3 1\n", ":1: ", "4OFF");
  CHECK_ERROR("m.off", "OFF BINARY\n", ":1: ", "binary");
  CHECK_ERROR("m.off", "OFF\n", ":1: ", "numbers of vertices");
  CHECK_ERROR("m.off", "OFF\n1 x 0\n", ":2: ", "number of faces");
  CHECK_ERROR("m.off", "OFF\n-1 0 0\n", ":2: ", "negative");
  CHECK_ERROR("m.off", "OFF\n0 0 0\n", ": ", "no points");
  CHECK_ERROR("m.off", "OFF\n3 0 0\n1 2 3\n", ":3: ", "after 1 of 3 vertices");
  CHECK_ERROR("m.off", "OFF\n1000000000000 0 0\n1 2 3\n", ":3: ", "after 1 of");
  CHECK_ERROR("m.off", "OFF\n1 2 0\n1 2 3\n3 0 0 0\n", ":4: ", "after 1 of 2 faces");
  CHECK_ERROR("m.off", "OFF\n1 1 0\n1 2 3\n3 0 0 1\n", ":4: ", "index 1");
  CHECK_ERROR("m.off", "OFF\n1 1 0\n1 2 3\n3 0 0\n", ":4: ", "ends before a vertex");
  CHECK_ERROR("m.off", "OFF\n1 1 0\n1 2 3\n3 0 0 0\n", ": ", "degenerate");
}

BOOST_AUTO_TEST_CASE(obj_files)
{
  const Scan scan =
      read("m.obj", "# c\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0 1.0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2//1 3\nv 0 0 1\n"
                    "l 1 2\nf -4 -1 -3\ns off\n");
  BOOST_TEST((scan.kind == Scan::MESH));
  BOOST_TEST(scan.mesh.number_of_faces() == 2);
  BOOST_TEST(scan.mesh.number_of_vertices() == 4);
  BOOST_TEST(are(read("m.obj", "v 1 2 3\nv -4 5.5 6\nv 0.1 0 -1e-3\n"), three));
  CHECK_ERROR("m.obj", "v 1 2\n", ":1: ", "z");
  CHECK_ERROR("m.obj", "v 1 2 3\nf 1 2 3\n", ":2: ", "index 2");
  CHECK_ERROR("m.obj", "v 1 2 3\nf 1 0 1\n", ":2: ", "index 0");
  CHECK_ERROR("m.obj", "v 1 2 3\nf -2 1 1\n", ":2: ", "index -2");
  CHECK_ERROR("m.obj", "v 1 2 3\nf 1 a/2 1\n", ":2: ", "a/2");
  CHECK_ERROR("m.obj", "# nothing\n", ": ", "no points");
}

BOOST_AUTO_TEST_CASE(stl_files)
{
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  BOOST_TEST(read("m.stl", "solid a b\n" + facet + "endsolid\n").mesh.number_of_faces() == 1);
  CHECK_ERROR("m.stl", "solid\nendsolid\n", ": ", "no points");
  CHECK_ERROR("m.stl", "solid\nfacet\nvertex 1 2\n", ":3: ", "z");
  CHECK_ERROR("m.stl", "solid\nfacet\nvertex 1 2 3\nendloop\n", ":4: ", "1 vertices");
  CHECK_ERROR("m.stl", "solid\nfacet\nvertex 1 2 3\n", ":3: ", "within a facet");
  CHECK_ERROR("m.stl", "solid\nfacets\n", ":2: ", "facets");
  CHECK_ERROR("m.stl", "sold\n", ":1: ", "solid");

  std::string binary(80, ' ');
  binary.replace(0, 5, "solid"); // as some programs write
  const std::uint32_t n = 2;
  for (int i = 0; i < 4; ++i) binary += char(n >> 8 * i & 0xff);
  const auto put = [&](float x) {
    std::uint32_t bits;
    std::memcpy(&bits, &x, 4);
    for (int i = 0; i < 4; ++i) binary += char(bits >> 8 * i & 0xff);
  };
  for (const std::vector<float>& t :
       {std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 0}}) {
    for (int i = 0; i < 3; ++i) put(0);
    for (float x : t) put(x);
    binary += std::string(2, '\0');
  }
  const Scan scan = read("m.stl", binary);
  BOOST_TEST(scan.mesh.number_of_faces() == 2);
  BOOST_TEST(scan.mesh.number_of_vertices() == 4); // shared points are one
  std::string other = binary;
  other[0] = 'S';
  CHECK_ERROR("m.stl", other.substr(0, other.size() - 1), ": byte 183: ", "after 1 of 2");
  std::memset(other.data() + 84 + 12, 0xff, 4);
  const Scan holed = read("m.stl", other);
  BOOST_TEST(holed.mesh.number_of_faces() == 1);
  BOOST_TEST(holed.missing == 1);
}

BOOST_AUTO_TEST_CASE(faces_that_are_no_manifold_are_mended)
{
  const auto read_faces = [](const std::string& faces, int n) {
    return read("m.off", "OFF\n6 " + std::to_string(n) + " 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n9 9 9\n" + faces);
  };
  // turned differently
  const Scan turned = read_faces("3 0 1 2\n3 0 1 3\n", 2);
  BOOST_TEST(turned.mesh.number_of_faces() == 2);
  BOOST_TEST(turned.mesh.number_of_vertices() == 4); // one without a face is left out
  BOOST_TEST(CGAL::is_valid_polygon_mesh(turned.mesh));
  // three faces at an edge
  const Scan book = read_faces("3 0 1 2\n3 1 0 3\n3 0 1 4\n", 3);
  BOOST_TEST(book.mesh.number_of_faces() == 3);
  BOOST_TEST(CGAL::is_valid_polygon_mesh(book.mesh));
  // two in a point, degenerate ones, one twice
  const Scan mixed = read_faces("3 0 1 2\n3 0 3 4\n3 1 1 2\n2 0 1\n3 0 1 2\n", 5);
  BOOST_TEST(mixed.mesh.number_of_faces() >= 2);
  BOOST_TEST(CGAL::is_valid_polygon_mesh(mixed.mesh));
  // all of them
  CHECK_ERROR("m.off", "OFF\n2 1 0\n0 0 0\n1 1 1\n3 0 1 0\n", ": ", "degenerate");
}

BOOST_AUTO_TEST_CASE(ply_files_without_a_grid)
{
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
  const std::string points = "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n";
  BOOST_TEST(are(read("p.ply", header + "end_header\n" + points), three));
  BOOST_TEST(are(read("ply.txt", header + "end_header\n" + points), three)); // by its content
  BOOST_TEST(are(
      read("p.ply", header + "element face 0\nproperty list uchar int vertex_indices\nend_header\n" + points), three));
  BOOST_TEST(are(read("p.ply", header + "element face 0\nend_header\n" + points), three));
  const Scan mesh = read("p.ply", header + "element face 1\nproperty list uchar int vertex_index\nend_header\n" +
                                      points + "3 0 1 2\n");
  BOOST_TEST((mesh.kind == Scan::MESH));
  BOOST_TEST(mesh.mesh.number_of_faces() == 1);
  CHECK_ERROR("p.ply",
              header + "element face 1\nproperty list uchar int vertex_index\nend_header\n" + points + "3 0 1 3\n",
              ":13: ", "index 3");
  CHECK_ERROR("p.ply", header + "end_header\n1 2 3\n", ":9: ", "after 1 of 3");
  CHECK_ERROR("p.ply", "not ply\n", ":1: ", "ply");
}

BOOST_AUTO_TEST_CASE(formats_that_are_not_built_in)
{
#ifndef CGAL_USE_VTK
  CHECK_ERROR("m.vtp", "<VTKFile/>", ": ", "VTK");
#endif
  CHECK_ERROR("m.ts", "nonsense", ": ", "GOCAD");
  CHECK_ERROR("m.ts", "GOCAD TSURF 1\nTFACE\nVRTX 0 1 2 3\nVRTX 1 2 zero 3\nEND\n", ":4: ", "vertex");
  CHECK_ERROR("m.ts", "GOCAD TSURF 1\nTFACE\nVRTX 0 1 2 3\nTRGL 0 0\nEND\n", ":4: ", "triangle");
  CHECK_ERROR("m.ts", "GOCAD TSURF 1\nTFACE\nVRTX 0 1 2 3\n", ": ", "END");
  CHECK_ERROR("m.ts", "GOCAD TSURF 1\nTFACE\nVRTX 0 1 2 3\nTRGL 0 1 2\nEND\n", ": ", "does not exist");
  BOOST_CHECK_THROW(CR::read_scan<Kernel>((folder().path() / "missing").string()), CR::IO_error);
}

BOOST_AUTO_TEST_CASE(any_bytes_are_read_or_refused)
{
  std::mt19937 random(2);
  const std::vector<std::pair<std::string, std::string>> good = {
      {"f.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n4 0 2 1 3\n"},
      {"f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2/1 3\nf -4 -1 -3\n"},
      {"f.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"},
      {"f.ptx", "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 0 0\n1 0 1\n0 0 0\n2 0 1\n"},
      {"f.csv", "id,x,y,z\n1,2,3,4\n2,5,6,7\n"},
      {"f.pts", "2\n1 2 3\n4 5 6\n"},
      {"f.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}};
  for (const auto& [name, text] : good) {
    BOOST_TEST(error_of(name, text) == "");
    for (int i = 0; i < 400; ++i) {
      std::string bad = text;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const std::size_t at = random() % bad.size();
        switch (random() % 4) {
        case 0:
          bad[at] = char(random());
          break;
        case 1:
          bad[at] = "0123456789-+.eE \n/,"[random() % 19];
          break;
        case 2:
          bad.erase(at, random() % 8);
          break;
        default:
          bad.insert(at, bad.substr(random() % bad.size(), random() % 12));
        }
        if (bad.empty()) bad = " ";
      }
      try {
        const Scan scan = read(name, bad);
        BOOST_TEST(CGAL::is_valid_polygon_mesh(scan.mesh));
      } catch (const CR::IO_error&) {
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(real_points, *boost::unit_test::label("real_scans") *
                                      boost::unit_test::precondition(generated::real_scans_are_there))
{
  for (const auto& file : files(real_scans("uwa_trex"), ".txt")) {
    if (file.filename() == "poses.txt") continue;
    const Scan scan = CR::read_scan<Kernel>(file.string());
    BOOST_TEST((scan.kind == Scan::POINTS));
    BOOST_TEST(scan.points.size() > 20000);
  }
  for (const auto& file : files(real_scans("3dmatch_kitchen"), ".ply")) {
    const Scan scan = CR::read_scan<Kernel>(file.string());
    BOOST_TEST((scan.kind == Scan::POINTS));
    BOOST_TEST(scan.points.size() > 250000);
  }
}
