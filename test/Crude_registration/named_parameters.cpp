#define BOOST_TEST_MODULE named_parameters
#include <boost/test/unit_test.hpp>

#include "wrong_use.h"

#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace internal = CR::internal;
namespace internal_np = CR::internal_np;

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

namespace {

// A function of the package: takes any pack, has two parameters of the package and one of CGAL.
template <class NamedParameters = CR::parameters::Default_named_parameters>
std::vector<double> read(const NamedParameters& np = CR::parameters::default_values())
{
  return {double(internal::parameter(np, internal_np::minimum_extent, -1.)),
          double(internal::parameter(np, internal_np::number_of_vertices, -1)),
          double(internal::parameter(np, internal_np::random_seed, -1))};
}

using Values = std::vector<double>;

struct Uncopyable
{
  int value = 0;
  Uncopyable() = default;
  Uncopyable(const Uncopyable&) = delete;
};

} // namespace

BOOST_AUTO_TEST_CASE(names_chain_in_any_order)
{
  namespace p = CR::parameters;
  const Values all = {0.25, 7, 3};
  BOOST_TEST(read(p::minimum_extent(0.25).number_of_vertices(7).random_seed(3)) == all);
  BOOST_TEST(read(p::minimum_extent(0.25).random_seed(3).number_of_vertices(7)) == all);
  BOOST_TEST(read(p::random_seed(3).minimum_extent(0.25).number_of_vertices(7)) == all);
  BOOST_TEST(read(p::random_seed(3).neighbor_radius(0.5).number_of_vertices(7).viewpoint(Point()).minimum_extent(
                 0.25)) == all);
}

BOOST_AUTO_TEST_CASE(what_is_not_given_has_its_default)
{
  BOOST_TEST(read() == (Values{-1, -1, -1}));
  BOOST_TEST(read(CGAL::parameters::default_values()) == (Values{-1, -1, -1}));
  BOOST_TEST(read(CR::parameters::neighbor_radius(0.5)) == (Values{-1, -1, -1}));
  BOOST_TEST(read(CR::parameters::number_of_vertices(7)) == (Values{-1, 7, -1}));
}

BOOST_AUTO_TEST_CASE(packs_of_cgal_alone_are_accepted)
{
  BOOST_TEST(read(CGAL::parameters::random_seed(3)) == (Values{-1, -1, 3}));
  BOOST_TEST(read(CGAL::parameters::neighbor_radius(0.5).random_seed(3)) == (Values{-1, -1, 3}));
  // A name of CGAL that no function here understands ends this package's chain, and is ignored.
  BOOST_TEST(read(CR::parameters::minimum_extent(0.25).density_control_factor(2.)) == (Values{0.25, -1, -1}));
}

BOOST_AUTO_TEST_CASE(the_last_value_counts)
{
  BOOST_TEST(read(CR::parameters::minimum_extent(0.1).random_seed(1).minimum_extent(0.2).random_seed(2)) ==
             (Values{0.2, -1, 2}));
}

BOOST_AUTO_TEST_CASE(given_or_not_is_known_when_compiling)
{
  const auto np = CR::parameters::viewpoint(Point(1, 2, 3)).geom_traits(Kernel());
  using Np = std::remove_const_t<decltype(np)>;
  static_assert(internal::is_given<Np, internal_np::viewpoint_t>, "");
  static_assert(internal::is_given<Np, internal_np::geom_traits_t>, "");
  static_assert(!internal::is_given<Np, internal_np::viewing_direction_t>, "");
  static_assert(!internal::is_given<Np, internal_np::vertex_point_t>, "");
  static_assert(!internal::is_given<CR::parameters::Default_named_parameters, internal_np::viewpoint_t>, "");
  BOOST_CHECK(internal::parameter(np, internal_np::viewpoint, Point()) == Point(1, 2, 3));
}

BOOST_AUTO_TEST_CASE(values_are_held_by_copy_or_by_reference_as_in_cgal)
{
  Uncopyable fixed;
  const auto a = CR::parameters::geom_traits(fixed).minimum_extent(0.5);
  fixed.value = 5;
  BOOST_TEST(internal::parameter(a, internal_np::geom_traits, 0).get().value == 5);

  int calls = 0;
  const auto b = CR::parameters::minimum_extent(0.5).geom_traits(std::ref(calls)).tolerance(0.1);
  ++internal::parameter(b, internal_np::geom_traits, 0).get();
  BOOST_TEST(calls == 1);
}

BOOST_AUTO_TEST_CASE(a_pack_works_with_functions_of_cgal)
{
  Mesh mesh;
  const auto v = mesh.add_vertex(Point(1, 0, 0));
  auto other = mesh.add_property_map<Mesh::Vertex_index, Point>("v:other", Point(2, 0, 0)).first;
  const CGAL::Aff_transformation_3<Kernel> up(CGAL::TRANSLATION, Kernel::Vector_3(0, 0, 1));

  const auto np = CR::parameters::minimum_extent(0.1).vertex_point_map(other).tolerance(0.2);
  CGAL::Polygon_mesh_processing::transform(up, mesh, internal::cgal_parameters(np));
  BOOST_CHECK(mesh.point(v) == Point(1, 0, 0));
  BOOST_CHECK(other[v] == Point(2, 0, 1));

  // CGAL's look-up of types reads a pack of ours without help.
  using Map = CGAL::GetVertexPointMap<Mesh, std::remove_const_t<decltype(np)>>::type;
  static_assert(std::is_same<Map, decltype(other)>::value, "");

  // A pack of CGAL's passes through untouched.
  const auto cgal = CGAL::parameters::vertex_point_map(other);
  BOOST_TEST(&internal::cgal_parameters(cgal) == &cgal);
}

BOOST_AUTO_TEST_CASE(wrong_numbers_name_the_function_and_the_parameter)
{
  namespace p = CR::parameters;
  const auto positive = [](const auto& np) {
    return internal::positive_parameter(np, internal_np::tolerance, 0.5, "f", "tolerance");
  };
  BOOST_TEST(positive(p::default_values()) == 0.5);
  BOOST_TEST(positive(p::tolerance(2)) == 2.);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double bad : {0., -1., nan, infinity})
    BOOST_CHECK_EXCEPTION(positive(p::tolerance(bad)), std::invalid_argument, names("f:", "tolerance"));

  const auto extent = [](const auto& np) {
    return internal::non_negative_parameter(np, internal_np::minimum_extent, 0.5, "g", "minimum_extent");
  };
  BOOST_TEST(extent(p::minimum_extent(0)) == 0.);
  for (double bad : {-1., nan, infinity})
    BOOST_CHECK_EXCEPTION(extent(p::minimum_extent(bad)), std::invalid_argument, names("g:", "minimum_extent"));

  const auto count = [](const auto& np) {
    return internal::count_parameter(np, internal_np::number_of_vertices, 9, 4, "h", "number_of_vertices");
  };
  BOOST_TEST(count(p::default_values()) == 9u);
  BOOST_TEST(count(p::number_of_vertices(4)) == 4u);
  BOOST_TEST(count(p::number_of_vertices(5u)) == 5u);
  for (int bad : {-1, 0, 3})
    BOOST_CHECK_EXCEPTION(count(p::number_of_vertices(bad)), std::invalid_argument, names("h:", "number_of_vertices"));
}
