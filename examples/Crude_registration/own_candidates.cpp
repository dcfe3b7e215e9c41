#include <CGAL/Crude_registration.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/centroid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <vector>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vector = Kernel::Vector_3;
using Motion = Kernel::Aff_transformation_3;

// A model of CandidateRounds: motions that are known from the start, in one round.
class One_round
{
public:
  explicit One_round(const std::vector<Motion>& motions) : m_motions(motions) {}

  std::vector<Motion> operator()(const std::function<bool()>&)
  {
    m_is_done = true;
    return m_motions;
  }

  bool is_done() const { return m_is_done; }

private:
  std::vector<Motion> m_motions;
  bool m_is_done = false;
};

// A model of CandidateGenerator, for scans of nearly the same part of an object whose axes have other names: the 24
// rotations that map axes to axes, about the centroids.
class Renamed_axes
{
public:
  template <class ConcurrencyTag>
  One_round rounds(const CR::Scan<Kernel>& source, const CR::Scan<Kernel>& target) const
  {
    const auto from = centroid(source) - CGAL::ORIGIN, to = centroid(target) - CGAL::ORIGIN;
    std::vector<Motion> motions;
    std::array<int, 3> axis = {0, 1, 2};
    do
      for (int signs = 0; signs < 8; ++signs) {
        std::array<std::array<double, 3>, 3> r{};
        for (unsigned i = 0; i < 3; ++i) r[i][std::size_t(axis[i])] = (signs >> i & 1) == 0 ? 1 : -1;
        const Motion rotation(r[0][0], r[0][1], r[0][2], r[1][0], r[1][1], r[1][2], r[2][0], r[2][1], r[2][2]);
        if (!rotation.is_even()) continue; // a mirror image
        motions.push_back(Motion(CGAL::TRANSLATION, to) * rotation * Motion(CGAL::TRANSLATION, -from));
      }
    while (std::next_permutation(axis.begin(), axis.end()));
    return One_round(motions);
  }

private:
  static Kernel::Point_3 centroid(const CR::Scan<Kernel>& scan)
  {
    const std::vector<Kernel::Point_3> points = scan.points();
    return CGAL::centroid(points.begin(), points.end());
  }
};

// Two simulated scans, the axes of the first of which are exchanged, are registered by a generator of one's own.
int main()
{
  CGAL::Surface_mesh<Kernel::Point_3> statue;
  CR::make_statue(statue, 96);
  const CR::Simulated_scene scene(statue);
  auto camera =
      CR::Range_camera<Kernel>::framing(CGAL::Polygon_mesh_processing::bbox(statue), Vector(-1, 0, -0.2), 200);
  camera.noise = 0.1;
  auto source = scene.range_image(camera);
  camera.seed = 1;
  const auto target = scene.range_image(camera);

  const Motion exchange(0, 0, 1, 1, 0, 0, 0, 1, 0); // x is z, y is x, z is y
  CR::transform(source.image, exchange);
  const CR::Scan<Kernel> a(source.image), b(target.image);
  const auto result = CR::register_scans(a, b, CR::parameters::candidates(Renamed_axes()));

  const Motion truth = target.scene_from_scan.inverse() * source.scene_from_scan * exchange.inverse();
  double distance = 0; // from where the points of the scan belong, at most
  for (const Kernel::Point_3& p : a.points())
    distance = (std::max)(distance, std::sqrt(CGAL::squared_distance(result.transformation()(p), truth(p))));
  std::cout << result.status() << ", " << distance / a.spacing() << " sampling distances from the truth\n";
  return result.status() == CR::REGISTERED && distance < a.spacing() ? EXIT_SUCCESS : EXIT_FAILURE;
}
