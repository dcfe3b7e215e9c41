#define BOOST_TEST_MODULE registration_result
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/IO/internal/result_json.h>

#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Result = CR::Registration_result<Kernel>;
using Transformation = Result::Transformation;
using CR::internal::Json_writer;

namespace {

// A locale's worst: a comma for the decimal point and dots between thousands.
struct Comma : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

CR::internal::Rigid_motion some_motion()
{
  CR::internal::Rigid_motion m;
  m.rotation = Eigen::AngleAxisd(0.7, CR::internal::Vector(1, -2, 3).normalized()).toRotationMatrix();
  m.translation = CR::internal::Vector(1.5, -0.1, 1234567.25);
  return m;
}

Result some_result()
{
  Result::Parts parts;
  parts.status = CR::AMBIGUOUS;
  parts.reason = "a \"plane\"\n";
  parts.transformation = CR::internal::to_aff_transformation<Kernel>(some_motion());
  parts.confidence = 0.1;
  parts.overlap = 1. / 3;
  for (std::size_t i = 0; i < 6; ++i) parts.covariance[i][i] = 1;
  parts.covariance[0][0] = std::numeric_limits<double>::infinity();
  parts.free_motions = {"sliding", "turning"};
  parts.runners_up.push_back({Transformation(CGAL::IDENTITY), 0.25});
  parts.statistics = {{"candidates", 123456789, 0.5}, {"scored", 12, 0.25}};
  return Result(parts);
}

std::string json(const Result& result, bool with_times = false)
{
  Json_writer writer;
  writer.begin_object();
  CR::internal::write_json(writer, result, with_times);
  return writer.end_object().text();
}

// What stands between `before` and `after` in a text.
std::string between(const std::string& text, const std::string& before, const std::string& after)
{
  const std::size_t begin = text.find(before);
  BOOST_REQUIRE(begin != std::string::npos);
  const std::size_t from = begin + before.size(), to = text.find(after, from);
  BOOST_REQUIRE(to != std::string::npos);
  return text.substr(from, to - from);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_result_of_nothing_is_not_registered)
{
  const Result result;
  BOOST_TEST(result.status() == CR::NOT_REGISTERED);
  BOOST_TEST(result.confidence() == 0.);
  const Kernel::Point_3 p(1, 2, 3);
  BOOST_CHECK(result.transformation().transform(p) == p);
  BOOST_CHECK(result.inverse_transformation().transform(p) == p);
  BOOST_TEST(result.runners_up().empty());
}

BOOST_AUTO_TEST_CASE(a_status_is_written_as_its_name)
{
  for (const auto& [status, name] :
       {std::make_pair(CR::REGISTERED, "registered"), std::make_pair(CR::AMBIGUOUS, "ambiguous"),
        std::make_pair(CR::NOT_REGISTERED, "not_registered")}) {
    std::ostringstream out;
    out << status;
    BOOST_TEST(out.str() == name);
  }
}

BOOST_AUTO_TEST_CASE(the_inverse_takes_points_back)
{
  const Result result = some_result();
  const Kernel::Point_3 p(1, 2, 3);
  const Kernel::Point_3 q = result.inverse_transformation().transform(result.transformation().transform(p));
  BOOST_TEST(CGAL::squared_distance(p, q) < 1e-16);
}

BOOST_AUTO_TEST_CASE(a_result_is_a_value)
{
  Result a = some_result();
  const Result b = a;
  a = Result();
  BOOST_TEST(b.status() == CR::AMBIGUOUS);
  BOOST_TEST(b.runners_up().size() == 1u);
  BOOST_TEST(json(b) == json(some_result()));
}

BOOST_AUTO_TEST_CASE(json_holds_the_numbers_to_the_last_bit)
{
  const std::string text = json(some_result());
  std::istringstream rows(between(text, "\"target_from_source\": [", "\n  ]"));
  const auto motion = some_motion();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      std::string word;
      rows >> word;
      word.erase(0, word.find_first_not_of('['));
      BOOST_TEST(std::strtod(word.c_str(), nullptr) == (j < 3 ? motion.rotation(i, j) : motion.translation(i)));
    }
  BOOST_TEST(std::strtod(between(text, "\"overlap\": ", ",").c_str(), nullptr) == 1. / 3);
  BOOST_TEST(between(text, "\"confidence\": ", ",") == "0.1");
  BOOST_TEST(between(text, "\"status\": ", ",") == "\"ambiguous\"");
  BOOST_TEST(between(text, "\"reason\": ", ",") == "\"a \\\"plane\\\"\\u000a\"");
  // JSON has no infinity.
  BOOST_TEST(between(text, "\"covariance\": [", ",").find("[null") != std::string::npos);
  BOOST_TEST(text.find("inf") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(json_knows_no_locale_and_no_time)
{
  const std::string text = json(some_result());
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string elsewhere = json(some_result());
  std::locale::global(before);
  BOOST_TEST(text == elsewhere);

  BOOST_TEST(text.find("seconds") == std::string::npos);
  BOOST_TEST(between(json(some_result(), true), "\"seconds\": ", "\n") == "0.5");
  BOOST_TEST(between(text, "\"count\": ", "\n") == "123456789");
}

BOOST_AUTO_TEST_CASE(json_is_nested_with_commas_where_they_belong)
{
  Json_writer json;
  json.begin_object().member("a", 1).member("b", "x").member("c", true).member("d", -0.5);
  json.key("e").begin_array().end_array();
  json.key("f").begin_array().value("y").row(std::vector<double>{1, 2.5}).begin_object().end_object().end_array();
  json.key("g").row(std::vector<double>());
  json.end_object();
  BOOST_TEST(json.text() == "{\n"
                            "  \"a\": 1,\n"
                            "  \"b\": \"x\",\n"
                            "  \"c\": true,\n"
                            "  \"d\": -0.5,\n"
                            "  \"e\": [],\n"
                            "  \"f\": [\n"
                            "    \"y\",\n"
                            "    [1, 2.5],\n"
                            "    {}\n"
                            "  ],\n"
                            "  \"g\": []\n"
                            "}");
}
