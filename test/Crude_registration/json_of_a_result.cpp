#define BOOST_TEST_MODULE json_of_a_result
#include <boost/test/unit_test.hpp>

#include "../../apps/crude_register/json.h"

#include <CGAL/Crude_registration/Registration_result.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <limits>
#include <locale>
#include <string>
#include <vector>

// The JSON of the command line, read back by a parser.

namespace {

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Result = CR::Registration_result<Kernel>;
using Point = Kernel::Point_3;
using Transformation = Result::Transformation;

// A locale's worst: a comma for the decimal point and dots between thousands.
struct Comma : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// A turn by a third of a turn about the diagonal, and numbers that no short decimal is equal to.
const Transformation motion(0, 0, 1, 1. / 3, 1, 0, 0, -0.1, 0, 1, 0, 1234567.2500000002);

Result some_result()
{
  Result::Parts parts;
  parts.status = CR::AMBIGUOUS;
  parts.reason = "a \"plane\"\n";
  parts.transformation = motion;
  parts.correspondence = {{Point(1. / 3, 2, 3), Point(4, 5, -1e-300)}, {Point(0, 0, 0), Point(7, 8, 0.1)}};
  parts.confidence = 0.1;
  parts.overlap = 1. / 3;
  parts.score = 1e-300;
  parts.source_has_free_space = true;
  for (std::size_t i = 0; i < 6; ++i) parts.covariance[i][i] = double(i) + 0.1;
  parts.covariance[0][1] = std::numeric_limits<double>::infinity();
  parts.free_motions = {"sliding", "turning"};
  parts.runners_up.push_back({Transformation(CGAL::IDENTITY), 0.25, 0.125});
  parts.statistics = {{"reduce", 123456789, 0.5}, {"judge", 12, 0.25}};
  return Result(parts);
}

std::string text_of(const Result& result, bool with_times = false)
{
  Json json = Json::object();
  add_result(json, result, with_times);
  return to_text(json);
}

void check_motion(const Json& rows, const Transformation& expected)
{
  BOOST_REQUIRE(rows.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_REQUIRE(rows[i].size() == 4);
    for (std::size_t j = 0; j < 4; ++j) BOOST_TEST(rows[i][j].get<double>() == expected.m(int(i), int(j)));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(every_member_is_read_back_to_the_last_bit)
{
  const Result result = some_result();
  const Json json = Json::parse(text_of(result));
  BOOST_TEST(json.at("status").get<std::string>() == "ambiguous");
  BOOST_TEST(json.at("reason").get<std::string>() == "a \"plane\"\n");
  BOOST_TEST(json.at("confidence").get<double>() == 0.1);
  BOOST_TEST(json.at("score").get<double>() == 1e-300);
  BOOST_TEST(json.at("overlap").get<double>() == 1. / 3);
  BOOST_TEST(json.at("residual").get<double>() == 0.);
  BOOST_TEST(json.at("free_space_violations").get<double>() == 0.);
  BOOST_TEST(json.at("source_has_free_space").get<bool>());
  BOOST_TEST(!json.at("target_has_free_space").get<bool>());
  check_motion(json.at("target_from_source"), motion);
  check_motion(json.at("crude_target_from_source"), Transformation(CGAL::IDENTITY));
  const auto points = json.at("correspondence").get<std::vector<std::array<std::array<double, 3>, 2>>>();
  BOOST_REQUIRE(points.size() == result.correspondence().size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_TEST(points[i][0][k] == result.correspondence()[i].first[int(k)]);
      BOOST_TEST(points[i][1][k] == result.correspondence()[i].second[int(k)]);
    }
  const Json& covariance = json.at("covariance");
  BOOST_REQUIRE(covariance.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    BOOST_REQUIRE(covariance[i].size() == 6);
    BOOST_TEST(covariance[i][i].get<double>() == double(i) + 0.1);
  }
  BOOST_TEST(covariance[0][1].is_null()); // JSON has no infinity
  BOOST_TEST(json.at("free_motions").get<std::vector<std::string>>() == result.free_motions(),
             boost::test_tools::per_element());
  BOOST_REQUIRE(json.at("runners_up").size() == 1);
  BOOST_TEST(json["runners_up"][0].at("score").get<double>() == 0.25);
  BOOST_TEST(json["runners_up"][0].at("probability").get<double>() == 0.125);
  check_motion(json["runners_up"][0].at("target_from_source"), Transformation(CGAL::IDENTITY));
  BOOST_REQUIRE(json.at("statistics").size() == 2);
  BOOST_TEST(json["statistics"][0].at("stage").get<std::string>() == "reduce");
  BOOST_TEST(json["statistics"][0].at("count").get<std::size_t>() == 123456789u);
  BOOST_TEST(json.size() == 16u); // and nothing else
}

BOOST_AUTO_TEST_CASE(a_result_of_nothing_has_empty_lists)
{
  const Json json = Json::parse(text_of(Result()));
  BOOST_TEST(json.at("status").get<std::string>() == "not_registered");
  for (const char* name : {"correspondence", "free_motions", "runners_up", "statistics"})
    BOOST_TEST((json.at(name).is_array() && json.at(name).empty()));
}

BOOST_AUTO_TEST_CASE(times_are_there_where_asked_for)
{
  for (const bool with_times : {false, true}) {
    const Json json = Json::parse(text_of(some_result(), with_times));
    for (const Json& stage : json.at("statistics")) BOOST_TEST(stage.contains("seconds") == with_times);
    if (with_times) BOOST_TEST(json["statistics"][1].at("seconds").get<double>() == 0.25);
  }
}

BOOST_AUTO_TEST_CASE(the_text_knows_no_locale)
{
  const std::string text = text_of(some_result());
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string elsewhere = text_of(some_result());
  std::locale::global(before);
  BOOST_TEST(text == elsewhere);
}

BOOST_AUTO_TEST_CASE(names_of_files_need_not_be_utf_8)
{
  Json json = Json::object();
  json["source"] = "scan_\xff.ply";
  BOOST_TEST(Json::parse(to_text(json)).at("source").get<std::string>() == "scan_\xef\xbf\xbd.ply");
}
