#define BOOST_TEST_MODULE registration_result
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/IO/internal/result_json.h>

#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
  parts.score = -0.7;
  parts.residual = 1e-300;
  parts.free_space_violations = 2e20 / 3;
  parts.source_has_free_space = true;
  parts.crude_transformation = CR::internal::to_aff_transformation<Kernel>(some_motion().inverse());
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

using Tree = boost::property_tree::ptree;

// As another program reads it.
Tree parsed(const std::string& text)
{
  std::istringstream in(text);
  Tree tree;
  boost::property_tree::read_json(in, tree);
  return tree;
}

// A number to the last bit.
double number(const Tree& tree)
{
  const std::string word = tree.data();
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  BOOST_TEST((!word.empty() && *end == 0), word << " is no number");
  return value;
}

std::vector<Tree> elements(const Tree& array)
{
  std::vector<Tree> result;
  for (const auto& member : array) {
    BOOST_TEST(member.first == ""); // of an array, not of an object
    result.push_back(member.second);
  }
  return result;
}

void check_motion(const Tree& rows, const Transformation& motion)
{
  const std::vector<Tree> all = elements(rows);
  BOOST_TEST_REQUIRE(all.size() == 3u);
  for (int i = 0; i < 3; ++i) {
    const std::vector<Tree> row = elements(all[std::size_t(i)]);
    BOOST_TEST_REQUIRE(row.size() == 4u);
    for (int j = 0; j < 4; ++j) BOOST_TEST(number(row[std::size_t(j)]) == motion.m(i, j));
  }
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

BOOST_AUTO_TEST_CASE(json_holds_the_result_to_the_last_bit)
{
  const Result result = some_result();
  const Tree tree = parsed(json(result));
  check_motion(tree.get_child("target_from_source"), result.transformation());
  check_motion(tree.get_child("crude_target_from_source"), result.crude_transformation());
  for (const auto& [name, value] :
       {std::pair("overlap", result.overlap()), std::pair("confidence", result.confidence()),
        std::pair("score", result.score()), std::pair("residual", result.residual()),
        std::pair("free_space_violations", result.free_space_violations())})
    BOOST_TEST(number(tree.get_child(name)) == value);
  BOOST_TEST(tree.get<std::string>("status") == "ambiguous");
  BOOST_TEST(tree.get<std::string>("reason") == "a \"plane\"\n");
  BOOST_TEST(tree.get<bool>("source_has_free_space") == true);
  BOOST_TEST(tree.get<bool>("target_has_free_space") == false);

  const std::vector<Tree> covariance = elements(tree.get_child("covariance"));
  BOOST_TEST_REQUIRE(covariance.size() == 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::vector<Tree> row = elements(covariance[i]);
    BOOST_TEST_REQUIRE(row.size() == 6u);
    for (std::size_t j = 0; j < 6; ++j) {
      if (i == 0 && j == 0) BOOST_TEST(row[j].data() == "null"); // JSON has no infinity
      else BOOST_TEST(number(row[j]) == result.covariance()[i][j]);
    }
  }

  const std::vector<Tree> free = elements(tree.get_child("free_motions"));
  BOOST_TEST_REQUIRE(free.size() == 2u);
  BOOST_TEST(free[0].data() == "sliding");
  BOOST_TEST(free[1].data() == "turning");
  const std::vector<Tree> others = elements(tree.get_child("runners_up"));
  BOOST_TEST_REQUIRE(others.size() == 1u);
  BOOST_TEST(number(others[0].get_child("score")) == 0.25);
  check_motion(others[0].get_child("target_from_source"), Transformation(CGAL::IDENTITY));
}

BOOST_AUTO_TEST_CASE(json_knows_no_locale_and_no_time)
{
  const std::string text = json(some_result());
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string elsewhere = json(some_result());
  std::locale::global(before);
  BOOST_TEST(text == elsewhere);

  const std::vector<Tree> stages = elements(parsed(text).get_child("statistics")),
                          timed = elements(parsed(json(some_result(), true)).get_child("statistics"));
  BOOST_TEST_REQUIRE(stages.size() == 2u);
  BOOST_TEST_REQUIRE(timed.size() == 2u);
  for (const Tree& stage : stages) BOOST_TEST(stage.count("seconds") == 0u);
  BOOST_TEST(number(timed[0].get_child("seconds")) == 0.5);
  BOOST_TEST(number(timed[1].get_child("seconds")) == 0.25);
  BOOST_TEST(stages[0].get<std::string>("stage") == "candidates");
  BOOST_TEST(stages[0].get<std::string>("count") == "123456789");
}

// The parser refuses a comma too many or too few.
BOOST_AUTO_TEST_CASE(json_is_nested)
{
  Json_writer json;
  json.begin_object().member("a", 1).member("b", "x").member("c", true).member("d", -0.5);
  json.key("e").begin_array().end_array();
  json.key("f").begin_array().value("y").row(std::vector<double>{1, 2.5}).begin_object().end_object().end_array();
  json.key("g").row(std::vector<double>());
  json.end_object();
  const Tree tree = parsed(json.text());
  std::string names;
  for (const auto& member : tree) names += member.first;
  BOOST_TEST(names == "abcdefg");
  BOOST_TEST(tree.get<std::string>("a") == "1");
  BOOST_TEST(tree.get<std::string>("b") == "x");
  BOOST_TEST(tree.get<std::string>("c") == "true");
  BOOST_TEST(number(tree.get_child("d")) == -0.5);
  BOOST_TEST(elements(tree.get_child("e")).empty());
  const std::vector<Tree> f = elements(tree.get_child("f"));
  BOOST_TEST_REQUIRE(f.size() == 3u);
  BOOST_TEST(f[0].data() == "y");
  BOOST_TEST_REQUIRE(elements(f[1]).size() == 2u);
  BOOST_TEST(number(elements(f[1])[1]) == 2.5);
  BOOST_TEST(f[2].empty());
  BOOST_TEST(elements(tree.get_child("g")).empty());
  BOOST_CHECK_THROW(parsed("{\"a\": [1,]}"), boost::property_tree::json_parser_error);
}
