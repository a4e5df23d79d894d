#include "convex/kinds.h"

#include <cmath>
#include <memory>

#include "convex/motion_tables.h"
#include "dymsum/convex_solid.h"
#include "off_grid.h"
#include "versus/rival.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

/// A sum from two meshes.
OffGridCase sum_case(const std::string& name, const Mesh& p, const Mesh& q) {
  return off_grid_case(
      name, p, q,
      [](const Mesh& a, const Mesh& b) {
        OffGridWork work;
        work.run = [=] { return minkowski_sum(a, b).value().faces.size(); };
        work.compare = [=] {
          const HullAnswer hull = cgal_hull_of_sums(a.vertices(), b.vertices());
          const bool wrong = std::abs(hull.volume / minkowski_sum(a, b).value().volume() - 1) > 1e-9;
          return Compared{wrong ? "DIFFERENT" : "equal volumes", wrong, hull.ms};
        };
        return work;
      },
      hull_with_coordinates);
}

/// 50 moves of 1/500 turn there and back, each up to the finished solid.
OffGridCase motion_case(const std::string& name, const Mesh& p, const Mesh& q) {
  return off_grid_case(
      "turns, " + name, p, q,
      [](const Mesh& a, const Mesh& b) {
        constexpr int kMoves = 50;
        const auto moving = std::make_shared<ConvexSum>(*ConvexSum::create(a, b));
        std::vector<SolidPose> poses;
        for (int k = 0; k <= kMoves; ++k)
          poses.push_back({*Rotation::about({1, 2, 3}, 1 + 2 * std::acos(-1.0) * k / 500), {}});
        OffGridWork work;
        work.run = [=] {
          std::size_t facets = 0;
          for (int k = 1; k <= 2 * kMoves; ++k) {
            moving->set(poses[static_cast<std::size_t>(k <= kMoves ? k : 2 * kMoves - k)]);
            facets += moving->solid().facet_count;
          }
          return facets;
        };
        work.compare = [=] {
          ConvexSum fresh = *ConvexSum::create(a, b);
          std::size_t different = 0;
          double ms = 0;
          for (int k = 1; k <= kMoves; ++k) {
            const SolidPose& pose = poses[static_cast<std::size_t>(k)];
            const double start = cpu_ms();
            fresh.rebuild(pose, {});
            const SpatialSum answer = fresh.sum();
            ms += 2 * (cpu_ms() - start);
            moving->set(pose);
            different += !(moving->sum() == answer);
          }
          return Compared{different > 0 ? std::to_string(different) + " DIFFERENT" : "equal", different > 0, ms};
        };
        return work;
      },
      hull_with_coordinates);
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const Models models = solids::thesis_models();
  std::vector<OffGridCase> cases;
  for (const auto& [p, q] : {std::pair{"cube", "T"}, {"cylinder", "cone"}, {"GS3", "v-rod"}, {"ellipse", "GS3"}}) {
    const std::string name = std::string(p) + " + " + q;
    cases.push_back(sum_case(name, model(models, p).mesh, model(models, q).mesh));
    cases.push_back(motion_case(name, model(models, p).mesh, model(models, q).mesh));
  }
  return off_grid_table(
      {"convex", "Sums of convex solids from two meshes; and 100 moves by 1/500 turn, each up to the finished solid.",
       "facet", "opponent",
       "The opponent of a sum: CGAL's hull of all sums of two vertices, compared by volume to 1e-9; of moves: our "
       "static walk at the same poses, compared exactly."},
      cases, folder);
}

}  // namespace dymsum::bench
