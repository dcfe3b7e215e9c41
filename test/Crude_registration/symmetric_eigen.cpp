#define BOOST_TEST_MODULE symmetric_eigen
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <limits>

using namespace CGAL::Crude_registration::internal;
using generated::Random;

namespace {

// A A^T of a random A with `rank` columns.
template <class Matrix_type>
Matrix_type random_matrix(Random& random, Eigen::Index n, Eigen::Index rank)
{
  Eigen::MatrixXd a(n, rank);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < rank; ++j) a(i, j) = random.symmetric();
  return a * a.transpose();
}

template <class Matrix_type>
void check(const Matrix_type& a, const Matrix_type& n, const Symmetric_eigen<Matrix_type>& eigen, double tolerance)
{
  const double size = a.norm();
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    const auto v = eigen.vectors.col(k);
    BOOST_TEST((a * v - eigen.values[k] * (n * v)).norm() <= tolerance * size * v.norm());
    if (k > 0) BOOST_TEST(eigen.values[k - 1] <= eigen.values[k]);
  }
  BOOST_TEST((eigen.vectors.transpose() * n * eigen.vectors - Matrix_type::Identity(a.rows(), a.rows())).norm() <=
             tolerance);
}

template <class Matrix_type>
void check_size(Eigen::Index n)
{
  Random random(1);
  const Matrix_type one = Matrix_type::Identity(n, n);
  for (Eigen::Index rank = 0; rank <= n; ++rank) {
    const Matrix_type a = random_matrix<Matrix_type>(random, n, rank);
    check<Matrix_type>(a, one, symmetric_eigen(a), 1e-13);
    // No value is below zero, and as many as the rank leaves are zero.
    const Symmetric_eigen<Matrix_type> eigen = symmetric_eigen(a);
    for (Eigen::Index k = 0; k < n; ++k) {
      BOOST_TEST(eigen.values[k] >= 0);
      if (k < n - rank) BOOST_TEST(eigen.values[k] <= 1e-14 * a.norm());
    }
    const Matrix_type b = random_matrix<Matrix_type>(random, n, n) + 0.1 * one;
    check<Matrix_type>(a, b, symmetric_eigen(a, b), 1e-12);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(vectors_and_values_satisfy_their_equation)
{
  check_size<Eigen::Matrix3d>(3);
  check_size<Eigen::Matrix<double, 6, 6>>(6);
  for (Eigen::Index n : {1, 4, 12}) check_size<Eigen::MatrixXd>(n);
}

BOOST_AUTO_TEST_CASE(the_lower_triangle_is_read)
{
  Eigen::Matrix3d a;
  a << 2, 0, 0, 1, 2, 0, 0, 0, 5;
  Eigen::Matrix3d spoilt = a;
  spoilt(0, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Matrix3d& m : {a, spoilt}) {
    const Symmetric_eigen<Eigen::Matrix3d> eigen = symmetric_eigen(m);
    BOOST_TEST((eigen.values - Eigen::Vector3d(1, 3, 5)).norm() < 1e-14);
  }
}

// Where values differ by many orders, the small ones are as exact as the matrix has them.
BOOST_AUTO_TEST_CASE(small_values)
{
  const Eigen::Matrix3d a = Eigen::Vector3d(1e-13, 1, 1e13).asDiagonal();
  const Symmetric_eigen<Eigen::Matrix3d> eigen = symmetric_eigen(a);
  BOOST_TEST(eigen.values[0] == 1e-13, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(eigen.values[1] == 1., boost::test_tools::tolerance(1e-12));
}
