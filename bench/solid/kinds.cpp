#include "solid/kinds.h"

#include <cmath>

#include "dymsum/spatial_sum.h"
#include "off_grid.h"
#include "solid/measure.h"

namespace dymsum::bench {
namespace {

SpatialSum sum_of(const Mesh& p, const Mesh& q, SpatialEngine engine, int threads) {
  SpatialOptions options;
  options.engine = engine, options.threads = threads;
  return minkowski_sum(p, q, options).value();
}

/// Small sums are made by the reference, too.
OffGridCase sum_case(const SolidPair& pair, bool by_brute) {
  return off_grid_case(
      pair.name, Mesh::create(pair.p).value(), Mesh::create(pair.q).value(), [=](const Mesh& p, const Mesh& q) {
        OffGridWork work;
        work.run = [=] { return sum_of(p, q, SpatialEngine::fast, 1).faces.size(); };
        work.compare = [=] {
          constexpr double kLimitSeconds = 20;
          const SpatialSum sum = sum_of(p, q, SpatialEngine::fast, 1);
          Compared compared;
          compared.wrong = !(sum == sum_of(p, q, SpatialEngine::fast, 2)) ||
                           (by_brute && !(sum == sum_of(p, q, SpatialEngine::brute, 1)));
          compared.verdict = compared.wrong ? "DIFFERENT" : by_brute ? "equal" : "equal (threads)";
          const RivalAnswer manifold = query_manifold({pair.name, "", p.data(), q.data()}, true, kLimitSeconds);
          if (!manifold.finished) return compared;
          compared.rival_ms = manifold.median_ms;
          const double volume = sum.volume();
          if (std::abs(manifold.area - volume) > 1e-6 * volume) compared.verdict += ", Manifold's volume differs";
          return compared;
        };
        return work;
      });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const std::vector<SolidPair> pairs = solid_pairs("");
  std::vector<OffGridCase> cases;
  for (const char* name : {"torus 96 + ball 48", "L + cube", "block + peg that fits"})
    cases.push_back(sum_case(pair_named(pairs, name), true));
  for (const char* name : {"torus 256 + torus 256", "torus 1024 + ball 224", "L + L", "gear 12 + gear 9"})
    cases.push_back(sum_case(pair_named(pairs, name), false));
  return off_grid_table(
      {"solid",
       "The sum of two solids with all tight features, on one thread. Grates and combs, whose bars fit into each other "
       "exactly, are left out: two grates of two bars need 180,248 exact signs on the grid, 1,788,320 with noise and "
       "2,522,740 turned.",
       "face", "Manifold",
       "Manifold: through Python, where `./run bench solid` finds it. Compared: with two threads, small sums with the "
       "reference, which tests every cell, volumes with Manifold's to 1e-6."},
      cases, folder);
}

}  // namespace dymsum::bench
