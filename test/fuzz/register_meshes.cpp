// Two small meshes of any shape (see Mesh_bytes.h): a sound result. As register_meshes() does it, but with so few
// surfels that there are many runs a second.

#include "Mesh_bytes.h"

#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

Mesh to_mesh(const Byte_mesh& bytes, double unit)
{
  Mesh mesh;
  for (const auto& p : bytes.points) mesh.add_vertex(Kernel::Point_3(unit * p[0], unit * p[1], unit * p[2]));
  for (const auto& f : bytes.faces) {
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    const Mesh::Vertex_index a(f[0]), b(f[1]), c(f[2]);
    if (mesh.add_face(a, b, c) != Mesh::null_face()) continue;
    const Kernel::Point_3 p = mesh.point(a), q = mesh.point(b), r = mesh.point(c);
    const Mesh::Vertex_index d = mesh.add_vertex(p), e = mesh.add_vertex(q), g = mesh.add_vertex(r);
    mesh.add_face(d, e, g);
  }
  return mesh;
}

bool is_rigid(const CGAL::Aff_transformation_3<Kernel>& transformation)
{
  const CR::internal::Rigid_motion m = CR::internal::to_rigid_motion(transformation);
  return m.translation.allFinite() &&
         (m.rotation * m.rotation.transpose() - CR::internal::Matrix::Identity()).norm() < 1e-9 &&
         std::abs(m.rotation.determinant() - 1) < 1e-9;
}

bool has_nan(const CR::Registration_result<Kernel>::Covariance& covariance)
{
  for (const auto& row : covariance)
    for (const double number : row)
      if (std::isnan(number)) return true;
  return false;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Byte_reader bytes(data, size);
  const double unit = std::pow(10., std::int8_t(bytes.next()) / 12); // 1e-10 .. 1e10
  const Mesh a = to_mesh(bytes.mesh(), unit), b = to_mesh(bytes.mesh(), unit);
  CR::internal::Reduction_parameters few;
  few.fine_surfels = 300;
  few.coarse_surfels = 60;
  const auto prepared = [&](const Mesh& mesh) {
    return CR::internal::reduce_scan(CR::internal::to_flat_mesh(mesh, CR::parameters::default_values(), "", ""),
                                     CR::internal::Flat_sensor(), few);
  };
  const CR::internal::Reduced_scan source = prepared(a), target = prepared(b);
  if (source.number_of_samples == 0 || target.number_of_samples == 0) return 0;
  CR::internal::Oriented_pair_parameters short_search;
  for (CR::internal::Oriented_pair_round& round : short_search.rounds) {
    round.looks /= 100;
    round.kept = 8;
    round.judged = 3;
  }
  constexpr auto one_thread = CR::internal::Execution::SEQUENTIAL;
  const auto candidates = [&](const CR::internal::Reduced_scan& s, const CR::internal::Reduced_scan& t) {
    return std::make_unique<CR::internal::Oriented_pair_search>(s, t, short_search, one_thread);
  };
  CR::internal::Run_control to_the_end;
  const auto result = CR::internal::to_result<Kernel>(
      CR::internal::register_reduced_scans(source, target, candidates, one_thread, to_the_end));
  const bool is_sound = is_rigid(result.transformation()) && is_rigid(result.crude_transformation()) &&
                        result.confidence() >= 0 && result.confidence() <= 1 && std::isfinite(result.overlap()) &&
                        std::isfinite(result.residual()) && !has_nan(result.covariance()) &&
                        (result.status() == CR::REGISTERED) == result.reason().empty();
  if (!is_sound) std::abort();
  return 0;
}
