#define BOOST_TEST_MODULE degenerate_shapes
#include <boost/test/unit_test.hpp>

#include "registration_checks.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Shapes that more than one motion maps to themselves: what is asked for has no answer, and registration has to say so.

using generated::Random;

namespace {

// A shape, sampled anew for each seed.
using Shape = std::function<Flat_mesh(unsigned seed)>;

Scan prepared(const Flat_mesh& flat)
{
  return Scan(mesh_of(flat));
}

Flat_mesh noisy(Flat_mesh mesh, double noise, unsigned seed)
{
  Random random(seed + 100);
  if (noise > 0)
    for (Vector& p : mesh.points) p += noise * random.vector();
  return mesh;
}

std::string said(const Result& result)
{
  std::ostringstream out;
  out << result.status() << ", confidence " << result.confidence() << ", score " << result.score() << ", "
      << result.runners_up().size() << " others from "
      << (result.runners_up().empty() ? 0. : result.runners_up().front().score) << ", " << result.free_motions().size()
      << " free motions: " << result.reason();
  return out.str();
}

// Two samplings of a shape, one of them moved.
Result registered(const Shape& shape, double noise, const Rigid_motion& motion)
{
  return CR::register_scans(prepared(generated::moved(noisy(shape(1), noise, 1), motion)),
                            prepared(noisy(shape(2), noise, 2)));
}

void check_ambiguous(const Result& result)
{
  check_sound(result);
  BOOST_TEST_MESSAGE(said(result));
  BOOST_TEST(result.status() == CR::AMBIGUOUS, said(result));
}

// Motions of the shape are free, as many as told, and the kind of surface is named.
void check_free(const Shape& shape, double noise, std::size_t free_motions, const std::string& surface)
{
  Random random(7);
  const Result result = registered(shape, noise, random.motion(2));
  check_ambiguous(result);
  BOOST_TEST(result.free_motions().size() == free_motions);
  BOOST_TEST(result.reason().find(surface) != std::string::npos, said(result));
}

// Several motions of the shape are as good as each other, also where one is the identity.
void check_several(const Shape& shape, double noise)
{
  Random random(7);
  const Scan scan = prepared(shape(3));
  for (const Result& result : {registered(shape, noise, random.motion(2)), CR::register_scans(scan, scan)}) {
    check_ambiguous(result);
    BOOST_TEST(result.free_motions().empty());
    BOOST_TEST(result.runners_up().size() > 0u);
  }
}

// The radius over the height of a surface of revolution around the z axis, closed around.
template <class Radius>
Flat_mesh revolution(const Radius& radius, double height, unsigned seed, int around = 200, int rows = 80)
{
  return generated::grid(
      around, rows,
      [&](double u, double v) {
        const double r = radius(v);
        return Vector(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), height * v);
      },
      0.25, true, false, seed);
}

Flat_mesh box(const Vector& size)
{
  Flat_mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(Vector(i & 1 ? size.x() : 0, i & 2 ? size.y() : 0, i & 4 ? size.z() : 0));
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// A closed box whose faces are grids of n cells along an edge, each vertex jittered within its face.
Flat_mesh sampled_box(const Vector& size, int n, unsigned seed)
{
  Flat_mesh mesh;
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Flat_mesh face = generated::grid(
          n, n,
          [&](double u, double v) {
            Vector p;
            if (side == 0) std::swap(u, v);
            p[i] = u * size[i];
            p[j] = v * size[j];
            p[k] = side * size[k];
            return p;
          },
          0.25, false, false, seed + unsigned(2 * k + side));
      const auto first = std::int32_t(mesh.points.size());
      mesh.points.insert(mesh.points.end(), face.points.begin(), face.points.end());
      for (const auto& f : face.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    }
  return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(plane)
{
  const auto surface = [](double u, double v) { return Vector(u, v, 0); };
  check_free([&](unsigned seed) { return generated::grid(120, 120, surface, 0.25, false, false, seed); }, 0.002, 3,
             "plane");
  // Of two faces.
  check_free([&](unsigned) { return generated::grid(1, 1, surface); }, 0, 3, "plane");
}

BOOST_AUTO_TEST_CASE(patch_of_a_sphere)
{
  const auto surface = [](double u, double v) { return Vector(Vector(u - 0.5, v - 0.5, 1).normalized()); };
  check_free([&](unsigned seed) { return generated::grid(120, 120, surface, 0.25, false, false, seed); }, 0.002, 3,
             "sphere");
}

BOOST_AUTO_TEST_CASE(closed_sphere)
{
  check_free([](unsigned seed) { return generated::moved(generated::sphere(40, 1), Random(seed).motion(0)); }, 0.004, 3,
             "sphere");
}

BOOST_AUTO_TEST_CASE(patch_of_a_cylinder)
{
  const auto surface = [](double u, double v) { return Vector(std::sin(2 * u - 1), v, std::cos(2 * u - 1)); };
  check_free([&](unsigned seed) { return generated::grid(120, 120, surface, 0.25, false, false, seed); }, 0.003, 2,
             "cylinder");
}

BOOST_AUTO_TEST_CASE(open_cylinder)
{
  check_free([](unsigned seed) { return revolution([](double) { return 1.; }, 3, seed); }, 0, 2, "cylinder");
}

BOOST_AUTO_TEST_CASE(cone)
{
  check_free([](unsigned seed) { return revolution([](double v) { return 1 - 0.8 * v; }, 2, seed); }, 0.004, 1,
             "revolution");
}

BOOST_AUTO_TEST_CASE(surface_of_revolution)
{
  const auto radius = [](double v) { return 1 + 0.2 * std::sin(9 * v) + 0.3 * v * v; };
  check_free([&](unsigned seed) { return revolution(radius, 3, seed); }, 0.006, 1, "revolution");
}

BOOST_AUTO_TEST_CASE(torus)
{
  check_free([](unsigned seed) { return generated::moved(generated::torus(200, 80, 2, 0.7), Random(seed).motion(0)); },
             0, 1, "revolution");
}

BOOST_AUTO_TEST_CASE(surface_of_extrusion)
{
  const auto surface = [](double u, double v) {
    return Vector(u, v, 0.1 * std::sin(7 * u) + 0.07 * std::sin(13 * u + 1));
  };
  check_free([&](unsigned seed) { return generated::grid(130, 130, surface, 0.25, false, false, seed); }, 0.002, 1,
             "extrusion");
}

BOOST_AUTO_TEST_CASE(box_of_twelve_faces)
{
  check_several([](unsigned) { return box({3, 2, 1.2}); }, 0);
}

BOOST_AUTO_TEST_CASE(box_of_samples)
{
  check_several([](unsigned seed) { return sampled_box({3, 2, 1.2}, 50, seed); }, 0.006);
}

BOOST_AUTO_TEST_CASE(cube)
{
  check_several([](unsigned) { return box({1, 1, 1}); }, 0);
}

BOOST_AUTO_TEST_CASE(part_of_fivefold_symmetry)
{
  const auto surface = [](double u, double v) {
    const double a = 2 * pi * u, r = 1 + 0.2 * std::cos(5 * a) + 0.1 * std::sin(10 * a) + 0.3 * v * v;
    return Vector(r * std::cos(a), r * std::sin(a), 1.5 * v);
  };
  check_several([&](unsigned seed) { return generated::grid(240, 60, surface, 0.25, true, false, seed); }, 0.004);
}

// What these tests would not tell from a registration that never believes anything.
BOOST_AUTO_TEST_CASE(similar_shapes_without_symmetry_are_registered)
{
  const auto bumps = [](unsigned seed) {
    return generated::grid(
        130, 130,
        [](double u, double v) {
          return Vector(u, v, 0.06 * std::sin(11 * u + 3 * v) + 0.05 * std::sin(5 - 7 * v + 4 * u * u));
        },
        0.25, false, false, seed);
  };
  // Five lobes of which one is larger: by chance four motions bring most of it together, which are rivals.
  const auto lobes = [](unsigned seed) {
    return generated::grid(
        240, 60,
        [](double u, double v) {
          const double a = 2 * pi * u, lobe = std::exp(-8 * (1 - std::cos(a))),
                       r = 1 + 0.2 * std::cos(5 * a) + 0.1 * std::sin(10 * a) + 0.3 * v * v + 0.2 * lobe * (1 - v);
          return Vector(r * std::cos(a), r * std::sin(a), 1.5 * v);
        },
        0.25, true, false, seed);
  };
  Random random(8);
  for (const auto& [shape, is_of_many] : {std::pair(Shape(bumps), false), std::pair(Shape(lobes), true)})
    for (double noise : {0., 0.002}) {
      const Rigid_motion motion = random.motion(2);
      const Result result = registered(shape, noise, motion);
      check_proper(result);
      BOOST_TEST((result.status() == CR::REGISTERED || (is_of_many && result.status() == CR::AMBIGUOUS)), said(result));
      const Rigid_motion error = to_rigid_motion(result.transformation()) * motion;
      BOOST_TEST((error.rotation - Matrix::Identity()).norm() < 0.02);
      BOOST_TEST(error.translation.norm() < 0.02);
    }
}
