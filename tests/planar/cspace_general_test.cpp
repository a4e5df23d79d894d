// The obstacle of any two regions: every slab against static slices, on tiny integer grids where events coincide in hundreds, and the same obstacle by whole slices.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

using Random = std::mt19937_64;
using Cycle = std::vector<Contact>;

bool less(const Contact& a, const Contact& b) { return std::tuple{a.kind, a.p, a.q} < std::tuple{b.kind, b.p, b.q}; }

std::vector<Cycle> canonical(std::vector<Cycle> cycles) {
  for (Cycle& cycle : cycles) {
    // A segment may be on a cycle twice: the smallest of all rotations.
    Cycle best = cycle, turned = cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      if (std::lexicographical_compare(turned.begin(), turned.end(), best.begin(), best.end(), less)) best = turned;
    }
    cycle = best;
  }
  std::sort(cycles.begin(), cycles.end(), [](const Cycle& a, const Cycle& b) { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less); });
  return cycles;
}

std::vector<Cycle> of_slice(const PlanarSum& sum) {
  std::vector<Cycle> cycles;
  const auto add = [&](const SumRing& ring) {
    Cycle& cycle = cycles.emplace_back();
    for (const SumVertex& v : ring.vertices) cycle.push_back(v.out);
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return canonical(std::move(cycles));
}

std::vector<Cycle> of_slab(const CspaceObstacle& c, std::uint32_t slab) {
  std::vector<Cycle> cycles;
  for (const auto& loop : c.loops(slab)) {
    Cycle& cycle = cycles.emplace_back();
    for (const std::uint32_t p : loop) cycle.push_back(c.patches()[p].contact);
  }
  return canonical(std::move(cycles));
}

std::uint32_t slabs(const CspaceObstacle& c) { return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(c.angles().size())); }

void expect_slices(const CspaceObstacle& c, Random& random, std::uint32_t most) {
  const std::uint32_t n = slabs(c);
  const std::uint32_t step = std::max(1u, n / most);
  for (std::uint32_t slab = static_cast<std::uint32_t>(random() % step); slab < n; slab += step) {
    const Orientation at = c.inside(slab);
    const std::vector<Cycle> expected = of_slice(*c.slice(at));
    ASSERT_EQ(of_slab(c, slab), expected) << "slab " << slab << " of " << n << " at " << at.radians();
  }
}

Region random_shape(Random& random, int reach, int most, bool hole) {
  const auto at = [&] { return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach); };
  for (;;) {
    RegionData data;
    data.parts.emplace_back();
    const int n = 3 + static_cast<int>(random() % static_cast<unsigned>(most - 2));
    for (int i = 0; i < n; ++i) data.parts[0].outer.push_back({at(), at()});
    if (hole) data.parts[0].holes.push_back({{at(), at()}, {at(), at()}, {at(), at()}});
    Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.empty() && repaired->region.touching_points().empty() && repaired->region.parts().size() == 1) return repaired->region;
  }
}

TEST(CspaceGeneral, random_pairs_equal_slices) {
  const char* first = std::getenv("DYMSUM_SEED");
  const char* count = std::getenv("DYMSUM_FUZZ_OBSTACLES");
  const std::uint64_t begin = first ? std::stoull(first) : 1;
  for (std::uint64_t seed = begin; seed < begin + (count ? std::stoull(count) : 60); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const bool hole = random() % 3 == 0;
    const int reach = random() % 2 == 0 ? 5 : 1000;
    const Region robot = random_shape(random, reach, 6, false), obstacle = random_shape(random, hole ? 2 * reach : reach, 7, hole);
    Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 400);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace dymsum
