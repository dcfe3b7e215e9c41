#define BOOST_TEST_MODULE registration_result
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/Registration_result.h>

#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <sstream>
#include <utility>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Result = CR::Registration_result<Kernel>;
using Transformation = Result::Transformation;

namespace {

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
  parts.reason = "a plane";
  parts.transformation = CR::internal::to_aff_transformation<Kernel>(some_motion());
  parts.confidence = 0.1;
  parts.overlap = 1. / 3;
  parts.covariance[0][0] = 0.5;
  parts.free_motions = {"sliding", "turning"};
  parts.runners_up.push_back({Transformation(CGAL::IDENTITY), 0.25, 0.125});
  parts.statistics = {{"candidates", 123456789, 0.5}, {"scored", 12, 0.25}};
  return Result(parts);
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
  BOOST_TEST(result.correspondence().empty());
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
  BOOST_TEST(b.reason() == some_result().reason());
  BOOST_CHECK(b.covariance() == some_result().covariance());
  BOOST_TEST(b.free_motions() == some_result().free_motions(), boost::test_tools::per_element());
}
