#define BOOST_TEST_MODULE degenerate_input
#include <boost/test/unit_test.hpp>

#include "registration_checks.h"

#include <CGAL/Crude_registration.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// Everything that a mesh, a range image or a set of points can have wrong, through every public function: the answer is
// sound, or an exception names the function and the argument.

namespace {

struct Input
{
  std::string name;
  std::vector<Vector> points;
  std::vector<std::vector<std::int32_t>> faces;
};

Input input(const std::string& name, const Flat_mesh& flat)
{
  Input result{name, flat.points, {}};
  for (const auto& f : flat.faces) result.faces.emplace_back(f.begin(), f.end());
  return result;
}

Flat_mesh scaled(Flat_mesh mesh, double factor, const Vector& offset = Vector::Zero())
{
  for (Vector& q : mesh.points) q = factor * q + offset;
  return mesh;
}

void append(Flat_mesh& mesh, const Flat_mesh& other)
{
  const auto first = std::int32_t(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
}

std::vector<Input> make_inputs()
{
  const Flat_mesh good = generated::bumps(12);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity(),
               largest = (std::numeric_limits<double>::max)(), denormal = std::numeric_limits<double>::denorm_min();
  std::vector<Input> inputs;
  const auto add = [&](const std::string& name, const Flat_mesh& mesh) { inputs.push_back(input(name, mesh)); };
  const auto add_with = [&](const std::string& name, auto change) {
    Flat_mesh mesh = good;
    change(mesh);
    add(name, mesh);
  };
  const auto grid = [](int n, const Vector& u, const Vector& v) {
    return generated::grid(
        n, n, [=](double a, double b) { return Vector(a * u + b * v); }, 0.);
  };
  const Vector x(1, 0, 0), y(0, 1, 0);

  add("empty", {});
  add("one point", {{{1, 2, 3}}, {}});
  add("two points", {{{1, 2, 3}, {2, 2, 3}}, {}});
  add("three points", {{{1, 2, 3}, {2, 2, 3}, {0, 5, 1}}, {}});
  add("points without faces", {good.points, {}});
  add("one triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  add("two triangles", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.3}}, {{0, 1, 2}, {2, 1, 3}}});
  add("a tetrahedron", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  add("a collinear triangle", {{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}});
  add("collinear", grid(8, x, 3 * x));
  add("coplanar", grid(8, x, y));
  add("a point many times", grid(8, 0 * x, 0 * x));
  add("two points many times", {{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {1, 3, 2}}});
  add("needles", grid(12, x, 1e-9 * y));
  add_with("faces without area", [](Flat_mesh& m) {
    for (std::size_t i = 0; i < m.faces.size(); i += 3)
      m.points[std::size_t(m.faces[i][0])] = m.points[std::size_t(m.faces[i][1])];
  });
  {
    Flat_mesh soup;
    for (const auto& f : good.faces) {
      const auto first = std::int32_t(soup.points.size());
      for (const std::int32_t v : f) soup.points.push_back(good.points[std::size_t(v)]);
      soup.faces.push_back({first, first + 1, first + 2});
    }
    add("every point of every face anew", soup);
  }
  add_with("faces twice", [&](Flat_mesh& m) { m.faces.insert(m.faces.end(), good.faces.begin(), good.faces.end()); });
  add_with("a face three times", [&](Flat_mesh& m) { m.faces.insert(m.faces.end(), 2, good.faces[5]); });
  add_with("all faces turned", [](Flat_mesh& m) {
    for (auto& f : m.faces) std::swap(f[0], f[1]);
  });
  add_with("every other face turned", [](Flat_mesh& m) {
    for (std::size_t i = 0; i < m.faces.size(); i += 2) std::swap(m.faces[i][0], m.faces[i][1]);
  });
  add("an edge of three faces",
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});
  add("two cones that touch", {{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {0, 1, -1}, {-1, -1, -1}},
                               {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}}});
  add("a face of one vertex twice", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 0, 1}}});
  {
    Flat_mesh islands, dust;
    for (int i = 0; i < 9; ++i) append(islands, scaled(generated::bumps(3), 1, Vector(2 * i, i * i, -i)));
    generated::Random random(4);
    for (int i = 0; i < 300; ++i)
      append(dust, scaled({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 1e-4, 10 * random.vector()));
    add("islands", islands);
    add("dust", dust);
  }
  for (double away : {1e3, 1e6, 1e12, 1e100})
    add_with("a spike of " + std::to_string(int(std::log10(away))) + " digits",
             [=](Flat_mesh& m) { m.points[70] += Vector(0.1, 0.2, 1) * away; });
  add_with("isolated vertices", [](Flat_mesh& m) { m.points.insert(m.points.end(), 20, Vector(0.3, 0.3, 0.3)); });
  add_with("an isolated vertex far away", [](Flat_mesh& m) { m.points.push_back(Vector(1e9, 0, 0)); });
  add("without border", generated::sphere(6, 1));
  add_with("holes", [](Flat_mesh& m) {
    for (std::size_t i = 0; i < m.faces.size(); i += 2) m.faces.erase(m.faces.begin() + std::ptrdiff_t(i));
  });
  add_with("NaN", [=](Flat_mesh& m) { m.points[60].y() = nan; });
  add_with("infinity", [=](Flat_mesh& m) { m.points[60].z() = -infinity; });
  add_with("an isolated NaN", [=](Flat_mesh& m) { m.points.push_back(Vector(nan, 0, 0)); });
  for (double size : {1e-320, 1e-310, 1e-150, 1e-100, 1e-50, 1e-20, 1e-13, 1e13, 1e20, 1e38, 1e100, 1e150, 1e300})
    add("of size 1e" + std::to_string(int(std::round(std::log10(size)))), scaled(good, size));
  add("all that a double holds",
      {{{-largest, -largest, -largest}, {largest, 0, 0}, {0, largest, largest}}, {{0, 1, 2}}});
  add("denormal", {{{0, 0, 0}, {denormal, 0, 0}, {0, denormal, 0}}, {{0, 1, 2}}});
  for (double offset : {1e6, 1e12, 1e16, 1e100})
    add("at 1e" + std::to_string(int(std::round(std::log10(offset)))),
        scaled(good, 1, Vector(offset, -offset, offset)));
  inputs.push_back({"a quadrangle", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}});
  return inputs;
}

const std::vector<Input>& inputs()
{
  static const std::vector<Input> all = make_inputs();
  return all;
}

// A face that a mesh cannot have gets vertices of its own, or is left out.
Mesh to_mesh(const Input& input)
{
  Mesh mesh;
  for (const Vector& q : input.points) mesh.add_vertex(Point(q.x(), q.y(), q.z()));
  for (const auto& face : input.faces) {
    std::vector<Mesh::Vertex_index> vertices;
    for (const std::int32_t v : face) vertices.emplace_back(Mesh::size_type(v));
    std::vector<Mesh::Vertex_index> sorted = vertices;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
    if (mesh.add_face(vertices) != Mesh::null_face()) continue;
    for (auto& v : vertices) {
      const Point q = mesh.point(v);
      v = mesh.add_vertex(q);
    }
    mesh.add_face(vertices);
  }
  return mesh;
}

std::vector<Point> to_points(const Input& input)
{
  std::vector<Point> points;
  for (const Vector& q : input.points) points.emplace_back(q.x(), q.y(), q.z());
  return points;
}

const Mesh& good_mesh()
{
  static const Mesh mesh = to_mesh(input("good", generated::bumps(12, 1, 0.01, 3)));
  return mesh;
}

bool is_finite(const Point& q)
{
  return std::isfinite(q.x()) && std::isfinite(q.y()) && std::isfinite(q.z());
}

bool is_sound(const Result& result)
{
  check_sound(result);
  return true;
}

bool is_sound(const Mesh& mesh)
{
  return mesh.is_valid(false) &&
         std::all_of(mesh.vertices().begin(), mesh.vertices().end(), [&](auto v) { return is_finite(mesh.point(v)); });
}

bool is_sound(const Scan& scan)
{
  return scan.number_of_samples() > 0 && std::isfinite(scan.spacing()) && scan.spacing() > 0 &&
         std::isfinite(scan.extent()) && scan.extent() > 0;
}

std::string current_input;

// Calls, and checks what is returned to be true, or what is thrown to begin with `function` and to name `argument`.
template <class Call>
void check(const std::string& function, const std::string& argument, const Call& call)
{
  BOOST_TEST_CONTEXT(function)
  {
    BOOST_TEST_MESSAGE(function << ", " << current_input);
    try {
      BOOST_TEST(call());
    } catch (const std::invalid_argument& e) {
      const std::string what = e.what();
      BOOST_TEST(what.rfind(function, 0) == 0, what);
      BOOST_TEST(what.find(argument) != std::string::npos, what);
    } catch (const std::exception& e) {
      BOOST_ERROR("another exception: " << e.what());
    }
  }
}

template <class Check>
void for_each_mesh(const Check& check_mesh)
{
  for (const Input& i : inputs()) BOOST_TEST_CONTEXT(i.name)
    {
      current_input = i.name;
      check_mesh(to_mesh(i));
    }
}

// The points row by row in a grid as square as may be; none where an image refuses a coordinate.
std::vector<Image> images_of(const Input& input)
{
  std::size_t columns = 1;
  while (columns * columns < input.points.size()) ++columns;
  const std::size_t rows = input.points.empty() ? 0 : (input.points.size() + columns - 1) / columns;
  Image image(input.points.empty() ? 0 : columns, rows);
  const std::vector<Point> points = to_points(input);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double largest = 1e75;
    if (!is_finite(points[i]) || CGAL::squared_distance(points[i], Point(CGAL::ORIGIN)) > largest * largest) {
      BOOST_CHECK_THROW(image.set_sample(i % columns, i / columns, points[i]), std::invalid_argument);
      return {};
    }
    image.set_sample(i % columns, i / columns, points[i]);
  }
  std::vector<Image> images(4, image);
  images[1].set_sensor(Sensor::perspective(Point(0.3, 0.4, 3)));
  images[2].set_sensor(Sensor::orthographic(Kernel::Vector_3(0, 0, -1)));
  if (!points.empty()) images[3].set_sensor(Sensor::perspective(points[0]));
  return images;
}

} // namespace

BOOST_AUTO_TEST_CASE(meshes_registered)
{
  for_each_mesh([](const Mesh& mesh) {
    const Mesh& good = good_mesh();
    const Point above(0.3, 0.4, 3);
    const Kernel::Vector_3 down(0, 0, -1);
    check("Scan", "mesh", [&] { return is_sound(Scan(mesh)); });
    check("Scan", "mesh", [&] { return is_sound(Scan(mesh, p::viewpoint(above))); });
    check("Scan", "mesh", [&] { return is_sound(Scan(mesh, p::viewing_direction(down))); });
    check("register_meshes", "source", [&] { return is_sound(CR::register_meshes(mesh, good)); });
    check("register_meshes", "target", [&] { return is_sound(CR::register_meshes(good, mesh)); });
    check("register_meshes", "source", [&] { return is_sound(CR::register_meshes(mesh, mesh)); });
    // From within the scan.
    if (mesh.number_of_vertices() > 0 && is_finite(mesh.point(*mesh.vertices().begin())))
      check("register_meshes", "target", [&] {
        return is_sound(
            CR::register_meshes(good, mesh, p::viewpoint(above), p::viewpoint(mesh.point(*mesh.vertices().begin()))));
      });
  });
}

// A range image that CGAL reads as a mesh: points without faces.
BOOST_AUTO_TEST_CASE(a_mesh_without_faces_is_refused_with_what_to_use)
{
  Image image(3, 3);
  for (std::size_t i = 0; i < 9; ++i) image.set_sample(i % 3, i / 3, Point(double(i % 3), double(i / 3), 0));
  std::stringstream file;
  CR::write_range_image(file, image);
  Mesh mesh;
  BOOST_TEST(CGAL::IO::read_PLY(file, mesh));
  BOOST_TEST(mesh.number_of_vertices() == 9u);
  BOOST_TEST(mesh.number_of_faces() == 0u);

  CR::Scan_file<Kernel> contents;
  contents.kind = CR::Scan_file<Kernel>::MESH;
  const auto says = [](const std::string& argument) {
    return [argument](const std::invalid_argument& e) {
      const std::string what = e.what();
      BOOST_TEST_MESSAGE(what);
      return what.rfind(argument + " has no faces: ", 0) == 0 && what.find("read_scan()") != std::string::npos;
    };
  };
  for (const Mesh& m : {Mesh(), mesh}) {
    BOOST_CHECK_EXCEPTION(Scan{m}, std::invalid_argument, says("Scan: mesh"));
    BOOST_CHECK_EXCEPTION(CR::register_meshes(m, good_mesh()), std::invalid_argument, says("register_meshes: source"));
    BOOST_CHECK_EXCEPTION(CR::register_meshes(good_mesh(), m), std::invalid_argument, says("register_meshes: target"));
    contents.mesh = m;
    BOOST_CHECK_EXCEPTION(Scan{contents}, std::invalid_argument, says("Scan: file"));
  }
}

BOOST_AUTO_TEST_CASE(meshes_refined)
{
  const auto is_sound_refinement = [](const auto& refined) {
    BOOST_TEST(std::isfinite(refined.residual));
    BOOST_TEST(std::isfinite(refined.overlap));
    BOOST_TEST(!matrix_of(refined.covariance).hasNaN()); // infinite where nothing is determined
    BOOST_TEST(refined.iterations <= 1000);
    return is_rigid(refined.motion);
  };
  for_each_mesh([&](const Mesh& mesh) {
    const Mesh& good = good_mesh();
    const CGAL::Aff_transformation_3<Kernel> identity(CGAL::IDENTITY);
    check("refine_motion", "source", [&] { return is_sound_refinement(CR::refine_motion(mesh, good, identity)); });
    check("refine_motion", "target", [&] { return is_sound_refinement(CR::refine_motion(good, mesh, identity)); });
    check("refine_motion", "source", [&] { return is_sound_refinement(CR::refine_motion(mesh, mesh, identity)); });
  });
}

BOOST_AUTO_TEST_CASE(meshes_described)
{
  for_each_mesh([](Mesh mesh) {
    auto curvatures = mesh.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:k").first;
    auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:t").first;
    for (double radius : {0., 0.3})
      check("principal_curvatures", "mesh", [&] {
        CR::principal_curvatures(mesh, curvatures, p::neighbor_radius(radius));
        return std::all_of(mesh.vertices().begin(), mesh.vertices().end(), [&](auto v) {
          const auto& k = curvatures[v];
          return std::isfinite(k.minimum) && std::isfinite(k.maximum) && k.minimum <= k.maximum &&
                 is_finite(CGAL::ORIGIN + k.minimum_direction) && is_finite(CGAL::ORIGIN + k.maximum_direction);
        });
      });
    check("surface_types", "mesh", [&] {
      const auto counts = CR::surface_types(mesh, types);
      return std::isfinite(counts.percent_smooth());
    });
    check("approximation_error", "mesh", [&] {
      const double error = CR::approximation_error(mesh);
      return std::isfinite(error) && error >= 0;
    });
    check("scan_extent", "mesh", [&] {
      const double extent = CR::scan_extent(mesh).mean();
      return std::isfinite(extent) && extent >= 0;
    });
    check("spatial_trihedra", "mesh", [&] {
      for (const auto& t : CR::spatial_trihedra(mesh))
        for (const auto v : t.ends)
          if (!mesh.is_valid(v)) return false;
      return true;
    });
  });
}

BOOST_AUTO_TEST_CASE(meshes_simplified)
{
  for_each_mesh([](const Mesh& mesh) {
    check("simplify_scan", "mesh", [&] {
      Mesh simplified = mesh;
      const std::size_t n = CR::simplify_scan(simplified);
      return is_sound(simplified) && n <= mesh.number_of_vertices();
    });
    check("simplify_scan", "mesh", [&] {
      Mesh simplified = mesh;
      CR::simplify_scan(simplified, p::number_of_vertices(10));
      return is_sound(simplified);
    });
  });
}

BOOST_AUTO_TEST_CASE(meshes_matched)
{
  const Mesh small = to_mesh(input("small", generated::bumps(6)));
  const auto are_rigid = [](const auto& matches) {
    return std::all_of(matches.begin(), matches.end(),
                       [](const auto& m) { return is_rigid(m.transformation) && std::isfinite(m.residual); });
  };
  for_each_mesh([&](const Mesh& mesh) {
    check("match_trihedra", "source", [&] { return are_rigid(CR::match_trihedra(mesh, small)); });
    check("match_trihedra", "target", [&] { return are_rigid(CR::match_trihedra(small, mesh)); });
  });
}

BOOST_AUTO_TEST_CASE(meshes_simulated)
{
  for_each_mesh([](const Mesh& mesh) {
    check("simulate_range_image", "mesh", [&] {
      const auto camera =
          CR::Range_camera<Kernel>::framing(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), Kernel::Vector_3(0, 0.3, -1), 12);
      const auto simulated = CR::simulate_range_image(mesh, camera);
      return std::all_of(simulated.image.points().begin(), simulated.image.points().end(), is_finite);
    });
  });
}

BOOST_AUTO_TEST_CASE(images)
{
  for (const Input& i : inputs())
    for (const Image& image : images_of(i)) BOOST_TEST_CONTEXT(i.name << ", sensor " << image.sensor().is_known())
      {
        current_input = i.name;
        check("Scan", "image", [&] { return is_sound(Scan(image)); });
        check("sampling_distance", "image", [&] {
          const double s = CR::sampling_distance(image);
          return std::isfinite(s) && s >= 0;
        });
        check("triangulate_range_image", "image", [&] {
          Mesh mesh;
          CR::triangulate_range_image(image, mesh);
          return is_sound(mesh);
        });
        check("estimate_sensor", "image", [&] {
          const Sensor sensor = CR::estimate_sensor(image);
          return sensor.is_perspective()
                     ? is_finite(sensor.viewpoint())
                     : !sensor.is_orthographic() || is_finite(CGAL::ORIGIN + sensor.viewing_direction());
        });
        check("approximation_error", "image", [&] {
          const double error = CR::approximation_error(image);
          return std::isfinite(error) && error >= 0;
        });
        check("scan_extent", "image", [&] {
          const double extent = CR::scan_extent(image).mean();
          return std::isfinite(extent) && extent >= 0;
        });
        // What is written is read as it was; no samples are no image.
        std::stringstream file;
        CR::write_range_image(file, image);
        Image again;
        if (image.points().empty()) {
          BOOST_CHECK_THROW(CR::read_range_image(file, again), CR::IO_error);
          continue;
        }
        CR::read_range_image(file, again);
        BOOST_TEST((again.points() == image.points()));
        BOOST_TEST((again.grid() == image.grid()));
        BOOST_TEST(again.columns() == image.columns());
      }
  BOOST_CHECK_THROW(Image(2, 2).set_sample(0, 0, Point(0, std::nan(""), 0)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(points_without_faces)
{
  for (const Input& i : inputs()) BOOST_TEST_CONTEXT(i.name)
    {
      current_input = i.name;
      const std::vector<Point> points = to_points(i);
      const Point above(0.3, 0.4, 3), first = points.empty() || !is_finite(points[0]) ? above : points[0];
      const Kernel::Vector_3 down(0, 0, -1);
      const auto triangulated = [&](const auto& np) {
        Mesh mesh;
        CR::triangulate_points(points, mesh, np);
        return is_sound(mesh);
      };
      check("triangulate_points", "point", [&] { return triangulated(p::default_values()); });
      check("triangulate_points", "point", [&] { return triangulated(p::viewpoint(above)); });
      check("triangulate_points", "point", [&] { return triangulated(p::viewpoint(first)); });
      check("triangulate_points", "point", [&] { return triangulated(p::viewing_direction(down)); });
      check("Scan", "point", [&] { return is_sound(Scan(points)); });
      check("Scan", "point", [&] { return is_sound(Scan(points, p::viewpoint(above))); });
      check("Scan", "point", [&] { return is_sound(Scan(points, p::viewing_direction(down))); });
      check("rigid_motion", "source", [&] {
        const auto motion = CR::rigid_motion(points, points);
        return !motion || is_rigid(*motion);
      });
    }
}

// Faces that a mesh cannot have, as a file gives them.
BOOST_AUTO_TEST_CASE(files)
{
  const std::string name = "degenerate_input.off";
  for (const Input& i : inputs()) BOOST_TEST_CONTEXT(i.name)
    {
      current_input = i.name;
      std::ostringstream off;
      off.precision(17);
      off << "OFF\n" << i.points.size() << " " << i.faces.size() << " 0\n";
      for (const Vector& q : i.points) off << q.x() << " " << q.y() << " " << q.z() << "\n";
      for (const auto& f : i.faces) {
        off << f.size();
        for (const auto v : f) off << " " << v;
        off << "\n";
      }
      try {
        std::ofstream(name) << off.str();
        const auto file = CR::read_scan<Kernel>(name);
        BOOST_TEST(is_sound(file.mesh));
        check("Scan", "", [&] { return is_sound(Scan(file)); });
        check("register_scans", "", [&] {
          try {
            const Scan scan(file);
            return is_sound(CR::register_scans(scan, Scan(good_mesh())));
          } catch (const std::invalid_argument&) { // of Scan
            return true;
          }
        });
      } catch (const CR::IO_error& e) {
        BOOST_TEST(std::string(e.what()).rfind(name + ":", 0) == 0, e.what());
      }
    }
  std::remove(name.c_str());
}
