#define BOOST_TEST_MODULE register_scans
#include <boost/test/unit_test.hpp>

#include "generated_room.h"
#include "statue_views.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/IO/read_scan.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif
#ifdef CGAL_USE_OPENMESH
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using generated::Random;

namespace {

// Two answers that are the same but for rounding, which may take a few samples to another cell.
void check_same(const Result& a, const Result& b, const Vector& centre, double tolerance)
{
  check_proper(a);
  check_proper(b);
  BOOST_TEST(a.status() == b.status());
  BOOST_TEST(difference(to_rigid_motion(a.transformation()), to_rigid_motion(b.transformation()), centre) < tolerance);
}

// A pair of oriented points, which is looked for at lengths of 0.3 spacings about some, among those that are within 0.7
// spacings of them.
void check_pair(const Result& result, const View& source, const View& target)
{
  const auto spacing = double((std::max)(source.scan.reduced().coarse.spacing, target.scan.reduced().coarse.spacing));
  check_correspondence(result, source, target, 2, spacing, (0.3 + 0.7) * spacing);
}

// With x -> -x.
Image mirrored(const Image& image)
{
  Rigid_motion mirror; // not rigid, but that does not matter here
  mirror.rotation(0, 0) = -1;
  return moved(image, mirror);
}

} // namespace

BOOST_AUTO_TEST_CASE(views_that_overlap_are_registered)
{
  for (unsigned seed : {0u, 1u})
    for (const auto& [a, b] : {std::pair(0, 45), std::pair(45, 90), std::pair(0, 90), std::pair(270, 0)}) {
      if (seed == 1 && a > 0) continue;
      BOOST_TEST_CONTEXT("statue " << seed << ", " << a << " to " << b)
      {
        const View &source = view(seed, a), &target = view(seed, b);
        const Result result = CR::register_scans(source.scan, target.scan);
        check_right(result, source, target);
        BOOST_TEST(result.confidence() >= 0.9);
        BOOST_TEST(result.overlap() > 0.15);
        BOOST_TEST(result.free_space_violations() < 0.02);
        BOOST_TEST(result.free_motions().empty());
        BOOST_TEST(result.residual() < 1);
        // The crude motion is near, and the refined one nearer than a sampling distance or two.
        BOOST_TEST(angle_between(to_rigid_motion(result.crude_transformation()), true_motion(source, target)) < 5);
        for (const auto& other : result.runners_up()) BOOST_TEST(other.score <= result.score());
        check_pair(result, source, target);
      }
    }
}

BOOST_AUTO_TEST_CASE(without_noise)
{
  const View &source = view(0, 0, 0), &target = view(0, 45, 0);
  check_right(CR::register_scans(source.scan, target.scan), source, target);
}

BOOST_AUTO_TEST_CASE(views_that_do_not_overlap_are_not_registered)
{
  for (const auto& [a, b] : {std::pair(0, 180), std::pair(90, 270)}) BOOST_TEST_CONTEXT(a << " to " << b)
    {
      check_not_registered(CR::register_scans(view(0, a).scan, view(0, b).scan));
    }
}

BOOST_AUTO_TEST_CASE(views_of_two_statues_are_not_registered)
{
  check_not_registered(CR::register_scans(view(0, 0).scan, view(1, 0).scan));
  check_not_registered(CR::register_scans(view(0, 90).scan, view(1, 45).scan));
}

BOOST_AUTO_TEST_CASE(mirrored_scans_are_not_registered)
{
  const Scan mirror_image(mirrored(view(0, 0).image));
  check_not_registered(CR::register_scans(mirror_image, view(0, 0).scan));
  check_not_registered(CR::register_scans(mirror_image, view(0, 45).scan));
}

BOOST_AUTO_TEST_CASE(swapped_scans_give_the_inverse)
{
  for (const auto& [a, b] : {std::pair(0, 45), std::pair(0, 90), std::pair(270, 0)}) {
    const Result there = CR::register_scans(view(0, a).scan, view(0, b).scan),
                 back = CR::register_scans(view(0, b).scan, view(0, a).scan);
    BOOST_TEST(there.status() == back.status());
    const Rigid_motion motion = to_rigid_motion(there.transformation()),
                       inverse = to_rigid_motion(back.inverse_transformation());
    BOOST_TEST((motion.rotation - inverse.rotation).norm() < 1e-14);
    BOOST_TEST((motion.translation - inverse.translation).norm() < 1e-13);
    BOOST_TEST(there.confidence() == back.confidence());
    BOOST_TEST(there.score() == back.score());
    BOOST_TEST(there.runners_up().size() == back.runners_up().size());
    check_pair(there, view(0, a), view(0, b));
    check_pair(back, view(0, b), view(0, a));
    check_swapped_correspondence(there, back);
  }
}

BOOST_AUTO_TEST_CASE(the_same_bits_twice)
{
  for (int b : {45, 180})
    check_same_bits(CR::register_scans(view(0, 0).scan, view(0, b).scan),
                    CR::register_scans(Scan(view(0, 0).image), Scan(view(0, b).image)));
}

BOOST_AUTO_TEST_CASE(the_same_bits_by_several_threads)
{
#ifdef CGAL_LINKED_WITH_TBB
  for (int b : {45, 90, 180}) {
    const Result alone = CR::register_scans(view(0, 0).scan, view(0, b).scan);
    for (const std::size_t threads : {2u, 5u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      check_same_bits(alone, CR::register_scans<CGAL::Parallel_tag>(view(0, 0).scan, view(0, b).scan));
    }
  }
#else
  std::cout << "TBB: not tested, it was not found\n";
#endif
}

BOOST_AUTO_TEST_CASE(frames_do_not_matter)
{
  const View &source = view(0, 0), &target = view(0, 90);
  const Result reference = CR::register_scans(source.scan, target.scan);
  Random random(1);
  for (double away : {3., 1e4}) {
    const Rigid_motion a = random.motion(away), b = random.motion(away);
    const Result result = CR::register_scans(Scan(moved(source.image, a)), Scan(moved(target.image, b)));
    check_proper(result);
    BOOST_TEST(result.status() == reference.status());
    const Rigid_motion back = b.inverse() * to_rigid_motion(result.transformation()) * a;
    BOOST_TEST(difference(back, to_rigid_motion(reference.transformation()), source.centre) <
               0.1 * source.scan.spacing());
  }
}

BOOST_AUTO_TEST_CASE(the_unit_does_not_matter)
{
  const View &source = view(0, 0), &target = view(0, 90);
  const Result reference = CR::register_scans(source.scan, target.scan);
  for (double unit : {1e-3, 0.3048, 1e3}) {
    const Rigid_motion same;
    const Result result =
        CR::register_scans(Scan(moved(source.image, same, unit)), Scan(moved(target.image, same, unit)));
    check_proper(result);
    BOOST_TEST(result.status() == reference.status());
    Rigid_motion back = to_rigid_motion(result.transformation());
    back.translation /= unit;
    BOOST_TEST(difference(back, to_rigid_motion(reference.transformation()), source.centre) <
               0.1 * source.scan.spacing());
    BOOST_TEST(std::abs(result.overlap() - reference.overlap()) < 0.01);
    BOOST_TEST(std::abs(result.residual() - reference.residual()) < 0.02);
  }
}

BOOST_AUTO_TEST_CASE(the_order_of_vertices_and_faces_does_not_matter)
{
  const View &source = view(0, 0), &target = view(0, 90);
  const Mesh a = mesh_of(source.image), b = mesh_of(target.image);
  const Result reference = CR::register_meshes(a, b, p::viewpoint(origin), p::viewpoint(origin)),
               result = CR::register_meshes(mesh_of(generated::shuffled(flat_mesh_of(a), 1)),
                                            mesh_of(generated::shuffled(flat_mesh_of(b), 2)), p::viewpoint(origin),
                                            p::viewpoint(origin));
  check_right(reference, source, target);
  check_same(result, reference, source.centre, 0.3 * source.scan.spacing());
}

BOOST_AUTO_TEST_CASE(a_scan_against_itself_is_the_identity)
{
  Mesh statue;
  CR::make_statue(statue, 48);
  const View& open = view(0, 0);
  const Result closed_result = CR::register_meshes(statue, statue),
               open_result = CR::register_scans(open.scan, open.scan);
  for (const auto& [result, spacing] :
       {std::pair(&closed_result, Scan(statue).spacing()), std::pair(&open_result, open.scan.spacing())}) {
    check_proper(*result);
    BOOST_TEST(result->status() == CR::REGISTERED);
    BOOST_TEST(angle_between(to_rigid_motion(result->transformation()), Rigid_motion()) < 0.01);
    BOOST_TEST(to_rigid_motion(result->transformation()).translation.norm() < 0.05 * spacing);
    BOOST_TEST(result->overlap() > 0.9);
  }
}

// A scan against the complete body it was taken of.
BOOST_AUTO_TEST_CASE(a_scan_against_the_closed_model)
{
  Mesh statue;
  CR::make_statue(statue, 64);
  const View& source = view(0, 45);
  const Scan model(statue);
  BOOST_TEST(!model.has_free_space());
  const Result result = CR::register_scans(source.scan, model);
  BOOST_TEST(result.source_has_free_space());
  BOOST_TEST(!result.target_has_free_space());
  check_right(result, source.scene_from_scan, source.centre, (std::max)(source.scan.spacing(), model.spacing()));
}

// 2:1 and 4:1.
BOOST_AUTO_TEST_CASE(scans_of_different_resolution)
{
  const View& fine = view(0, 0, 0.2, 600);
  for (const View* coarse : {&view(0, 45, 0.2, 300), &view(0, 45, 0.2, 150)}) {
    check_right(CR::register_scans(fine.scan, coarse->scan), fine, *coarse);
    check_right(CR::register_scans(coarse->scan, fine.scan), *coarse, fine);
  }
}

// Several views in one mesh, of which no sensor sees all.
BOOST_AUTO_TEST_CASE(a_scan_against_fused_views)
{
  Flat_mesh fused;
  for (int degrees : {0, 90}) {
    const View& v = view(0, degrees);
    const Flat_mesh part = flat_mesh_of(mesh_of(v.image));
    const auto first = std::int32_t(fused.points.size());
    for (const Vector& q : part.points) fused.points.push_back(v.scene_from_scan(q));
    for (const auto& f : part.faces) fused.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  const Scan model(mesh_of(fused));
  const View& source = view(0, 45);
  check_right(CR::register_scans(source.scan, model), source.scene_from_scan, source.centre, source.scan.spacing());
}

// Plain points of a camera that moved, from two places.
BOOST_AUTO_TEST_CASE(parts_of_a_room)
{
  using Place = generated::Point;
  const auto a = generated::points_of_room(Place(0.6, 0.6, 1.5), {Place(3.5, 1, 0.5), Place(3, 2.5, 0.6)}),
             b = generated::points_of_room(Place(1.2, 0.5, 1.4), {Place(3.8, 2.2, 0.8), Place(2, 2.8, 0.7)});
  Random random(9);
  for (int i = 0; i < 3; ++i) {
    const Rigid_motion to_source = random.motion(3), to_target = random.motion(3);
    const auto scan = [](const std::vector<Place>& points, const Rigid_motion& motion) {
      std::vector<Point> moved;
      for (const Place& q : points) {
        const Vector v = motion(generated::vector(q));
        moved.emplace_back(v.x(), v.y(), v.z());
      }
      return Scan(moved);
    };
    check_right(CR::register_scans(scan(a, to_source), scan(b, to_target)), to_target * to_source.inverse(),
                to_source(Vector(3, 2, 1)), 0.03);
  }
}

// A shell looks the same from behind: points alone do not tell from which side it was seen.
BOOST_AUTO_TEST_CASE(points_without_a_sensor)
{
  const auto points = [](int degrees) { return Scan(view(0, degrees).image.points()); };
  for (const auto& [a, b] : {std::pair(0, 45), std::pair(90, 45), std::pair(270, 0)}) {
    BOOST_TEST_CONTEXT(a << " to " << b)
    {
      const View &source = view(0, a), &target = view(0, b);
      const Scan source_points = points(a), target_points = points(b);
      const Result there = CR::register_scans(source_points, target_points);
      check_right(there, source, target);
      check_right(CR::register_scans(source_points, target.scan), source, target);
      check_right(CR::register_scans(source.scan, target_points), source, target);
      // Source and target exchanged, the sides are tried in the same order.
      const Result back = CR::register_scans(target_points, source_points);
      BOOST_TEST(there.confidence() == back.confidence());
      BOOST_TEST(
          (to_rigid_motion(there.transformation()).rotation - to_rigid_motion(back.inverse_transformation()).rotation)
              .norm() < 1e-14);
    }
  }
  check_not_registered(CR::register_scans(points(0), points(180)));
  check_not_registered(CR::register_scans(points(0), Scan(view(1, 0).image.points())));
}

BOOST_AUTO_TEST_CASE(both_sides_are_one_run)
{
  const Scan a(view(0, 0).image.points()), b(view(0, 180).image.points());
  BOOST_TEST_REQUIRE(a.other_side() != nullptr);
  BOOST_TEST_REQUIRE(b.other_side() != nullptr);
  struct Visitor
  {
    std::vector<double> seen;
    void progress(double done) { seen.push_back(done); }
    bool go_further() { return true; }
  } visitor;
  check_not_registered(CR::register_scans(a, b, p::visitor(std::ref(visitor))));
  BOOST_TEST(std::is_sorted(visitor.seen.begin(), visitor.seen.end()));
  for (const double s : visitor.seen) BOOST_TEST_REQUIRE((0 <= s && s <= 1));
}

// Here they look away from the sensor, which is what is given.
BOOST_AUTO_TEST_CASE(normals_of_points_tell_their_side)
{
  const std::vector<Point> points = view(0, 0).image.points();
  std::vector<Kernel::Vector_3> normals;
  for (const Point& q : points) normals.push_back(3 * (q - origin));
  const auto facing = [](const Scan& scan) {
    double sum = 0;
    for (std::size_t i = 0; i < scan.points().size(); ++i) sum += scan.normals()[i] * (origin - scan.points()[i]) > 0;
    return sum / double(scan.points().size());
  };
  const Scan away(points, normals);
  BOOST_TEST(away.other_side() == nullptr);
  BOOST_TEST(facing(away) < 0.02);
  for (auto& n : normals) n = -n;
  BOOST_TEST(facing(Scan(points, normals)) > 0.98);
  // The sensor knows better; no normals are none.
  for (auto& n : normals) n = -n;
  BOOST_TEST(facing(Scan(points, normals, p::viewpoint(origin))) > 0.98);
  BOOST_TEST(Scan(points, std::vector<Kernel::Vector_3>()).other_side() != nullptr);
  normals.pop_back();
  BOOST_CHECK_THROW(Scan(points, normals), std::invalid_argument);
  normals.emplace_back(0, std::numeric_limits<double>::quiet_NaN(), 0);
  BOOST_CHECK_THROW(Scan(points, normals), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(range_image_mesh_and_points_of_one_scan)
{
  const View &source = view(0, 0), &target = view(0, 45);
  // With and without the sensor.
  const Mesh a = mesh_of(source.image), b = mesh_of(target.image);
  check_right(CR::register_meshes(a, b, p::viewpoint(origin), p::viewpoint(origin)), source, target);
  check_right(CR::register_meshes(a, b), source, target);
  check_right(CR::register_meshes(a, b, p::viewing_direction(Kernel::Vector_3(0, 0, -1)), p::viewpoint(origin)), source,
              target);
  // As read from files.
  CR::Scan_file<Kernel> mesh_file, image_file;
  mesh_file.kind = CR::Scan_file<Kernel>::MESH;
  mesh_file.mesh = a;
  image_file.kind = CR::Scan_file<Kernel>::RANGE_IMAGE;
  image_file.image = target.image;
  check_same_bits(CR::register_scans(Scan(mesh_file), Scan(image_file)), CR::register_scans(Scan(a), target.scan));
  const Scan points(source.image.points(), p::viewpoint(origin));
  BOOST_TEST(points.has_free_space());
  check_right(CR::register_scans(points, target.scan), source, target);
  // What was prepared is what is told.
  BOOST_TEST(source.scan.number_of_samples() <= source.image.points().size());
  BOOST_TEST(source.scan.number_of_samples() > source.image.points().size() / 2);
  BOOST_TEST(source.scan.has_free_space());
  BOOST_TEST(source.scan.extent() > 0.5);
  BOOST_TEST(source.scan.extent() < 3);
}

// Though all of it faces one way, nothing tells that it was seen from there.
BOOST_AUTO_TEST_CASE(without_a_sensor_no_space_is_free)
{
  Mesh hills;
  CGAL::make_grid(
      40, 40, hills,
      [](std::size_t i, std::size_t j) {
        const double x = double(i) / 10, y = double(j) / 10;
        return Point(x, y, 0.3 * std::sin(2 * x) * std::cos(3 * y) + 0.1 * x * y);
      },
      true);
  BOOST_TEST(!Scan(hills).has_free_space());
  BOOST_TEST(Scan(hills, p::viewing_direction(Kernel::Vector_3(0, 0, -1))).has_free_space());
}

BOOST_AUTO_TEST_CASE(the_sensor_of_a_file_is_taken)
{
  const View &source = view(0, 0), &target = view(0, 45);
  CR::Scan_file<Kernel> points, mesh;
  points.kind = CR::Scan_file<Kernel>::POINTS;
  points.points = source.image.points();
  mesh.kind = CR::Scan_file<Kernel>::MESH;
  mesh.mesh = mesh_of(source.image);
  for (CR::Scan_file<Kernel>* file : {&points, &mesh}) {
    BOOST_TEST(!Scan(*file).has_free_space());
    const Result given = CR::register_scans(Scan(*file, p::viewpoint(origin)), target.scan);
    check_right(given, source, target);
    file->sensor = CR::Sensor<Kernel>::perspective(origin);
    BOOST_TEST(Scan(*file).has_free_space());
    check_same_bits(CR::register_scans(Scan(*file), target.scan), given);
    // What is said of it is wrong, and a parameter says so.
    file->sensor = CR::Sensor<Kernel>::perspective(origin + 3 * (source.image.points()[0] - origin));
    check_same_bits(CR::register_scans(Scan(*file, p::viewpoint(origin)), target.scan), given);
  }
}

BOOST_AUTO_TEST_CASE(any_face_graph_and_kernel)
{
  const View &source = view(0, 0), &target = view(0, 45);
  const Mesh a = mesh_of(source.image), b = mesh_of(target.image);
  const Result reference = CR::register_meshes(a, b);
  check_right(reference, source, target);
  const double tolerance = 0.3 * source.scan.spacing();

  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(a, polyhedron);
  check_same(CR::register_meshes(polyhedron, b), reference, source.centre, tolerance);

  using Double = CGAL::Simple_cartesian<double>;
  CGAL::Surface_mesh<Double::Point_3> other;
  CGAL::copy_face_graph(b, other,
                        p::default_values(), // from Epick to doubles
                        p::vertex_point_map(other.points()));
  check_same(CR::register_meshes(a, other), reference, source.centre, tolerance);
  const CR::Registration_result<Double> doubles = CR::register_meshes(other, a);
  BOOST_TEST(doubles.status() == CR::REGISTERED);

#ifdef CGAL_USE_OPENMESH
  OpenMesh::PolyMesh_ArrayKernelT<> open_mesh; // of floats
  CGAL::copy_face_graph(a, open_mesh);
  check_same(CR::register_meshes(open_mesh, b), reference, source.centre, tolerance);
#else
  std::cout << "OpenMesh: not tested, it was not found\n";
#endif
}

BOOST_AUTO_TEST_CASE(named_parameters_in_any_order)
{
  const View &source = view(0, 0), &target = view(0, 45);
  Mesh a = mesh_of(source.image);
  const Mesh b = mesh_of(target.image);
  const Result reference =
      CR::register_meshes(a, b, p::viewpoint(origin).minimum_extent(0.05).maximum_extent(0.3), p::viewpoint(origin));
  check_right(reference, source, target);

  // The points of the source in a map of their own.
  auto map = a.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere").first;
  for (auto v : a.vertices()) {
    map[v] = a.point(v);
    a.point(v) = origin;
  }
  const auto check = [&](const auto& np) {
    check_same(CR::register_meshes(a, b, np, p::viewpoint(origin)), reference, source.centre, 1e-12);
  };
  check(p::vertex_point_map(map).viewpoint(origin).minimum_extent(0.05).maximum_extent(0.3));
  check(p::maximum_extent(0.3).minimum_extent(0.05).viewpoint(origin).vertex_point_map(map));
  check(p::minimum_extent(0.05).vertex_point_map(map).maximum_extent(0.3).geom_traits(Kernel()).viewpoint(origin));

  // A pack of CGAL's own.
  check_right(CR::register_meshes(a, b, CGAL::parameters::vertex_point_map(map)), source, target);
}

BOOST_AUTO_TEST_CASE(a_search_can_be_ended)
{
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  // Without overlap: the longest search there is.
  const Scan &source = view(0, 0).scan, &target = view(1, 90).scan;
  const Result whole = CR::register_scans(source, target);

  Impatient patient(1);
  check_same_bits(whole, CR::register_scans(source, target, p::visitor(std::ref(patient))));
  BOOST_TEST(patient.asked > 5);
  BOOST_TEST(patient.is_monotone);
  BOOST_TEST(patient.is_share);
  check_same_bits(whole, CR::register_scans(source, target, p::time_budget(1000)));

  for (double share : {0., patient.last}) {
    Impatient impatient(share);
    const auto start = Clock::now();
    const Result result =
        CR::register_scans<CGAL::Parallel_if_available_tag>(source, target, p::visitor(std::ref(impatient)));
    check_proper(result);
    BOOST_TEST(result.status() != CR::REGISTERED);
    BOOST_TEST(result.confidence() <= 0.5);
    BOOST_TEST(result.reason().find("interrupted") == 0);
    BOOST_TEST(impatient.refused == 1);
    BOOST_TEST(seconds(start) < 10); // a bound for any machine; no measure
  }
  for (double budget : {1e-6, 1e-3, 2e-2}) {
    const Result result = CR::register_scans(source, target, p::time_budget(budget));
    check_proper(result);
    BOOST_TEST(result.status() != CR::REGISTERED);
  }
  // What is found before the end stays found.
  const Result certain = CR::register_scans(source, view(0, 45).scan, p::time_budget(1000).visitor(Impatient(1)));
  BOOST_TEST(certain.status() == CR::REGISTERED);

  struct Failing
  {
    void progress(double) {}
    bool go_further() { throw std::runtime_error("enough"); }
  };
  BOOST_CHECK_EXCEPTION(CR::register_scans(source, target, p::visitor(Failing())), std::runtime_error,
                        [](const std::runtime_error& e) { return e.what() == std::string("enough"); });
}

// Preparation, too: of a mesh, an image, and points that have to be joined first.
BOOST_AUTO_TEST_CASE(a_preparation_can_be_ended)
{
  const View& v = view(0, 0);
  const Mesh mesh = mesh_of(v.image);
  const auto interrupted = [](const CR::Preparation_interrupted& e) {
    return std::string(e.what()).find("interrupted: the preparation of the scan") == 0;
  };
  Impatient patient(1);
  check_same_bits(CR::register_scans(v.scan, view(0, 45).scan),
                  CR::register_scans(Scan(v.image, p::visitor(std::ref(patient)).time_budget(1000)), view(0, 45).scan));
  BOOST_TEST(patient.asked > 1);
  const auto ends = [&](const auto& input, int later) {
    // At once, and after some looks at the visitor, which are a millisecond apart.
    for (int looks : {0, later}) {
      Impatient impatient(1, looks);
      BOOST_CHECK_EXCEPTION(Scan(input, p::visitor(std::ref(impatient)), "the scan"), CR::Preparation_interrupted,
                            interrupted);
      BOOST_TEST(impatient.refused == 1);
    }
    BOOST_CHECK_EXCEPTION(Scan(input, p::time_budget(1e-9), "the scan"), CR::Preparation_interrupted, interrupted);
  };
  ends(mesh, 1);
  ends(v.image, 1);
  ends(v.image.points(), 3);

  for (int looks : {0, 2}) {
    Impatient impatient(1, looks);
    const Result result = CR::register_meshes(mesh, mesh, p::visitor(std::ref(impatient)));
    check_proper(result);
    BOOST_TEST(result.status() == CR::NOT_REGISTERED);
    BOOST_TEST(result.reason() == "interrupted: the preparation of the scans");
    BOOST_TEST(impatient.refused == 1);
  }
  const Result late = CR::register_meshes(mesh, mesh, p::time_budget(1e-9));
  BOOST_TEST(late.reason() == "interrupted: the preparation of the scans");
}

BOOST_AUTO_TEST_CASE(extents_of_the_axes)
{
  namespace p = CR::parameters;
  const View &source = view(0, 0), &target = view(0, 45);
  for (const auto& [f1, f2] : {std::pair(0., 0.3), std::pair(0.1, 0.2), std::pair(0.2, 1.)})
    check_right(CR::register_scans(source.scan, target.scan, p::minimum_extent(f1).maximum_extent(f2)), source, target);
  // Nothing is as small, or as large.
  check_not_registered(CR::register_scans(source.scan, target.scan, p::maximum_extent(1e-6)));
  check_not_registered(CR::register_scans(source.scan, target.scan, p::minimum_extent(5.).maximum_extent(6.)));
}

BOOST_AUTO_TEST_CASE(wrong_use_names_the_argument)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Mesh good = mesh_of(generated::bumps(40)), empty;
  Mesh not_a_number = good, infinite = good, quadrangle = good, vertices, flat_mesh;
  not_a_number.point(Mesh::Vertex_index(77)) = Point(0, nan, 0);
  infinite.point(Mesh::Vertex_index(77)) = Point(0, 0, -infinity);
  quadrangle.add_face(quadrangle.add_vertex(Point(0, 0, 2)), quadrangle.add_vertex(Point(1, 0, 2)),
                      quadrangle.add_vertex(Point(1, 1, 2)), quadrangle.add_vertex(Point(0, 1, 2)));
  for (int i = 0; i < 5; ++i) vertices.add_vertex(Point(i, i * i, 0));
  flat_mesh.add_face(flat_mesh.add_vertex(Point(0, 0, 0)), flat_mesh.add_vertex(Point(1, 0, 0)),
                     flat_mesh.add_vertex(Point(2, 0, 0)));
  for (const Mesh* bad : {&empty, static_cast<const Mesh*>(&not_a_number), static_cast<const Mesh*>(&infinite),
                          static_cast<const Mesh*>(&quadrangle), static_cast<const Mesh*>(&vertices),
                          static_cast<const Mesh*>(&flat_mesh)}) {
    BOOST_CHECK_EXCEPTION(CR::register_meshes(*bad, good), std::invalid_argument, names("register_meshes", "source"));
    BOOST_CHECK_EXCEPTION(CR::register_meshes(good, *bad), std::invalid_argument, names("register_meshes", "target"));
    BOOST_CHECK_EXCEPTION(Scan{*bad}, std::invalid_argument, names("Scan", "mesh"));
  }

  const Point above(0.5, 0.5, 5);
  const Kernel::Vector_3 down(0, 0, -1);
  BOOST_CHECK_EXCEPTION(CR::register_meshes(good, good, p::viewpoint(above).viewing_direction(down)),
                        std::invalid_argument, names("register_meshes", "viewing_direction"));
  BOOST_CHECK_EXCEPTION(
      CR::register_meshes(good, good, p::default_values(), p::viewing_direction(down).viewpoint(above)),
      std::invalid_argument, names("register_meshes", "viewpoint"));
  BOOST_CHECK_EXCEPTION(Scan(good, p::viewing_direction(Kernel::Vector_3(0, 0, 0))), std::invalid_argument,
                        names("", "viewing_direction"));
  BOOST_CHECK_EXCEPTION(Scan(good, p::viewpoint(Point(0, nan, 0))), std::invalid_argument, names("", "viewpoint"));

  const Scan scan(good);
  const auto rejects = [&](const auto& np, const std::string& argument) {
    BOOST_CHECK_EXCEPTION(CR::register_scans(scan, scan, np), std::invalid_argument, names("register_scans", argument));
    BOOST_CHECK_THROW(CR::register_meshes(good, good, np), std::invalid_argument);
  };
  rejects(p::minimum_extent(0.3).maximum_extent(0.3), "minimum_extent");
  rejects(p::minimum_extent(0.4).maximum_extent(0.3), "minimum_extent");
  rejects(p::minimum_extent(1.5), "minimum_extent");
  rejects(p::maximum_extent(0.), "maximum_extent");
  rejects(p::minimum_extent(-0.1), "minimum_extent");
  rejects(p::minimum_extent(nan), "minimum_extent");
  rejects(p::time_budget(0), "time_budget");
  rejects(p::time_budget(-1.), "time_budget");
  rejects(p::time_budget(nan), "time_budget");
  rejects(p::maximum_extent(-0.1), "maximum_extent");
  rejects(p::maximum_extent(infinity), "maximum_extent");

  BOOST_CHECK_EXCEPTION(Scan{Image()}, std::invalid_argument, names("Scan", "image"));
  BOOST_CHECK_EXCEPTION(Scan{Image(10, 10)}, std::invalid_argument, names("Scan", "image"));
  BOOST_CHECK_EXCEPTION(Scan{std::vector<Point>()}, std::invalid_argument, names("Scan", "points"));
  BOOST_CHECK_EXCEPTION(Scan(std::vector<Point>{origin, Point(1, nan, 0), Point(0, 1, 0)}), std::invalid_argument,
                        names("Scan", "points"));
}

// A status with its reason, or an exception; never a motion.
BOOST_AUTO_TEST_CASE(too_few_vertices)
{
  const View& other = view(0, 0);
  const Point far_above(0.3, 0.3, 5);
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (const Point& q : {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}) v.push_back(mesh.add_vertex(q));
  mesh.add_face(v[0], v[1], v[2]);
  check_not_registered(CR::register_meshes(mesh, mesh));
  const Result seen = CR::register_meshes(mesh, mesh, p::viewpoint(far_above), p::viewpoint(far_above));
  check_not_registered(seen);
  BOOST_TEST(seen.status() == CR::NOT_REGISTERED);
  BOOST_TEST(seen.reason().find("too few vertices") != std::string::npos);
  const Scan triangle(mesh, p::viewpoint(far_above));
  for (const Result& result : {CR::register_scans(triangle, other.scan), CR::register_scans(other.scan, triangle)}) {
    check_not_registered(result);
    BOOST_TEST(result.status() == CR::NOT_REGISTERED);
  }
  // A tetrahedron looks the same from four sides, whether its faces or its vertices are the samples.
  mesh.clear();
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 1, 0), Point(0, 1, 1), Point(1, 0, 1), mesh);
  check_not_registered(CR::register_meshes(mesh, mesh));
}
