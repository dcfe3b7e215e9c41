// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The stages of the default method, each on its own, on simulated scans of some sizes. Options are those of
// google-benchmark: --benchmark_filter=search, for example.

#include "generated_scan.h"

#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>
#include <CGAL/Crude_registration/internal/lookup/Vertex_pair_index.h>
#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/internal/motion/refine_step.h>
#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/reduction/principal_curvatures.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace CR = CGAL::Crude_registration;
using benchmark_tools::Generated_scene;
using Kernel = Generated_scene::Kernel;
using Mesh = Generated_scene::Mesh;

namespace {

// Two views of the body that overlap, and what the stages start from.
struct Input
{
  Generated_scene::Simulated_scan source, target;
  Mesh source_mesh, target_mesh;
  double sampling_distance;
  CR::Scan<Kernel> source_scan, target_scan;
  CR::internal::Rigid_motion truth;

  Input(const Generated_scene& scene, std::size_t samples)
      : source(scene.scan(samples, 0, 1)), target(scene.scan(samples, 0.6, 2)),
        sampling_distance(CR::sampling_distance(source.image)), source_scan(source.image), target_scan(target.image)
  {
    CR::triangulate_range_image(source.image, source_mesh);
    CR::triangulate_range_image(target.image, target_mesh);
    truth = CR::internal::to_rigid_motion(target.scene_from_scan.inverse() * source.scene_from_scan);
  }

  // target from source, in the frames of the prepared scans
  CR::internal::Pose true_pose() const
  {
    return CR::internal::to_pose(target_scan.reduced().own_from_input * truth *
                                 source_scan.reduced().own_from_input.inverse());
  }
};

const Input& input(const benchmark::State& state)
{
  static const Generated_scene scene(160);
  static std::map<std::int64_t, std::unique_ptr<Input>> inputs;
  std::unique_ptr<Input>& result = inputs[state.range(0)];
  if (!result) result = std::make_unique<Input>(scene, std::size_t(state.range(0)));
  return *result;
}

void count_vertices(benchmark::State& state, const Mesh& mesh)
{
  state.SetItemsProcessed(state.iterations() * std::int64_t(mesh.number_of_vertices()));
}

void curvatures(benchmark::State& state)
{
  Mesh mesh = input(state).source_mesh;
  const auto map = mesh.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:curvatures").first;
  for (auto _ : state) CR::principal_curvatures(mesh, map);
  count_vertices(state, mesh);
}

void curvatures_averaged(benchmark::State& state)
{
  const Input& in = input(state);
  Mesh mesh = in.source_mesh;
  const auto map = mesh.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:curvatures").first;
  for (auto _ : state) CR::principal_curvatures(mesh, map, CR::parameters::neighbor_radius(4 * in.sampling_distance));
  count_vertices(state, mesh);
}

// To the paper's approximation error: by CGAL's edge collapse, the reference ...
void simplification_plain(benchmark::State& state)
{
  const Input& in = input(state);
  const double error = CR::approximation_error(in.source.image);
  std::size_t left = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Mesh mesh = in.source_mesh;
    state.ResumeTiming();
    left = CR::simplify_scan(mesh, CR::parameters::approximation_error(error));
  }
  count_vertices(state, in.source_mesh);
  state.counters["left"] = double(left);
}

// ... and with grouping before the collapse.
void simplification(benchmark::State& state)
{
  const Input& in = input(state);
  const double error = CR::approximation_error(in.source.image);
  std::size_t left = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Mesh mesh = in.source_mesh;
    state.ResumeTiming();
    left = CR::simplify_scan(mesh, CR::parameters::approximation_error(error).cell_size(3.5 * in.sampling_distance));
  }
  count_vertices(state, in.source_mesh);
  state.counters["left"] = double(left);
}

void preparation_of_image(benchmark::State& state)
{
  const Input& in = input(state);
  for (auto _ : state) benchmark::DoNotOptimize(CR::Scan<Kernel>(in.source.image).spacing());
  count_vertices(state, in.source_mesh);
}

void preparation_of_mesh(benchmark::State& state)
{
  const Input& in = input(state);
  for (auto _ : state) benchmark::DoNotOptimize(CR::Scan<Kernel>(in.source_mesh).spacing());
  count_vertices(state, in.source_mesh);
}

// What the search and the judgement below start from: scans reduced from about 40,000 samples; their surfels are as
// many whatever the size of a scan.
CR::internal::Oriented_pair_search search_of(const Input& in)
{
  return {in.source_scan.reduced(), in.target_scan.reduced(), CR::internal::Oriented_pair_parameters(),
          CR::internal::Execution::SEQUENTIAL};
}

CR::internal::Pose_judge judge_of(const Input& in)
{
  return {in.source_scan.reduced(), in.target_scan.reduced(), CR::internal::Execution::SEQUENTIAL,
          CR::internal::to_the_end()};
}

CR::internal::Proposals proposals_of(const Input& in)
{
  auto search = search_of(in);
  return *search.next(CR::internal::to_the_end());
}

void index_of_pairs(benchmark::State& state)
{
  const CR::internal::Reduced_scan& target = input(state).target_scan.reduced();
  const CR::internal::Oriented_pair_parameters parameters;
  const float length = parameters.length(parameters.rounds.front().scales.front()) * float(target.extent),
              half_width = parameters.target_half_width * target.coarse.spacing;
  std::size_t size = 0;
  for (auto _ : state) {
    const CR::internal::Surfel_pair_index index(target.coarse.surfels, length, half_width);
    size = index.size();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(size));
}

// The same pairs in the index of all lengths and any tolerances.
void index_of_pairs_for_any_tolerance(benchmark::State& state)
{
  const CR::internal::Reduced_scan& target = input(state).target_scan.reduced();
  const CR::internal::Oriented_pair_parameters parameters;
  const double length = double(parameters.length(parameters.rounds.front().scales.front())) * target.extent,
               half_width = double(parameters.target_half_width * target.coarse.spacing);
  std::vector<CR::internal::Vector> points, normals;
  for (const CR::internal::Surfel& s : target.coarse.surfels) {
    points.push_back(s.position.cast<double>());
    normals.push_back(s.normal.cast<double>());
  }
  const double angle_cell = CGAL_PI / 15; // as wide as the bins of the other one
  std::size_t size = 0;
  for (auto _ : state) {
    const CR::internal::Vertex_pair_index index(points, normals, length - half_width, length + half_width, half_width,
                                                angle_cell);
    size = index.size();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(size));
}

// Making the candidates of the first round and testing them by witnesses and scores; per look.
void search_round(benchmark::State& state)
{
  const Input& in = input(state);
  std::vector<CR::internal::Stage_record> stages;
  for (auto _ : state) {
    auto search = search_of(in);
    benchmark::DoNotOptimize(search.next(CR::internal::to_the_end()));
    stages = search.stages();
  }
  for (const CR::internal::Stage_record& s : stages) {
    if (s.name == "propose: looks") state.SetItemsProcessed(state.iterations() * std::int64_t(s.count));
    if (s.name == "propose: scores") state.counters["candidates"] = double(s.count);
  }
}

// The refinement of the best of what the first round proposes, and what all of it is evidence of; per proposal.
void judgement_of_round(benchmark::State& state)
{
  const Input& in = input(state);
  const CR::internal::Proposals proposals = proposals_of(in);
  for (auto _ : state) {
    auto judge = judge_of(in);
    judge.add_round(proposals);
    benchmark::DoNotOptimize(judge.distinct_poses());
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(proposals.poses.size()));
}

// One pose: its refinement on the fine surfels, and its score.
void judgement_of_pose(benchmark::State& state)
{
  const Input& in = input(state);
  const auto judge = judge_of(in);
  const CR::internal::Pose pose = in.true_pose();
  for (auto _ : state) benchmark::DoNotOptimize(judge.refined(pose));
}

void score_of_pose(benchmark::State& state)
{
  const Input& in = input(state);
  const auto judge = judge_of(in);
  const CR::internal::Pose pose = in.true_pose();
  float score = 0;
  for (auto _ : state) benchmark::DoNotOptimize(score = judge.assess(pose).score());
  state.counters["score"] = double(score);
}

// The agreement of all coarse probes, without an end at a bound; per probe of either scan.
void agreement_of_probes(benchmark::State& state)
{
  const Input& in = input(state);
  const CR::internal::Reduced_scan &source = in.source_scan.reduced(), &target = in.target_scan.reduced();
  const auto source_probes = CR::internal::ordered_probes(source.coarse),
             target_probes = CR::internal::ordered_probes(target.coarse);
  const float spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
  const CR::internal::Look look{spacing, 0.7f, spacing};
  const CR::internal::Pose pose = in.true_pose();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        CR::internal::agreement(source, source_probes, target, target_probes, target.coarse, pose, look));
  state.SetItemsProcessed(state.iterations() * std::int64_t(source_probes.size() + target_probes.size()));
}

// One step of refinement on the coarse surfels, from half a spacing off; per probe.
void refinement_step(benchmark::State& state)
{
  const Input& in = input(state);
  const CR::internal::Reduced_scan &source = in.source_scan.reduced(), &target = in.target_scan.reduced();
  const auto probes = CR::internal::neighbouring_probes(source.coarse, source.coarse.probes.size());
  const float spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
  CR::internal::Pose start = in.true_pose();
  start.translation[0] += 0.5f * spacing;
  for (auto _ : state) {
    CR::internal::Pose pose = start;
    benchmark::DoNotOptimize(CR::internal::refine_step(probes, target.coarse, {spacing, 0.7f}, pose));
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(probes.size()));
}

void registration(benchmark::State& state)
{
  const Input& in = input(state);
  for (auto _ : state) benchmark::DoNotOptimize(CR::register_scans(in.source_scan, in.target_scan).score());
}

// All vertices onto the faces of the target, from two sampling distances off.
void refinement_on_meshes(benchmark::State& state)
{
  const Input& in = input(state);
  CR::internal::Rigid_motion start = in.truth;
  start.translation += CR::internal::Vector::Constant(2 * in.sampling_distance);
  const auto motion = CR::internal::to_aff_transformation<Kernel>(start);
  std::size_t iterations = 0;
  for (auto _ : state)
    iterations = CR::refine_motion<CGAL::Sequential_tag>(in.source_mesh, in.target_mesh, motion).iterations;
  count_vertices(state, in.source_mesh);
  state.counters["steps"] = double(iterations);
}

BENCHMARK(curvatures)->Arg(10000)->Arg(40000)->Arg(160000)->Unit(benchmark::kMillisecond);
BENCHMARK(curvatures_averaged)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(simplification_plain)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(simplification)->Arg(10000)->Arg(40000)->Arg(160000)->Unit(benchmark::kMillisecond);
BENCHMARK(preparation_of_image)->Arg(10000)->Arg(40000)->Arg(160000)->Unit(benchmark::kMillisecond);
BENCHMARK(preparation_of_mesh)->Arg(10000)->Arg(40000)->Arg(160000)->Unit(benchmark::kMillisecond);
BENCHMARK(index_of_pairs)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(index_of_pairs_for_any_tolerance)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(search_round)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(judgement_of_round)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(judgement_of_pose)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(score_of_pose)->Arg(40000)->Unit(benchmark::kMicrosecond);
BENCHMARK(agreement_of_probes)->Arg(40000)->Unit(benchmark::kMicrosecond);
BENCHMARK(refinement_step)->Arg(40000)->Unit(benchmark::kMicrosecond);
BENCHMARK(registration)->Arg(40000)->Unit(benchmark::kMillisecond);
BENCHMARK(refinement_on_meshes)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
