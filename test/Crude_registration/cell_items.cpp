#define BOOST_TEST_MODULE cell_items
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/lookup/cell_items.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

using CGAL::Crude_registration::internal::Cell_item;
using CGAL::Crude_registration::internal::items_by_cells;
using CGAL::Crude_registration::internal::sort_cell_items;
using CGAL::Crude_registration::internal::to_the_end;
using CGAL::Crude_registration::internal::Vector_f;
using generated::Random;
using generated::Vector;

namespace {

// The cell of a point, by the definition.
std::array<double, 3> cell_of(const Vector& p, double cell)
{
  std::array<double, 3> c;
  for (int i = 0; i < 3; ++i) c[std::size_t(i)] = std::floor((std::min)((std::max)(p[i] / cell, -1048575.), 1048575.));
  return c;
}

void check_items(const std::vector<Vector>& points, double cell)
{
  const std::vector<Cell_item> items = items_by_cells(points, cell, to_the_end());
  BOOST_TEST_REQUIRE(items.size() == points.size());
  std::vector<std::tuple<std::array<double, 3>, std::uint32_t>> expected;
  for (std::size_t i = 0; i < points.size(); ++i) expected.emplace_back(cell_of(points[i], cell), std::uint32_t(i));
  std::sort(expected.begin(), expected.end());
  std::size_t wrong = 0, wrong_keys = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    wrong += items[i].index != std::get<1>(expected[i]);
    if (i > 0)
      wrong_keys += (items[i].key == items[i - 1].key) != (std::get<0>(expected[i]) == std::get<0>(expected[i - 1]));
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(wrong_keys == 0u);
}

} // namespace

BOOST_AUTO_TEST_CASE(points_are_in_the_order_of_their_cells)
{
  Random random(1);
  // Cells of a power of two, so that the division is exact whichever way it is done.
  for (const double size : {0.25, 3., 1000., 40000.}) {
    std::vector<Vector> points;
    for (int i = 0; i < 3000; ++i) points.push_back(size * random.vector());
    check_items(points, 0.5);
    for (int i = 0; i < 5; ++i) points.push_back(1e7 * random.vector());            // beyond the last cells
    for (int i = 0; i < 50; ++i) points.push_back(0.5 * Vector(i - 25, 25 - i, 0)); // on the borders of cells
    check_items(points, 0.5);
  }
}

BOOST_AUTO_TEST_CASE(cells_do_not_move_with_what_is_in_them)
{
  // Where the cells begin is fixed, whichever cells there are.
  Random random(2);
  std::vector<Vector_f> points;
  for (int i = 0; i < 500; ++i) points.push_back(random.vector().cast<float>());
  const std::vector<Cell_item> before = items_by_cells(points, 0.25f, to_the_end());
  points.emplace_back(-77.f, 500.f, 3.f);
  const std::vector<Cell_item> after = items_by_cells(points, 0.25f, to_the_end());
  BOOST_TEST_REQUIRE(after.size() == before.size() + 1);
  BOOST_TEST(after.front().index == 500u);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < before.size(); ++i) wrong += before[i].index != after[i + 1].index;
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(keys_of_all_bits)
{
  Random random(3);
  const auto bits = [&] { return std::uint64_t((random.symmetric() + 1) * double(1 << 22)); };
  std::vector<Cell_item> items;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const std::uint64_t key = bits() << 42 | bits() << 21 | bits();
    // Some that differ in one digit only, and some that are the same.
    items.push_back({i % 4 == 1 ? items.back().key : i % 4 == 2 ? items.back().key ^ std::uint64_t(1) << 40 : key, i});
  }
  std::vector<Cell_item> expected = items;
  std::sort(expected.begin(), expected.end(), [](const Cell_item& a, const Cell_item& b) {
    return std::make_tuple(a.key, a.index) < std::make_tuple(b.key, b.index);
  });
  sort_cell_items(items, to_the_end());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
    wrong += items[i].key != expected[i].key || items[i].index != expected[i].index;
  BOOST_TEST(wrong == 0u);
  std::vector<Cell_item> none;
  sort_cell_items(none, to_the_end());
  BOOST_TEST(none.empty());
  BOOST_TEST(items_by_cells(std::vector<Vector>(), 1., to_the_end()).empty());
}
