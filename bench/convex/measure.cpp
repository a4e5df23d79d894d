#include "convex/measure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <utility>

#include "convex/expert.h"
#include "dymsum/dymsum.h"  // ConvexSolid, where there is one
#include "spatial/convex/convex_sum.h"
#include "spatial/convex/mixed_volume.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/gauss/overlay.h"
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

void add(const MotionWork& work, MotionWork& total) {
  total.vertex_checks += work.vertex_checks;
  total.vertex_errors += work.vertex_errors;
  total.crossing_checks += work.crossing_checks;
  total.arc_checks += work.arc_checks;
  total.arcs_changed += work.arcs_changed;
  total.steps += work.steps;
  total.facets_added += work.facets_added;
  total.exact_signs += work.exact_signs;
}

/// The thesis's brute force: on triangles, coplanar ones and all.
class TriangleBrute {
 public:
  TriangleBrute(const Mesh& p, const Mesh& q)
      : p_(*spatial::make_polytope(p, false)), q_(*spatial::make_polytope(q, false)) {}
  void build(const SolidPose& pose) {
    overlay_.build_brute(spatial::RelativeMap(spatial::PoseFactors::of(pose), spatial::PoseFactors::of({})));
  }
  Rational volume(const SolidPose& pose) const {
    return exact::to_rational(spatial::exact_mixed_volume(overlay_, pose, {}));
  }

 private:
  spatial::Polytope p_, q_;
  spatial::Overlay overlay_{p_, q_};
};

/// The brute forces at one pose: the thesis's on triangles and on whole faces, the expert's.
class Brutes {
 public:
  Brutes(const solids::NamedMesh& p, const solids::NamedMesh& q, bool expert) : triangles_(p.mesh, q.mesh) {
    if (expert) expert_.emplace(p.mesh, q.mesh);
  }

  /// Adds their times; whether all agree. `merged` is rebuilt.
  bool run(MotionRow& row, const SolidPose& pose, const ConvexSum& moving, ConvexSum& merged) {
    row.brute_merged_us += repeated_us([&] { merged.rebuild(ConvexEngine::brute); });
    bool same = merged.same_combinatorics(moving);
    row.brute_us += repeated_us([&] { triangles_.build(pose); });
    same = same && triangles_.volume(pose) == moving.volume_exact();
    if (!expert_) return same;
    for (const auto& [signs, us] : {std::pair{ExpertBrute::Signs::by_pairs, &MotionRow::expert_pairs_us},
                                    {ExpertBrute::Signs::by_faces, &MotionRow::expert_faces_us}}) {
      row.*us += repeated_us([&, how = signs] { expert_->build(pose, how); });
      same = same && expert_->crossings() == moving.edge_edge_count() &&
             std::abs(expert_->volume() / moving.volume() - 1) < 1e-9;
    }
    return same;
  }

 private:
  TriangleBrute triangles_;
  std::optional<ExpertBrute> expert_;
};

/// The static walk up to the finished solid: facets and nearest positions in flat arrays, as ConvexSolid has them.
class StaticWalk {
 public:
  StaticWalk(const Mesh& p, const Mesh& q) : p_(*spatial::make_polytope(p)), q_(*spatial::make_polytope(q)) {
    operands_.operand[0].vertices = p.vertices();
    operands_.operand[1].vertices = q.vertices();
  }
  std::size_t solid(const SolidPose& pose) {
    overlay_.build(spatial::RelativeMap(spatial::PoseFactors::of(pose), spatial::PoseFactors::of({})));
    const spatial::ConvexFacets facets = spatial::assemble(overlay_);
    return spatial::nearest_positions(operands_, pose, {}, facets.vertices).size();
  }

 private:
  spatial::Polytope p_, q_;
  spatial::ConvexOperands operands_;
  spatial::Overlay overlay_{p_, q_};
};

SpatialSum sum_from_meshes(const Mesh& p, const Mesh& q, const SolidPose& pose) {
  ConvexSum sum = ConvexSum::create(p, q).value();
  sum.rebuild(pose, {});
  return sum.sum();
}

/// The finished solid by updating, in an order that stays where sums keep it; how many vertices it has.
template <class Sum>
std::size_t finish(Sum& moving) {
  if constexpr (requires { moving.solid(); }) return moving.solid().vertex_count;
  else return moving.sum().vertices.size();
}

/// Every move up to the finished solid, twice; the better time of each move counts.
void time_solids(MotionRow& row, const solids::NamedMesh& p, const solids::NamedMesh& q,
                 const std::vector<SolidPose>& poses, ConvexSum& moving) {
  const double clock_us = 1e3 * clock_ms();
  const auto all_moves = [&](auto&& make) {
    std::vector<double> best(row.moves, 1e300);
    for (int round = 0; round < 2; ++round) {
      make(poses[0]);
      for (std::size_t k = 1; k < poses.size(); ++k) {
        const double us = timed_us([&] { make(poses[k]); }) - clock_us;
        best[k - 1] = std::min(best[k - 1], std::max(us, 0.0));
      }
    }
    return spread(best);
  };
  row.update_solid_us = all_moves([&](const SolidPose& pose) {
    moving.set(pose);
    finish(moving);
  });
  StaticWalk walk(p.mesh, q.mesh);
  row.static_solid_us = all_moves([&](const SolidPose& pose) { walk.solid(pose); });
  row.fresh_solid_us = repeated_us([&] { sum_from_meshes(p.mesh, q.mesh, poses.back()); });
}

/// Whether the static walk gives the same solid.
bool same_solids(ConvexSum& moving, const ConvexSum& merged) {
  const SpatialSum answer = merged.sum();
  return moving.sum() == answer && finish(moving) == answer.vertices.size();
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
  ConvexSum merged = *ConvexSum::create(p.mesh, q.mesh);
  row.static_us = 1e300;
  for (int round = 0; round < 3; ++round) {
    const double us = timed_us([&] {
      for (std::size_t k = 1; k < poses.size(); ++k) merged.rebuild(poses[k], {});
    });
    row.static_us = std::min(row.static_us, us / static_cast<double>(row.moves));
  }

  if (protocol.solids) time_solids(row, p, q, poses, moving);

  // The same moves again, with the others' turns in between.
  moving.set(poses[0]);
  const auto every = [&](int count) {
    return count > 0 ? std::max<std::size_t>(1, row.moves / static_cast<std::size_t>(count)) : row.moves + 1;
  };
  std::optional<Brutes> brutes;
  if (protocol.brute_moves > 0) brutes.emplace(p, q, protocol.expert);
  std::size_t brute_runs = 0, hull_runs = 0;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    add(moving.set(poses[k]), row.work);
    if (k % 10 != 0 && k % every(protocol.brute_moves) != 0) continue;
    merged.rebuild(poses[k], {});
    ++row.compared;
    bool same = merged.same_combinatorics(moving) && (!protocol.solids || same_solids(moving, merged));
    if (k % every(protocol.brute_moves) == 0) {
      ++brute_runs;
      same = brutes->run(row, poses[k], moving, merged) && same;
    }
    if (k % every(protocol.hull_moves) == 0) {
      ++hull_runs;
      const HullAnswer hull = cgal_hull_of_sums(posed(p.mesh, poses[k]), posed(q.mesh, {}));
      row.hull_us += 1e3 * hull.ms;
      same = same && std::abs(hull.volume / moving.volume() - 1) < 1e-9;
    }
    row.different += !same;
  }
  row.facets = moving.facet_count().all;
  if (brute_runs > 0)
    for (double MotionRow::*us :
         {&MotionRow::brute_us, &MotionRow::brute_merged_us, &MotionRow::expert_pairs_us, &MotionRow::expert_faces_us})
      row.*us /= static_cast<double>(brute_runs);
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

MotionRow measure_shared_axis(const solids::NamedMesh& p, const solids::NamedMesh& q, int steps,
                              const MotionProtocol& protocol) {
  const double angle = 2 * std::acos(-1.0) / steps;
  std::vector<SolidPose> poses(1);
  for (int k = 1; k <= protocol.moves; ++k) poses.push_back({*Rotation::about({0, 0, 1}, k * angle), {}});
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
  SpatialSum sum;
  row.ours_ms = 1e-3 * repeated_us([&] { sum = sum_from_meshes(p.mesh, q.mesh, {turn, {}}); });
  const NefAnswer nef = cgal_nef_sum(posed(p.mesh, {turn, {}}), posed(q.mesh, {}));
  row.nef_ms = nef.ms;
  row.vertices = sum.vertices.size();
  row.nef_vertices = nef.vertices;
  row.same = row.vertices == row.nef_vertices && std::abs(nef.volume / sum.volume() - 1) < 1e-9;
  return row;
}

}  // namespace dymsum::bench
