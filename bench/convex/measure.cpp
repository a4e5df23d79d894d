#include "convex/measure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "versus/rival.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

double timed_us(const std::function<void()>& work) {
  const double start = cpu_ms();
  work();
  return 1e3 * (cpu_ms() - start);
}

/// Repeats short work until the clock can see it.
double repeated_us(const std::function<void()>& work) {
  double total = 0;
  int runs = 0;
  do {
    total += timed_us(work);
    ++runs;
  } while (total < 2000 && runs < 1000);
  return total / runs;
}

std::vector<Point3> posed(const Mesh& mesh, const SolidPose& pose) {
  const auto m = pose.rotation.matrix();
  const auto n = static_cast<double>(pose.rotation.norm());
  std::vector<Point3> out;
  for (const Point3& v : mesh.vertices()) {
    const double x = v.x * pose.scale[0].approx(), y = v.y * pose.scale[1].approx(), z = v.z * pose.scale[2].approx();
    const auto row = [&](int k) { return (double(m[k]) * x + double(m[k + 1]) * y + double(m[k + 2]) * z) / n; };
    out.push_back({row(0), row(3), row(6)});
  }
  return out;
}

MotionRow measure(const solids::NamedMesh& p, const solids::NamedMesh& q, const std::vector<SolidPose>& poses,
                  const MotionProtocol& protocol) {
  MotionRow row;
  row.p = p.name;
  row.q = q.name;
  row.p_triangles = p.mesh.triangle_count();
  row.q_triangles = q.mesh.triangle_count();
  row.moves = poses.size() - 1;

  // The moves by themselves, first to last; three times, the least mean counts for every system alike.
  ConvexSum moving = *ConvexSum::create(p.mesh, q.mesh);
  row.update_us = 1e300;
  for (int round = 0; round < 3; ++round) {
    moving.set(poses[0]);
    const double us = timed_us([&] {
      for (std::size_t k = 1; k < poses.size(); ++k) moving.set(poses[k]);
    });
    row.update_us = std::min(row.update_us, us / static_cast<double>(row.moves));
  }

  // The static walk at the same poses in the same order, the same way: at one pose again and again it would be a fifth
  // faster.
  ConvexSum merged = *ConvexSum::create(p.mesh, q.mesh),
            triangles = *ConvexSum::create(p.mesh, q.mesh, FlatFeatures::kept);
  row.static_us = 1e300;
  for (int round = 0; round < 3; ++round) {
    const double us = timed_us([&] {
      for (std::size_t k = 1; k < poses.size(); ++k) merged.rebuild(poses[k], {});
    });
    row.static_us = std::min(row.static_us, us / static_cast<double>(row.moves));
  }

  // The same moves again, with the others' turns in between.
  moving.set(poses[0]);
  const auto every = [&](int count) {
    return count > 0 ? std::max<std::size_t>(1, row.moves / static_cast<std::size_t>(count)) : row.moves + 1;
  };
  std::size_t brute_runs = 0, hull_runs = 0;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const MotionWork work = moving.set(poses[k]);
    row.work.vertex_checks += work.vertex_checks;
    row.work.vertex_errors += work.vertex_errors;
    row.work.crossing_checks += work.crossing_checks;
    row.work.arc_checks += work.arc_checks;
    row.work.arcs_changed += work.arcs_changed;
    row.work.steps += work.steps;
    row.work.facets_added += work.facets_added;
    row.work.exact_signs += work.exact_signs;
    row.facets = moving.face_vertex_count() + moving.edge_edge_count();
    if (k % 10 != 0 && k % every(protocol.brute_moves) != 0) continue;
    merged.rebuild(poses[k], {});
    ++row.compared;
    bool same = merged.same_combinatorics(moving);
    if (k % every(protocol.brute_moves) == 0) {
      ++brute_runs;
      row.brute_merged_us += repeated_us([&] { merged.rebuild(ConvexEngine::brute); });
      same = same && merged.same_combinatorics(moving);
      triangles.set(poses[k]);
      row.brute_us += repeated_us([&] { triangles.rebuild(ConvexEngine::brute); });
      same = same && triangles.volume_exact() == moving.volume_exact();
    }
    if (k % every(protocol.hull_moves) == 0) {
      ++hull_runs;
      const HullAnswer hull = cgal_hull_of_sums(posed(p.mesh, poses[k]), posed(q.mesh, {}));
      row.hull_us += 1e3 * hull.ms;
      same = same && std::abs(hull.volume / moving.volume() - 1) < 1e-9;
    }
    row.different += !same;
  }
  if (brute_runs > 0) row.brute_us /= static_cast<double>(brute_runs);
  if (brute_runs > 0) row.brute_merged_us /= static_cast<double>(brute_runs);
  if (hull_runs > 0) row.hull_us /= static_cast<double>(hull_runs);
  return row;
}

Point3 random_axis(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

}  // namespace

MotionRow measure_rotation(const solids::NamedMesh& p, const solids::NamedMesh& q, int steps,
                           const MotionProtocol& protocol) {
  std::mt19937_64 random(protocol.seed);
  const double angle = 2 * std::acos(-1.0) / steps;
  std::vector<SolidPose> poses{{*Rotation::about(random_axis(random), 1), {}}};
  Rotation turn;
  for (int k = 0, left = 0; k < protocol.moves; ++k, --left) {
    if (left == 0) {
      left = 1 + static_cast<int>(random() % 20);
      turn = *Rotation::about(random_axis(random), angle);
    }
    poses.push_back({turn * poses.back().rotation, {}});
  }
  return measure(p, q, poses, protocol);
}

MotionRow measure_scaling(const solids::NamedMesh& p, const solids::NamedMesh& q, const MotionProtocol& protocol) {
  std::mt19937_64 random(protocol.seed);
  std::uniform_real_distribution<double> factor(-1, 1);
  // Three decimals: what a person would type.
  const auto scale = [&] {
    return *Scale::of(*Rational::of(static_cast<int>(1000 * std::exp2(factor(random))), 1000));
  };
  std::vector<SolidPose> poses(1);
  for (int k = 0; k < protocol.moves; ++k) poses.push_back({Rotation(), {scale(), scale(), scale()}});
  return measure(p, q, poses, protocol);
}

NefRow measure_nef(const solids::NamedMesh& p, const solids::NamedMesh& q, const Rotation& turn) {
  NefRow row;
  row.p = p.name;
  row.q = q.name;
  SolidSum sum;
  row.ours_ms = 1e-3 * repeated_us([&] { sum = *convex_sum(p.mesh, q.mesh, {turn, {}}); });
  const NefAnswer nef = cgal_nef_sum(posed(p.mesh, {turn, {}}), posed(q.mesh, {}));
  row.nef_ms = nef.ms;
  row.vertices = sum.vertices.size();
  row.nef_vertices = nef.vertices;
  row.same = row.vertices == row.nef_vertices && std::abs(nef.volume / sum.volume() - 1) < 1e-9;
  return row;
}

std::vector<DepthRow> measure_depth(const solids::NamedMesh& p, const solids::NamedMesh& q, int queries) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  ConvexSum difference = *ConvexSum::create(p.mesh, negated(q.mesh));
  const DepthPair pair(p.mesh, q.mesh);
  const std::array<double, 6> box = bounds(p.mesh);
  const double size = box[3] - box[0];
  std::vector<DepthRow> rows;
  rows.push_back({std::string(p.name), std::string(q.name), "dymsum, moving", 0, 0, 0, 0});
  for (const DepthRival rival : {DepthRival::fcl, DepthRival::ccd_gjk_epa, DepthRival::ccd_mpr})
    rows.push_back({std::string(p.name), std::string(q.name), name(rival), 0, 0, 0, 0});
  Rotation turn;
  const Rotation step = *Rotation::about({1, 2, 3}, 0.0126);
  for (int k = 0; k < queries; ++k) {
    turn = step * turn;
    const Point3 at{size * offset(random), size * offset(random), size * offset(random)};
    double m[9];
    for (int i = 0; i < 9; ++i) m[i] = static_cast<double>(turn.matrix()[i]) / static_cast<double>(turn.norm());
    ConvexDepth truth;
    rows[0].us += timed_us([&] {
      difference.set(turn);
      truth = difference.depth(at);
    });
    ++rows[0].queries;
    for (int r = 0; r < 3; ++r) {
      double depth = 0;
      rows[r + 1].us += timed_us([&] { depth = pair.depth(static_cast<DepthRival>(r), m, at); });
      ++rows[r + 1].queries;
      const double error = std::abs(depth - truth.depth) / size;
      rows[r + 1].wrong += error > 1e-6;
      rows[r + 1].worst = std::max(rows[r + 1].worst, error);
    }
  }
  for (DepthRow& row : rows) row.us /= static_cast<double>(row.queries);
  return rows;
}

}  // namespace dymsum::bench
