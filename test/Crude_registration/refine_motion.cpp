#define BOOST_TEST_MODULE refine_motion
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/motion/refine_motion.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "matrix_of.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
using CR::internal::Flat_mesh;
using CR::internal::Matrix;
using CR::internal::Rigid_motion;
using CR::internal::Vector;

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Aff = CGAL::Aff_transformation_3<Kernel>;

namespace {

// A generator of its own: the same numbers with every standard library.
struct Random
{
  std::uint64_t state;
  double operator()() // in [0, 1)
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return double(state >> 11) / double(std::uint64_t(1) << 53);
  }
  double normal() { return std::sqrt(-2 * std::log(1 - (*this)())) * std::cos(2 * CGAL_PI * (*this)()); }
  Vector direction() { return Vector(normal(), normal(), normal()).normalized(); }
};

Rigid_motion rotation_about(const Vector& centre, const Vector& axis, double degrees, const Vector& offset)
{
  Rigid_motion m;
  m.rotation = Eigen::AngleAxisd(degrees * CGAL_PI / 180, axis).toRotationMatrix();
  m.translation = centre + offset - m.rotation * centre;
  return m;
}

// A grid of samples of a surface with parameters u, v: unit spacing, n_u by n_v of them from (u, v) on.
Flat_mesh sampled(const std::function<Vector(double, double)>& surface, double u, double v, int n_u, int n_v)
{
  Flat_mesh mesh;
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i) mesh.points.push_back(surface(u + i, v + j));
  for (int j = 0; j + 1 < n_v; ++j)
    for (int i = 0; i + 1 < n_u; ++i) {
      const int a = i + j * n_u, b = a + 1, c = b + n_u, d = a + n_u;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return mesh;
}

// Hills without symmetry.
Vector hills(double u, double v)
{
  const auto hill = [&](double height, double x, double y, double width) {
    return height * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * width * width));
  };
  return {u, v,
          hill(12, 10, 14, 8) + hill(9, 38, 30, 6) - hill(7, 30, 8, 7) + hill(8, 12, 45, 9) + hill(5, 50, 10, 5) +
              hill(6, 55, 50, 8) + 0.004 * u * v};
}

void add_noise(Flat_mesh& mesh, double sigma, Random& random)
{
  for (Vector& p : mesh.points) p += sigma * random.normal() * Vector::UnitZ();
}

Flat_mesh moved(const Rigid_motion& motion, Flat_mesh mesh, double unit = 1)
{
  for (Vector& p : mesh.points) p = motion(unit * p);
  return mesh;
}

Aff aff(const Rigid_motion& m)
{
  return CR::internal::to_aff_transformation<Kernel>(m);
}

Rigid_motion rigid(const Aff& a)
{
  return CR::internal::to_rigid_motion(a);
}

// RMS distance between a mesh moved by one motion and by another.
double difference(const Rigid_motion& a, const Rigid_motion& b, const Flat_mesh& mesh)
{
  double sum = 0;
  for (const Vector& p : mesh.points) sum += (a(p) - b(p)).squaredNorm();
  return std::sqrt(sum / double(mesh.points.size()));
}

double difference(const Aff& a, const Rigid_motion& b, const Flat_mesh& mesh)
{
  return difference(rigid(a), b, mesh);
}

const Vector middle(30, 30, 5);

// Two samplings of the hills, 70 wide, that share a share of them; the source in a frame of its own.
struct Scans
{
  Flat_mesh source, target;
  Rigid_motion truth; // target from source
  double diagonal = 100;

  explicit Scans(double overlap = 1, double noise = 0, std::uint64_t seed = 1)
  {
    Random random{seed};
    const int n = 60, shift = int(std::lround((1 - overlap) * n));
    target = sampled(hills, 0, 0, n, n);
    source = sampled(hills, 0.37 + shift, 0.61, n, n);
    add_noise(target, noise, random);
    add_noise(source, noise, random);
    const Rigid_motion own = rotation_about(middle, random.direction(), 77, 30 * random.direction());
    source = moved(own, source);
    truth = own.inverse();
  }

  Rigid_motion disturbed(double degrees, double offset, std::uint64_t seed) const
  {
    Random random{seed};
    return rotation_about(middle, random.direction(), degrees, offset * random.direction()) * truth;
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(converges_to_the_truth_from_5_degrees_and_3_percent)
{
  const Scans scans;
  const Mesh source = mesh_of<Mesh>(scans.source), target = mesh_of<Mesh>(scans.target);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto refined = CR::refine_motion(source, target, aff(scans.disturbed(5, 0.03 * scans.diagonal, seed)));
    BOOST_TEST(refined.is_converged);
    BOOST_TEST(refined.iterations <= 6u);
    BOOST_TEST(difference(refined.motion, scans.truth, scans.source) < 0.02);
    BOOST_TEST(refined.residual < 0.05);
    BOOST_TEST(refined.overlap > 0.97);
    BOOST_TEST(refined.number_of_free_motions == 0);
  }
}

BOOST_AUTO_TEST_CASE(noise_and_partial_overlap)
{
  for (double overlap : {0.7, 0.5, 0.3})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Scans scans(overlap, 0.2, seed);
      const Mesh source = mesh_of<Mesh>(scans.source), target = mesh_of<Mesh>(scans.target);
      const auto refined = CR::refine_motion(source, target, aff(scans.disturbed(2, 2, seed)));
      BOOST_TEST(refined.is_converged);
      BOOST_TEST(refined.iterations <= 10u);
      BOOST_TEST(difference(refined.motion, scans.truth, scans.source) < 0.3);
      BOOST_TEST(std::abs(refined.overlap - overlap) < 0.05);
      BOOST_TEST(refined.residual > 0.1);
      BOOST_TEST(refined.residual < 0.5);
    }
}

BOOST_AUTO_TEST_CASE(frames_units_and_order_do_not_matter)
{
  const Scans scans(0.7, 0.1);
  const Rigid_motion initial = scans.disturbed(3, 2, 5);
  const auto reference = CR::refine_motion(mesh_of<Mesh>(scans.source), mesh_of<Mesh>(scans.target), aff(initial));
  Random random{9};
  for (double unit : {1e-3, 0.3048, 1e3}) {
    const Rigid_motion a = rotation_about(middle, random.direction(), 133, 50 * unit * random.direction());
    const Rigid_motion b = rotation_about(middle, random.direction(), 101, 50 * unit * random.direction());
    Rigid_motion scaled = initial;
    scaled.translation *= unit;
    const auto refined = CR::refine_motion(mesh_of<Mesh>(moved(a, scans.source, unit)),
                                           mesh_of<Mesh>(moved(b, scans.target, unit)), aff(b * scaled * a.inverse()));
    Rigid_motion back = b.inverse() * rigid(refined.motion) * a;
    back.translation /= unit;
    BOOST_TEST(difference(back, rigid(reference.motion), scans.source) < 1e-8);
    BOOST_TEST(refined.iterations == reference.iterations);
    BOOST_TEST(std::abs(refined.residual - reference.residual) < 1e-8);
    BOOST_TEST(refined.overlap == reference.overlap);
  }

  // The vertices and faces of both in another order.
  const auto reordered = [](const Flat_mesh& mesh) {
    const std::size_t n = mesh.points.size();
    Flat_mesh other;
    other.points.resize(n);
    const auto place = [n](std::size_t i) { return (i * 1009 + 7) % n; };
    for (std::size_t i = 0; i < n; ++i) other.points[place(i)] = mesh.points[i];
    for (auto f : mesh.faces) {
      for (auto& i : f) i = std::int32_t(place(std::size_t(i)));
      other.faces.insert(other.faces.begin(), f);
    }
    return other;
  };
  const auto refined =
      CR::refine_motion(mesh_of<Mesh>(reordered(scans.source)), mesh_of<Mesh>(reordered(scans.target)), aff(initial));
  BOOST_TEST(difference(refined.motion, rigid(reference.motion), scans.source) < 1e-8);
}

BOOST_AUTO_TEST_CASE(swapped_meshes_give_the_inverse)
{
  const Scans scans(0.7, 0.1);
  const Rigid_motion initial = scans.disturbed(3, 2, 5);
  const Mesh source = mesh_of<Mesh>(scans.source), target = mesh_of<Mesh>(scans.target);
  const auto there = CR::refine_motion(source, target, aff(initial));
  const auto back = CR::refine_motion(target, source, aff(initial.inverse()));
  BOOST_TEST(difference(there.motion, rigid(back.motion).inverse(), scans.source) < 0.1);
}

BOOST_AUTO_TEST_CASE(a_mesh_against_itself_stays)
{
  const Mesh mesh = mesh_of<Mesh>(sampled(hills, 0, 0, 40, 40));
  const auto refined = CR::refine_motion(mesh, mesh, Aff(CGAL::IDENTITY));
  BOOST_TEST(refined.is_converged);
  BOOST_TEST(refined.iterations == 1u);
  BOOST_TEST(refined.residual == 0.);
  BOOST_TEST(refined.overlap == 1.);
  BOOST_TEST((rigid(refined.motion).rotation == Matrix::Identity()));
  BOOST_TEST(rigid(refined.motion).translation.norm() == 0.);
}

BOOST_AUTO_TEST_CASE(stop_rule)
{
  namespace p = CR::parameters;
  const Scans scans(0.7, 0.1);
  const Mesh source = mesh_of<Mesh>(scans.source), target = mesh_of<Mesh>(scans.target);
  const Aff initial = aff(scans.disturbed(4, 3, 5));

  const auto one = CR::refine_motion(source, target, initial, p::number_of_iterations(1));
  BOOST_TEST(one.iterations == 1u);
  BOOST_TEST(!one.is_converged);

  // Steps are the iterations: running one after the other gives the same as one run, until the first short one.
  std::size_t last = 0;
  for (double tolerance : {10., 1., 0.1, 0.01}) {
    const auto refined = CR::refine_motion(source, target, initial, p::tolerance(tolerance));
    BOOST_TEST(refined.is_converged);
    BOOST_TEST(refined.iterations >= last);
    last = refined.iterations;
    if (last > 1) {
      const auto before =
          CR::refine_motion(source, target, initial, p::tolerance(tolerance).number_of_iterations(last - 1));
      BOOST_TEST(!before.is_converged);
      BOOST_TEST(difference(before.motion, rigid(refined.motion), scans.source) <
                 2 * tolerance * refined.sampling_distance);
    }
  }
  BOOST_TEST(last > 2u);

  // What has converged stays.
  const auto refined = CR::refine_motion(source, target, initial);
  const auto again = CR::refine_motion(source, target, refined.motion);
  BOOST_TEST(again.iterations == 1u);
  BOOST_TEST(difference(again.motion, rigid(refined.motion), scans.source) < 0.1 * refined.sampling_distance);
}

BOOST_AUTO_TEST_CASE(free_motions_are_counted_and_not_taken)
{
  // Parametrised by about unit lengths; u = 0 is the middle.
  const double r = 40;
  const auto plane = [](double u, double v) { return Vector(u, v, 0); };
  const auto cylinder = [r](double u, double v) { return Vector(r * std::sin(u / r), v, r * std::cos(u / r)); };
  const auto sphere = [r](double u, double v) {
    return Vector(r * std::sin(u / r) * std::cos(v / r), r * std::sin(v / r), r * std::cos(u / r) * std::cos(v / r));
  };
  const auto vase = [r](double u, double v) {
    const double radius = r + 6 * std::sin(v / 7) + 0.2 * v;
    return Vector(radius * std::sin(u / r), v, radius * std::cos(u / r));
  };
  struct Case
  {
    std::function<Vector(double, double)> surface;
    int free;
  };
  const std::vector<Case> cases = {{plane, 3}, {cylinder, 2}, {sphere, 3}, {vase, 1}, {hills, 0}};
  const int n = 50;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (double noise : {0., 0.02, 0.1}) {
      BOOST_TEST_CONTEXT("surface " << i << ", noise " << noise)
      {
        Random random{i + 1};
        const double start = i == 4 ? 0 : -n / 2.;
        Flat_mesh source = sampled(cases[i].surface, start + 0.3, start + 0.6, n, n),
                  target = sampled(cases[i].surface, start, start, n, n);
        for (Flat_mesh* mesh : {&source, &target}) add_noise(*mesh, noise, random);
        // About a corner, so that overlap and normals stay.
        const Rigid_motion initial = rotation_about(Vector(0, 0, r), random.direction(), 1, random.direction());
        const auto refined = CR::refine_motion(mesh_of<Mesh>(source), mesh_of<Mesh>(target), aff(initial));
        BOOST_TEST(refined.is_converged);
        BOOST_TEST(refined.number_of_free_motions == cases[i].free);
        BOOST_TEST(refined.residual < 0.05 + 2 * noise);
        BOOST_TEST(rigid(refined.motion).rotation.allFinite());
        // Nothing runs away.
        BOOST_TEST(difference(refined.motion, Rigid_motion(), source) < 4);
      }
    }
}

BOOST_AUTO_TEST_CASE(a_plane_is_not_moved_along_itself)
{
  const auto plane = [](double u, double v) { return Vector(u, v, 0); };
  const Flat_mesh source = sampled(plane, 0.3, 0.6, 50, 50), target = sampled(plane, 0, 0, 50, 50);
  const Rigid_motion initial = rotation_about(Vector(25, 25, 0), Vector(1, 0, 0), 2, Vector(0.5, -0.7, 1));
  const auto refined = CR::refine_motion(mesh_of<Mesh>(source), mesh_of<Mesh>(target), aff(initial));
  BOOST_TEST(refined.number_of_free_motions == 3);
  // Height and tilt are right, and the rest is as it was.
  const Rigid_motion expected = rotation_about(Vector(25, 25, 0), Vector(1, 0, 0), 0, Vector(0.5, -0.7, 0));
  BOOST_TEST(difference(refined.motion, expected, source) < 0.05);
  BOOST_TEST(rigid(refined.motion).rotation(2, 2) > 1 - 1e-12);
}

BOOST_AUTO_TEST_CASE(the_covariance_tells_the_scatter)
{
  double sum = 0;
  const int trials = 20;
  for (int i = 0; i < trials; ++i) {
    const Scans scans(0.8, 0.1, std::uint64_t(i) + 1);
    const auto refined =
        CR::refine_motion(mesh_of<Mesh>(scans.source), mesh_of<Mesh>(scans.target), aff(scans.disturbed(1, 1, 3)));
    const Rigid_motion error = rigid(refined.motion) * scans.truth.inverse();
    const Eigen::AngleAxisd turn(error.rotation);
    Eigen::Matrix<double, 6, 1> e;
    e << turn.angle() * turn.axis(), error.translation;
    const Matrix_6 covariance = matrix_of(refined.covariance);
    BOOST_TEST((covariance - covariance.transpose()).norm() <= 1e-12 * covariance.norm());
    sum += whitened(covariance, e).squaredNorm() / 6;
  }
  // The mean of a chi square per degree of freedom, were the errors of the correspondences independent.
  BOOST_TEST(sum / trials > 0.3);
  BOOST_TEST(sum / trials < 6);
}

BOOST_AUTO_TEST_CASE(nothing_within_reach)
{
  const Scans scans;
  Rigid_motion away = scans.truth;
  away.translation.z() += 1000;
  const auto refined = CR::refine_motion(mesh_of<Mesh>(scans.source), mesh_of<Mesh>(scans.target), aff(away));
  BOOST_TEST(!refined.is_converged);
  BOOST_TEST(refined.iterations == 0u);
  BOOST_TEST(refined.overlap == 0.);
  BOOST_TEST(refined.number_of_free_motions == 6);
  BOOST_TEST(difference(refined.motion, away, scans.source) < 1e-9);

  // The same surface seen from behind.
  Flat_mesh flipped = scans.target;
  for (auto& f : flipped.faces) std::swap(f[0], f[1]);
  const auto behind = CR::refine_motion(mesh_of<Mesh>(scans.source), mesh_of<Mesh>(flipped), aff(scans.truth));
  BOOST_TEST(!behind.is_converged);
  BOOST_TEST(behind.overlap == 0.);
}

BOOST_AUTO_TEST_CASE(isolated_and_duplicate_vertices_do_no_harm)
{
  const Scans scans;
  const auto spoilt = [](const Flat_mesh& mesh) {
    Flat_mesh other = mesh;
    for (int i = 0; i < 500; ++i) other.points.push_back(mesh.points[0]);
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) other.points.push_back(mesh.points[i] + Vector(0, 0, 0.2));
    const int n = int(mesh.points.size());
    other.faces.push_back({n, n + 1, n + 2}); // without area
    return other;
  };
  const auto refined = CR::refine_motion(mesh_of<Mesh>(spoilt(scans.source)), mesh_of<Mesh>(spoilt(scans.target)),
                                         aff(scans.disturbed(3, 3, 1)));
  BOOST_TEST(refined.is_converged);
  BOOST_TEST(difference(refined.motion, scans.truth, scans.source) < 0.05);
}

BOOST_AUTO_TEST_CASE(any_face_graph_kernel_and_point_map)
{
  using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Polyhedron = CGAL::Polyhedron_3<Epick>;
  const Scans scans(0.7, 0.1);
  const Aff initial = aff(scans.disturbed(3, 2, 5));
  Mesh target = mesh_of<Mesh>(scans.target);
  const auto reference = CR::refine_motion(mesh_of<Mesh>(scans.source), target, initial);

  const auto polyhedra =
      CR::refine_motion(mesh_of<Polyhedron>(scans.source), mesh_of<Polyhedron>(scans.target), initial);
  BOOST_TEST(difference(polyhedra.motion, rigid(reference.motion), scans.source) < 1e-8);

  auto map = target.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere").first;
  for (auto v : target.vertices()) {
    map[v] = target.point(v);
    target.point(v) = CGAL::ORIGIN;
  }
  const auto mapped = CR::refine_motion(mesh_of<Mesh>(scans.source), target, initial, CR::parameters::tolerance(0.05),
                                        CR::parameters::vertex_point_map(map));
  BOOST_TEST(difference(mapped.motion, rigid(reference.motion), scans.source) == 0.);
}

#ifdef CGAL_LINKED_WITH_TBB
BOOST_AUTO_TEST_CASE(threads_give_the_same_bits)
{
  const Scans scans(0.7, 0.1);
  const Mesh source = mesh_of<Mesh>(scans.source), target = mesh_of<Mesh>(scans.target);
  const Aff initial = aff(scans.disturbed(3, 2, 5));
  const auto one = CR::refine_motion<CGAL::Sequential_tag>(source, target, initial);
  const auto many = CR::refine_motion<CGAL::Parallel_tag>(source, target, initial);
  BOOST_TEST((rigid(one.motion).rotation == rigid(many.motion).rotation));
  BOOST_TEST((rigid(one.motion).translation == rigid(many.motion).translation));
  BOOST_TEST((one.covariance == many.covariance));
  BOOST_TEST(one.residual == many.residual);
}
#endif

BOOST_AUTO_TEST_CASE(wrong_use_names_the_argument)
{
  namespace p = CR::parameters;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mesh good = mesh_of<Mesh>(sampled(hills, 0, 0, 10, 10)), empty;
  const Aff identity(CGAL::IDENTITY);
  const auto throws = [&](const Mesh& source, const Mesh& target, const Aff& initial, const std::string& argument) {
    BOOST_CHECK_EXCEPTION(CR::refine_motion(source, target, initial), std::invalid_argument,
                          names("refine_motion:", argument));
  };
  throws(empty, good, identity, "source");
  throws(good, empty, identity, "target");

  Mesh not_finite = good, quadrangle, flat;
  not_finite.point(Mesh::Vertex_index(3)) = Point(0, nan, 0);
  throws(not_finite, good, identity, "source");
  throws(good, not_finite, identity, "target");
  quadrangle.add_face(quadrangle.add_vertex(Point(0, 0, 0)), quadrangle.add_vertex(Point(1, 0, 0)),
                      quadrangle.add_vertex(Point(1, 1, 0)), quadrangle.add_vertex(Point(0, 1, 0)));
  throws(quadrangle, good, identity, "source");
  flat.add_face(flat.add_vertex(Point(0, 0, 0)), flat.add_vertex(Point(1, 0, 0)), flat.add_vertex(Point(2, 0, 0)));
  throws(good, flat, identity, "target");

  throws(good, good, Aff(CGAL::SCALING, 2.), "initial_motion");
  throws(good, good, Aff(1, 0, 0, 0, 1, 0, 0, 0, -1), "initial_motion");
  throws(good, good, Aff(1, 0, 0, nan, 0, 1, 0, 0, 0, 0, 1, 0), "initial_motion");

  const auto rejects = [&](const auto& np, const std::string& argument) {
    BOOST_CHECK_EXCEPTION(CR::refine_motion(good, good, identity, np), std::invalid_argument,
                          names("refine_motion:", argument));
  };
  rejects(p::tolerance(0), "tolerance");
  rejects(p::maximum_distance(-1.), "maximum_distance");
  rejects(p::sampling_distance(nan), "sampling_distance");
  rejects(p::number_of_iterations(0), "number_of_iterations");
}
