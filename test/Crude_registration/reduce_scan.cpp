#define BOOST_TEST_MODULE reduce_scan
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/reduction/group_samples.h>
#include <CGAL/Crude_registration/internal/reduction/reduce_scan.h>
#include <CGAL/Crude_registration/internal/reduction/sample_surface.h>
#include <CGAL/Crude_registration/internal/reduction/scale_scan.h>
#include <CGAL/Crude_registration/internal/simulation/Statue.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

using namespace CGAL::Crude_registration::internal;
using generated::pi;
using generated::Random;

namespace {

const Flat_sensor no_sensor;

Flat_sensor orthographic(const Vector& direction)
{
  return {Flat_sensor::ORTHOGRAPHIC, direction.normalized()};
}

Flat_sensor perspective(const Vector& viewpoint)
{
  return {Flat_sensor::PERSPECTIVE, viewpoint};
}

Flat_sensor moved(Flat_sensor sensor, const Rigid_motion& motion, double unit)
{
  if (sensor.kind == Flat_sensor::ORTHOGRAPHIC) sensor.vector = motion.rotation * sensor.vector;
  if (sensor.kind == Flat_sensor::PERSPECTIVE) sensor.vector = motion(unit * sensor.vector);
  return sensor;
}

// The faces that the sensor can see but for what hides them.
Flat_mesh facing(const Flat_mesh& mesh, const Flat_sensor& sensor)
{
  Flat_mesh seen;
  seen.points = mesh.points;
  for (const auto& f : mesh.faces)
    if (sensor.towards(mesh.points[std::size_t(f[0])]).dot(area_vector(mesh, f)) < 0) seen.faces.push_back(f);
  return seen;
}

double area(const Flat_mesh& mesh)
{
  double sum = 0;
  for (const auto& f : mesh.faces) sum += 0.5 * area_vector(mesh, f).norm();
  return sum;
}

struct Case
{
  const char* name;
  Flat_mesh mesh;
  Flat_sensor sensor;
};

// Meshes without symmetry, dense enough for their vertices to be samples.
const std::vector<Case>& scans()
{
  static const std::vector<Case> cases = [] {
    const Flat_mesh statue = Statue(3).surface(60);
    const Flat_sensor along = orthographic({1, 0.4, -0.2}), from = perspective({-2, 3, 1});
    return std::vector<Case>{{"closed", statue, no_sensor},
                             {"orthographic", facing(statue, along), along},
                             {"perspective", facing(statue, from), from},
                             {"bumps", generated::bumps(130), no_sensor}};
  }();
  return cases;
}

// How many surfels of a level have no counterpart in another one that is `unit` times as large, in the same frame, and
// how many have one that is described differently.
struct Difference
{
  std::size_t missing = 0, described = 0;
};

Difference difference(const Surfel_level& level, const Surfel_level& other, double unit)
{
  std::vector<Vector> points;
  for (const Surfel& s : other.surfels) points.push_back(s.position.cast<double>() / unit);
  const double near = 1e-3 * double(level.spacing);
  const Point_grid grid(points, double(level.spacing));
  Difference result;
  for (std::size_t i = 0; i < level.surfels.size(); ++i) {
    const Surfel& s = level.surfels[i];
    bool is_found = false, is_alike = false;
    grid.for_each_within(s.position.cast<double>(), near, [&](std::int32_t k, double) {
      const auto j = std::size_t(k);
      const Surfel& t = other.surfels[j];
      if (s.normal.dot(t.normal) < 0.99999f || level.weights[i] != other.weights[j]) return;
      is_found = true;
      is_alike = is_alike || (std::abs(s.minimal_curvature - t.minimal_curvature) < 1e-2f &&
                              std::abs(s.maximal_curvature - t.maximal_curvature) < 1e-2f &&
                              (level.borders.empty() || level.borders[i] == other.borders[j]));
    });
    result.missing += !is_found;
    result.described += is_found && !is_alike;
  }
  return result;
}

// The same scan up to rounding, `unit` times as large. A few samples may lie on the border of two cells; in a cell
// that the surface crosses at an edge, which sheet is first depends on the order of the samples. What such a surfel
// says changes the description of its neighbours.
void check_same(const Reduced_scan& a, const Reduced_scan& b, double unit, std::size_t tolerated)
{
  BOOST_TEST(b.number_of_samples == a.number_of_samples);
  BOOST_TEST(std::abs(b.spacing / unit / a.spacing - 1) < 1e-6);
  BOOST_TEST(std::abs(b.extent / unit / a.extent - 1) < 1e-6);
  BOOST_TEST(b.depths.is_known() == a.depths.is_known());
  for (const auto level : {&Reduced_scan::coarse, &Reduced_scan::fine}) {
    const Surfel_level &l = a.*level, &m = b.*level;
    BOOST_TEST(std::abs(double(m.spacing) / unit / double(l.spacing) - 1) < 1e-6);
    BOOST_TEST(std::abs(m.height_noise - l.height_noise) < 0.01f);
    BOOST_TEST(std::abs(m.normal_noise - l.normal_noise) < 0.01f);
    for (const Difference& d : {difference(l, m, unit), difference(m, l, 1 / unit)}) {
      BOOST_TEST(d.missing <= tolerated);
      BOOST_TEST(d.described <= 20 * tolerated);
    }
  }
}

// A box from the origin to `size` of twelve faces.
Flat_mesh box(const Vector& size)
{
  Flat_mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(Vector(i & 1 ? size.x() : 0, i & 2 ? size.y() : 0, i & 4 ? size.z() : 0));
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// A closed cylinder of height 1 around the z axis whose side is `segments` pairs of needles.
Flat_mesh cylinder(int segments, double radius)
{
  Flat_mesh mesh;
  for (int i = 0; i < segments; ++i)
    for (double z : {0., 1.})
      mesh.points.push_back(
          Vector(radius * std::cos(2 * pi * i / segments), radius * std::sin(2 * pi * i / segments), z));
  mesh.points.push_back(Vector(0, 0, 0));
  mesh.points.push_back(Vector(0, 0, 1));
  const int n = 2 * segments;
  for (int a = 0; a < n; a += 2) {
    const int b = (a + 2) % n;
    mesh.faces.push_back({a, b, b + 1});
    mesh.faces.push_back({a, b + 1, a + 1});
    mesh.faces.push_back({n, b, a});
    mesh.faces.push_back({n + 1, a + 1, b + 1});
  }
  return mesh;
}

// The distance of a place to the nearest surfel, in spacings.
double distance_to(const Surfel_level& level, const Vector& own)
{
  double nearest = 1e30;
  for (const Surfel& s : level.surfels) nearest = (std::min)(nearest, (s.position.cast<double>() - own).norm());
  return nearest / double(level.spacing);
}

void check_finite(const Reduced_scan& scan)
{
  BOOST_TEST(std::isfinite(scan.spacing));
  BOOST_TEST(std::isfinite(scan.extent));
  BOOST_TEST(scan.own_from_input.translation.allFinite());
  const Matrix& r = scan.own_from_input.rotation;
  BOOST_TEST((r * r.transpose() - Matrix::Identity()).norm() < 1e-9);
  BOOST_TEST(std::abs(r.determinant() - 1) < 1e-9);
  for (const Surfel_level* level : {&scan.coarse, &scan.fine}) {
    BOOST_TEST(level->surfels.size() <= Surfel_field::maximum_size);
    for (const Surfel& s : level->surfels) {
      BOOST_TEST_REQUIRE(s.position.allFinite());
      BOOST_TEST_REQUIRE(std::abs(s.normal.norm() - 1) < 1e-5f);
      BOOST_TEST_REQUIRE(!std::isnan(s.minimal_curvature));
      BOOST_TEST_REQUIRE(!std::isnan(s.maximal_curvature));
    }
    BOOST_TEST(!std::isnan(level->height_noise));
    BOOST_TEST(!std::isnan(level->normal_noise));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(a_moved_scan_is_the_same_in_its_own_frame)
{
  for (const Case& c : scans()) BOOST_TEST_CONTEXT(c.name)
    {
      const Reduced_scan scan = reduce_scan(c.mesh, c.sensor);
      Random random(1);
      for (double away : {2., 1e4}) {
        const Rigid_motion motion = random.motion(away);
        const Reduced_scan other = reduce_scan(generated::moved(c.mesh, motion), moved(c.sensor, motion, 1));
        check_same(scan, other, 1, 2);
        for (const Vector& p : {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)})
          BOOST_TEST((other.own_from_input(motion(p)) - scan.own_from_input(p)).norm() < 1e-9 * away);
      }
    }
}

BOOST_AUTO_TEST_CASE(the_unit_does_not_matter)
{
  for (const Case& c : scans()) BOOST_TEST_CONTEXT(c.name)
    {
      const Reduced_scan scan = reduce_scan(c.mesh, c.sensor);
      for (double unit : {1e-9, 1e-3, 0.3048, 1e3, 1e9}) {
        Rigid_motion same;
        check_same(scan, reduce_scan(generated::moved(c.mesh, same, unit), moved(c.sensor, same, unit)), unit, 4);
      }
    }
}

BOOST_AUTO_TEST_CASE(the_unit_does_not_matter_to_needles)
{
  Flat_mesh mesh = cylinder(2000, 0.1); // without its symmetry, so that it has a frame
  for (Vector& p : mesh.points) {
    const double wider = 1 + 5 * p.x() + 30 * p.x() * p.y();
    p = Vector((1.5 * p.x() * wider + 0.2) * (1 - 0.4 * p.z()), p.y() * wider * (1 - 0.4 * p.z()), p.z());
  }
  const Reduced_scan scan = reduce_scan(mesh, no_sensor);
  for (double unit : {1e-9, 1e-3, 0.3048, 1e3, 1e9})
    check_same(scan, reduce_scan(generated::moved(mesh, Rigid_motion(), unit), no_sensor), unit, 4);
}

BOOST_AUTO_TEST_CASE(the_order_of_vertices_and_faces_does_not_matter)
{
  for (const Case& c : scans()) BOOST_TEST_CONTEXT(c.name)
    {
      const Reduced_scan scan = reduce_scan(c.mesh, c.sensor);
      for (unsigned seed : {1u, 2u}) check_same(scan, reduce_scan(generated::shuffled(c.mesh, seed), c.sensor), 1, 6);
    }
}

BOOST_AUTO_TEST_CASE(the_same_bits_twice)
{
  const Case& c = scans()[1];
  const Reduced_scan a = reduce_scan(c.mesh, c.sensor), b = reduce_scan(c.mesh, c.sensor);
  for (const auto level : {&Reduced_scan::coarse, &Reduced_scan::fine}) {
    BOOST_TEST_REQUIRE((a.*level).surfels.size() == (b.*level).surfels.size());
    for (std::size_t i = 0; i < (a.*level).surfels.size(); ++i) {
      BOOST_TEST(((a.*level).surfels[i].position == (b.*level).surfels[i].position));
      BOOST_TEST(((a.*level).surfels[i].normal == (b.*level).surfels[i].normal));
      BOOST_TEST((a.*level).surfels[i].maximal_curvature == (b.*level).surfels[i].maximal_curvature);
    }
  }
}

BOOST_AUTO_TEST_CASE(surfels_stand_for_the_samples)
{
  for (const Case& c : scans()) BOOST_TEST_CONTEXT(c.name)
    {
      const Reduced_scan scan = reduce_scan(c.mesh, c.sensor);
      BOOST_TEST(std::abs(scan.spacing * scan.spacing * double(scan.number_of_samples) / area(c.mesh) - 1) < 1e-9);
      BOOST_TEST(scan.number_of_samples <= c.mesh.points.size());
      BOOST_TEST(scan.fine.spacing < scan.coarse.spacing);
      BOOST_TEST(scan.coarse.surfels.size() < scan.fine.surfels.size());
      for (const Surfel_level* level : {&scan.coarse, &scan.fine}) {
        BOOST_TEST(level->weights.size() == level->surfels.size());
        double weights = 0;
        for (float w : level->weights) weights += double(w);
        BOOST_TEST(weights <= double(scan.number_of_samples));
        BOOST_TEST(weights > 0.97 * double(scan.number_of_samples));
      }
      // On the surface, with its normal: as near to samples as cells are large.
      std::vector<Vector> points;
      for (const Vector& p : c.mesh.points) points.push_back(scan.own_from_input(p));
      const std::vector<Vector> normals = vertex_normals(c.mesh);
      const Point_grid grid(points, double(scan.fine.spacing));
      for (const Surfel& s : scan.fine.surfels) {
        bool is_near = false;
        grid.for_each_within(s.position.cast<double>(), 0.87 * double(scan.fine.spacing), [&](std::int32_t i, double) {
          const Vector n = scan.own_from_input.rotation * normals[std::size_t(i)];
          is_near = is_near || n.cast<float>().dot(s.normal) > 0.5f;
        });
        BOOST_TEST(is_near);
      }
    }
}

// The root of the mean square of how far surfels lie off a surface.
template <class Height>
double off_surface(const Oriented_samples& samples, float cell, bool has_edges, const Height& height)
{
  const Surfel_level level = group_samples(samples.points, samples.normals, {}, cell, to_the_end(), has_edges);
  BOOST_TEST(level.surfels.size() > 100u);
  double sum = 0;
  for (const Surfel& s : level.surfels) sum += std::pow(height(s.position.cast<double>()), 2);
  return std::sqrt(sum / double(level.surfels.size()));
}

BOOST_AUTO_TEST_CASE(surfels_of_points_lie_on_edges_and_on_what_is_bent)
{
  const float cell = 0.1f;
  Oriented_samples edge, ball;
  const auto put = [](Oriented_samples& samples, const Vector& point, const Vector& normal) {
    samples.points.push_back(point.cast<float>());
    samples.normals.push_back(normal.cast<float>());
  };
  // Two faces that meet at right angles, oblique to the cells.
  const Matrix turn = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
  const Counter_random random(7);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double along = 4 * random.uniform(4 * i), down = -0.15 * random.uniform(4 * i + 1);
    const bool is_first = i % 2 == 0;
    put(edge, turn * (is_first ? Vector(down, along, 0) : Vector(0, along, down)),
        turn * (is_first ? Vector(0, 0, 1) : Vector(1, 0, 0)));
    const Vector on_ball =
        unit_or_zero(Vector(random.normal(4 * i), random.normal(4 * i + 1), random.normal(4 * i + 2)));
    put(ball, 0.5 * on_ball, on_ball);
  }
  const auto from_edge = [&](const Vector& p) {
    const Vector q = turn.transpose() * p;
    return q[0] <= 0 && q[2] <= 0 ? (std::min)(-q[0], -q[2])
                                  : Vector((std::max)(q[0], 0.), 0, (std::max)(q[2], 0.)).norm();
  };
  const auto from_ball = [](const Vector& p) { return p.norm() - 0.5; };
  BOOST_TEST(off_surface(edge, cell, true, from_edge) < 0.65 * off_surface(edge, cell, false, from_edge));
  BOOST_TEST(off_surface(ball, cell, true, from_ball) < 0.3 * off_surface(ball, cell, false, from_ball));
}

// How far off the places of surfels may be, against how far off they are on a sphere; and of a cube along the edges
// alone.
BOOST_AUTO_TEST_CASE(variance_of_known_surfaces)
{
  for (const double radius : {0.5, 20.}) {
    const Reduced_scan scan = reduce_scan(generated::sphere(60, radius), no_sensor);
    double squares = 0, told = 0;
    const Vector_f middle = (scan.own_from_input(Vector(Vector::Zero()))).cast<float>();
    for (const Surfel& s : scan.coarse.surfels) {
      squares += std::pow(radius - double((s.position - middle).norm()), 2);
      told += double(s.variance);
    }
    BOOST_TEST(told < 4 * squares, told << " and " << squares);
    BOOST_TEST(told > squares / 4, told << " and " << squares);
    const Reduced_scan larger = scaled(scan, 3);
    for (std::size_t i = 0; i < scan.fine.surfels.size(); ++i)
      BOOST_TEST_REQUIRE(larger.fine.surfels[i].variance == 9 * scan.fine.surfels[i].variance);
  }
  Flat_mesh cube;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const auto n = std::int32_t(cube.points.size());
      for (const int u : {-1, 1})
        for (const int v : {-1, 1}) {
          Vector corner;
          corner[axis] = side;
          corner[(axis + 1) % 3] = u;
          corner[(axis + 2) % 3] = v;
          cube.points.push_back(corner);
        }
      if (side > 0) {
        cube.faces.push_back({n, n + 2, n + 1});
        cube.faces.push_back({n + 1, n + 2, n + 3});
      } else {
        cube.faces.push_back({n, n + 1, n + 2});
        cube.faces.push_back({n + 1, n + 3, n + 2});
      }
    }
  const Reduced_scan scan = reduce_scan(cube, no_sensor);
  int flat = 0, bent = 0;
  for (const Surfel& s : scan.fine.surfels) {
    const float axial = s.normal.cwiseAbs().maxCoeff();
    const double deviation = std::sqrt(double(s.variance)) / double(scan.fine.spacing);
    if (axial < 0.9f) {
      ++bent;
      BOOST_TEST(deviation > 0.03);
    } else if (axial > 0.999999f) {
      ++flat;
      BOOST_TEST(deviation < 1e-3);
    }
  }
  BOOST_TEST(flat > 1000);
  BOOST_TEST(bent > 100);
}

BOOST_AUTO_TEST_CASE(curvatures_of_known_surfaces)
{
  const auto median = [](const Surfel_level& level, float Surfel::*curvature) {
    std::vector<double> values;
    for (std::size_t i = 0; i < level.surfels.size(); ++i)
      if (!level.borders[i]) values.push_back(double(level.surfels[i].*curvature) / double(level.spacing));
    BOOST_TEST_REQUIRE(values.size() > 100u);
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  const auto minimal = [&](const Reduced_scan& s) { return median(s.coarse, &Surfel::minimal_curvature); };
  const auto maximal = [&](const Reduced_scan& s) { return median(s.coarse, &Surfel::maximal_curvature); };

  // Convex is positive. The chord of the neighbourhood is a few per cent shorter than the arc.
  Flat_mesh sphere = generated::sphere(40, 2);
  const Reduced_scan convex = reduce_scan(sphere, no_sensor);
  BOOST_TEST(std::abs(minimal(convex) - 0.5) < 0.05);
  BOOST_TEST(std::abs(maximal(convex) - 0.5) < 0.05);
  for (auto& f : sphere.faces) std::swap(f[0], f[1]);
  const Reduced_scan concave = reduce_scan(sphere, no_sensor);
  BOOST_TEST(std::abs(minimal(concave) + 0.5) < 0.05);
  BOOST_TEST(std::abs(maximal(concave) + 0.5) < 0.05);

  const Reduced_scan side = reduce_scan(
      generated::grid(
          160, 100,
          [](double u, double v) { return Vector(2 * std::cos(2 * pi * u), 2 * std::sin(2 * pi * u), 8 * v); }, 0.25,
          true),
      no_sensor);
  BOOST_TEST(std::abs(minimal(side)) < 0.03);
  BOOST_TEST(std::abs(maximal(side) - 0.5) < 0.05);

  // z = (x^2 - y^2) / 4: curvatures of about 1/2, of opposite signs.
  const Reduced_scan saddle = reduce_scan(generated::grid(120, 120,
                                                          [](double u, double v) {
                                                            const double x = u - 0.5, y = v - 0.5;
                                                            return Vector(x, y, (x * x - y * y) / 4);
                                                          }),
                                          no_sensor);
  BOOST_TEST(std::abs(minimal(saddle) + 0.5) < 0.06);
  BOOST_TEST(std::abs(maximal(saddle) - 0.5) < 0.06);

  for (const Reduced_scan* scan : {&convex, &concave, &side, &saddle})
    for (const Surfel& s : scan->coarse.surfels) BOOST_TEST(s.minimal_curvature <= s.maximal_curvature);
}

BOOST_AUTO_TEST_CASE(borders)
{
  const Reduced_scan closed = reduce_scan(generated::sphere(40, 1), no_sensor);
  BOOST_TEST(std::count(closed.coarse.borders.begin(), closed.coarse.borders.end(), 1) <
             std::ptrdiff_t(closed.coarse.borders.size() / 100));

  const Reduced_scan open = reduce_scan(generated::bumps(130), no_sensor);
  const Rigid_motion input_from_own = open.own_from_input.inverse();
  const double spacing = double(open.coarse.spacing);
  std::size_t inside = 0, at_border = 0, wrong = 0;
  for (std::size_t i = 0; i < open.coarse.surfels.size(); ++i) {
    const Vector p = input_from_own(open.coarse.surfels[i].position.cast<double>());
    const double d = (std::min)({p.x(), 1 - p.x(), p.y(), 1 - p.y()});
    if (d > 3 * spacing) wrong += open.coarse.borders[i], ++inside;
    else if (d < 0.5 * spacing) wrong += !open.coarse.borders[i], ++at_border;
  }
  BOOST_TEST(inside > 100u);
  BOOST_TEST(at_border > 100u);
  BOOST_TEST(wrong <= 0.05 * double(inside + at_border));
}

BOOST_AUTO_TEST_CASE(noise_is_that_of_the_scan)
{
  float height = -1, turn = -1;
  for (double noise : {0., 0.002, 0.008}) {
    const Reduced_scan scan = reduce_scan(generated::bumps(130, 1, noise), no_sensor);
    BOOST_TEST(scan.fine.height_noise > height);
    BOOST_TEST(scan.fine.normal_noise > turn);
    height = scan.fine.height_noise;
    turn = scan.fine.normal_noise;
  }
  const Reduced_scan plane =
      reduce_scan(generated::grid(130, 130, [](double u, double v) { return Vector(u, v, 0); }), no_sensor);
  BOOST_TEST(plane.fine.height_noise < 1e-4f);
  BOOST_TEST(plane.fine.normal_noise < 1e-2f);
}

BOOST_AUTO_TEST_CASE(both_sides_of_a_thin_plate)
{
  // Thinner than any cell.
  Flat_mesh plate = generated::grid(100, 100, [](double u, double v) { return Vector(u, v, 1e-4); });
  const Flat_mesh below = generated::grid(100, 100, [](double u, double v) { return Vector(v, u, 0); });
  const auto first = std::int32_t(plate.points.size());
  plate.points.insert(plate.points.end(), below.points.begin(), below.points.end());
  for (const auto& f : below.faces) plate.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  const Reduced_scan scan = reduce_scan(plate, no_sensor);
  const Vector_f up = (scan.own_from_input.rotation * Vector::UnitZ()).cast<float>();
  for (const Surfel_level* level : {&scan.coarse, &scan.fine}) {
    const auto above = std::count_if(level->surfels.begin(), level->surfels.end(),
                                     [&](const Surfel& s) { return s.normal.dot(up) > 0; });
    const double n = double(level->surfels.size());
    BOOST_TEST(std::abs(double(above) - n / 2) < 0.02 * n);
    for (const Surfel& s : level->surfels) BOOST_TEST(std::abs(s.normal.dot(up)) > 0.999f);
  }
}

// What twelve faces tell is told by samples of them.
BOOST_AUTO_TEST_CASE(huge_faces_get_samples)
{
  const Vector size(3, 1, 0.5);
  const Flat_mesh mesh = box(size);
  const Reduced_scan scan = reduce_scan(mesh, no_sensor);
  check_finite(scan);
  BOOST_TEST(scan.coarse.surfels.size() > 500u);
  BOOST_TEST(scan.fine.surfels.size() > 5000u);
  BOOST_TEST(!scan.depths.is_known());
  const Rigid_motion input_from_own = scan.own_from_input.inverse();
  for (const Surfel_level* level : {&scan.coarse, &scan.fine})
    for (const Surfel& s : level->surfels) {
      const Vector p = input_from_own(s.position.cast<double>());
      double depth = 1e30; // below the nearest side
      for (int k = 0; k < 3; ++k) depth = (std::min)({depth, p[k], size[k] - p[k]});
      BOOST_TEST(depth > -1e-5);
      BOOST_TEST(depth < 0.5 * double(level->spacing)); // cells at an edge hold both sides
    }
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Vector p = (0.5 * (random.vector() + Vector(1, 1, 1))).cwiseProduct(size);
    p[i % 3] = i % 2 == 0 ? 0 : size[i % 3];
    for (const Surfel_level* level : {&scan.coarse, &scan.fine})
      BOOST_TEST(distance_to(*level, scan.own_from_input(p)) < 1.8);
  }
}

// Needles do not get more samples than their area asks for, and the spacing remains one of the surface.
BOOST_AUTO_TEST_CASE(needles_get_samples_by_their_area)
{
  for (int segments : {20, 100, 200, 2000, 20000}) {
    BOOST_TEST_CONTEXT(segments << " segments")
    {
      const Flat_mesh mesh = cylinder(segments, 0.1);
      const Reduced_scan scan = reduce_scan(mesh, no_sensor);
      check_finite(scan);
      BOOST_TEST(scan.number_of_samples > 10000u);
      BOOST_TEST(scan.number_of_samples < 1000000u);
      BOOST_TEST(scan.fine.surfels.size() > 5000u);
      BOOST_TEST(scan.fine.surfels.size() < 30000u);
      Random random(3);
      for (int i = 0; i < 100; ++i) {
        const double a = pi * random.symmetric();
        const Vector p(0.1 * std::cos(a), 0.1 * std::sin(a), 0.5 * (1 + random.symmetric()));
        BOOST_TEST(distance_to(scan.fine, scan.own_from_input(p)) < 1.8);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(free_space)
{
  // Closed, or seen from all sides: none.
  BOOST_TEST(!reduce_scan(generated::sphere(40, 1), no_sensor).depths.is_known());
  BOOST_TEST(!reduce_scan(generated::torus(120, 60, 2, 1), no_sensor).depths.is_known());

  // Without a sensor nothing is known of it, though all of the surface faces one way.
  const Flat_mesh bumps = generated::bumps(130);
  BOOST_TEST(!reduce_scan(bumps, no_sensor).depths.is_known());
  const auto is_free = [](const Reduced_scan& scan, const Vector& p) {
    return scan.depths.in_front(scan.own_from_input(p).cast<float>()) > 0;
  };
  const std::vector<Flat_sensor> sensors = {orthographic({0, 0, -1}), orthographic({0.2, 0.1, -1}),
                                            perspective({0.5, 0.6, 3})};
  for (const Flat_sensor& sensor : sensors) {
    const Reduced_scan scan = reduce_scan(bumps, sensor);
    BOOST_TEST(scan.depths.is_known());
    BOOST_TEST(is_free(scan, {0.5, 0.5, 0.4}));
    BOOST_TEST(is_free(scan, {0.3, 0.7, 0.3}));
    BOOST_TEST(!is_free(scan, {0.5, 0.5, -0.2}));
    BOOST_TEST(!is_free(scan, {0.3, 0.7, -0.3}));
    BOOST_TEST(!is_free(scan, {3, 0.5, 0.1}));
    // Nothing of what was seen hides something else that was.
    std::size_t hidden = 0;
    for (const Vector& p : bumps.points) {
      const float before = scan.depths.in_front(scan.own_from_input(p).cast<float>());
      hidden += before > float(scan.spacing);
    }
    BOOST_TEST(hidden == 0u);
  }
}

// Faces that bridge a depth edge are seen at a grazing angle: they are not part of the surface.
BOOST_AUTO_TEST_CASE(bridges_over_depth_edges_are_left_out)
{
  const int n = 160;
  const Flat_mesh step = generated::grid(
      n, n, [](double u, double v) { return Vector(u, v, u < 0.5 ? 0.3 : 0.); }, 0);
  const Reduced_scan scan = reduce_scan(step, orthographic({0, 0, -1}));
  const Rigid_motion input_from_own = scan.own_from_input.inverse();
  for (const Surfel& s : scan.fine.surfels) {
    const double z = input_from_own(s.position.cast<double>()).z();
    BOOST_TEST((std::abs(z) < 0.01 || std::abs(z - 0.3) < 0.01));
  }
}

BOOST_AUTO_TEST_CASE(isolated_vertices_and_faces_without_area_do_not_count)
{
  const Flat_mesh mesh = generated::bumps(130);
  Flat_mesh spoilt = mesh;
  for (int i = 0; i < 500; ++i) spoilt.points.push_back(Vector(5, 5, 5));
  const auto n = std::int32_t(mesh.points.size());
  spoilt.faces.push_back({n, n + 1, n + 2});
  spoilt.faces.push_back({0, 0, 1});
  const Reduced_scan a = reduce_scan(mesh, no_sensor), b = reduce_scan(spoilt, no_sensor);
  BOOST_TEST(a.number_of_samples == b.number_of_samples);
  BOOST_TEST(a.spacing == b.spacing);
  BOOST_TEST(a.fine.surfels.size() == b.fine.surfels.size());
}

BOOST_AUTO_TEST_CASE(nothing_to_prepare)
{
  Flat_mesh points, flat, duplicate;
  points.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)};
  flat.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0)};
  flat.faces = {{0, 1, 2}};
  duplicate.points = {Vector(0, 0, 0), Vector(1, 0, 0)};
  duplicate.faces = {{0, 1, 0}};
  for (const Flat_mesh& mesh : {Flat_mesh(), points, flat, duplicate})
    for (const Flat_sensor& sensor : {no_sensor, orthographic({0, 0, -1}), perspective({0, 0, 1})}) {
      const Reduced_scan scan = reduce_scan(mesh, sensor);
      BOOST_TEST(scan.number_of_samples == 0u);
      BOOST_TEST(scan.fine.surfels.empty());
      BOOST_TEST(scan.coarse.surfels.empty());
      BOOST_TEST(!scan.depths.is_known());
      check_finite(scan);
    }
}

BOOST_AUTO_TEST_CASE(a_vertex_at_the_viewpoint)
{
  const Flat_mesh mesh = generated::bumps(130);
  const Reduced_scan scan = reduce_scan(mesh, perspective(mesh.points[5000]));
  check_finite(scan);
  BOOST_TEST(scan.number_of_samples > 0u);
}

BOOST_AUTO_TEST_CASE(a_spike_and_an_island_far_away)
{
  const Flat_mesh mesh = generated::bumps(130);
  Flat_mesh spike = mesh, island = mesh;
  spike.points[5000] += Vector(0, 0, 1000);
  const Reduced_scan with_spike = reduce_scan(spike, no_sensor);
  check_finite(with_spike);
  BOOST_TEST(with_spike.number_of_samples < 1000000u);

  const auto n = std::int32_t(mesh.points.size());
  island.points.insert(island.points.end(), {Vector(1e4, 0, 0), Vector(1e4, 0.01, 0), Vector(1e4, 0, 0.01)});
  island.faces.push_back({n, n + 1, n + 2});
  const Reduced_scan with_island = reduce_scan(island, no_sensor), without = reduce_scan(mesh, no_sensor);
  check_finite(with_island);
  BOOST_TEST(std::abs(with_island.spacing / without.spacing - 1) < 0.01);
  for (const Surfel_level* level : {&with_island.coarse, &with_island.fine}) {
    std::size_t lost = 0;
    for (const Surfel& s : level->surfels) lost += level->field.nearest(s.position) < 0;
    BOOST_TEST(lost < 3u);
  }
}

// Far more surface elements than surfels can be.
BOOST_AUTO_TEST_CASE(dust_takes_larger_cells)
{
  Flat_mesh dust;
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const Vector p = random.vector();
    const auto k = std::int32_t(dust.points.size());
    dust.points.insert(dust.points.end(), {p, p + 1e-3 * random.vector(), p + 1e-3 * random.vector()});
    dust.faces.push_back({k, k + 1, k + 2});
  }
  check_finite(reduce_scan(dust, no_sensor));
}

// A slope so steep that its samples are no surface ends lines of sight as well as any other.
BOOST_AUTO_TEST_CASE(what_is_no_surface_was_seen_all_the_same)
{
  Flat_mesh mesh;
  std::vector<Vector> seen;
  constexpr int columns = 80, rows = 40, half = columns / 2;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      seen.push_back(Vector(c, r, c < half ? 0 : -20. * (c - half)));
      if (c < half) mesh.points.push_back(seen.back());
    }
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < half; ++c) {
      const std::int32_t a = r * half + c;
      mesh.faces.push_back({a, a + 1, a + half + 1});
      mesh.faces.push_back({a, a + half + 1, a + half});
    }
  const Flat_sensor sensor = orthographic(Vector(0, 0, -1));
  const Reduced_scan of_surface = reduce_scan(mesh, sensor),
                     of_all = reduce_scan(mesh, sensor, {}, to_the_end(), &seen);
  BOOST_TEST_REQUIRE((of_surface.depths.is_known() && of_all.depths.is_known()));
  const auto in_front = [](const Reduced_scan& scan, const Vector& p) {
    return scan.depths.in_front(scan.own_from_input(p).cast<float>());
  };
  const Counter_random random(29);
  std::size_t over_slope = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const Vector p(random.uniform(3 * k) * (columns - 1), random.uniform(3 * k + 1) * (rows - 1),
                   600 * random.uniform(3 * k + 2) - 500);
    // No more than is behind all samples around it, in the columns on either side.
    double highest = -1e9;
    for (const Vector& q : seen)
      if (std::abs(q.x() - p.x()) <= 1 && std::abs(q.y() - p.y()) <= 1) highest = (std::max)(highest, q.z());
    BOOST_TEST(double(in_front(of_all, p)) < p.z() - highest + 1e-3);
    // The same where the surface is; the slope is known besides.
    if (p.x() < half - 8) BOOST_TEST(in_front(of_all, p) == in_front(of_surface, p));
    if (p.x() > half + 8) BOOST_TEST(!(in_front(of_surface, p) > 0));
    if (p.x() > half + 8 && p.x() < columns - 8 && p.y() > 6 && p.y() < rows - 6 && p.z() > highest + 150) {
      ++over_slope;
      BOOST_TEST(in_front(of_all, p) > 0);
    }
  }
  BOOST_TEST(over_slope > 100u);
}
