// The order of edges by direction: exact, and by position in the walk where directions are equal.
#include "oracles/snapped_shapes.h"
#include "planar/operand/edges.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "dymsum/shapes.h"
#include "planar/operand/operand.h"
#include "planar/region/region.h"

namespace dymsum::planar {
namespace {

void expect_in_order(const RegionData& data, const std::string& what) {
  const std::shared_ptr<Operand> o = make_operand(separate_touching(data, {}), 0);
  const std::shared_ptr<const Lattice> lattice = make_lattice(o->points, place_points({}), 512);
  for (const std::array<std::uint32_t, 2>& lists : o->component_directions)
    for (const std::uint32_t l : lists) {
      const DirectionList& list = o->directions[l];
      for (std::size_t k = 0; k < list.edges.size(); ++k) {
        const std::uint32_t e = list.edges[k];
        ASSERT_EQ(list.rank[e - list.base], k) << what;
        ASSERT_EQ(list.edges[list.next[k]], o->next[e]) << what;
        if (k == 0) continue;
        const int order = compare_directions(*lattice, o->edge(list.edges[k - 1]), o->edge(e));
        ASSERT_TRUE(order < 0 || (order == 0 && list.edges[k - 1] < e)) << what << ", position " << k;
      }
    }
}

TEST(Directions, ShapesOfEverySize) {
  for (int n = 5; n <= 150; ++n) expect_in_order(shapes::noisy_star(n, 0.5, n).data(), "star " + std::to_string(n));
  for (int n = 2; n <= 60; ++n) expect_in_order(shapes::grate(n, 1, 0.25, 20).data(), "grate " + std::to_string(n));
  for (int n = 1; n <= 30; ++n) expect_in_order(snapped_shapes::pockets(n, 10).data(), "pockets " + std::to_string(n));
}

// Polylines go there and back; their directions differ by less than doubles distinguish, or not at all.
TEST(Directions, ClustersThatKeysDoNotTell) {
  std::mt19937_64 random(7);
  for (const double size : {0x1p20, 0x1p50, 0x1p60, 0x1p300, 0x1p-500})
    for (int n = 2; n <= 120; n += 1 + n / 8) {
      const auto little = [&] { return static_cast<double>(random() % 3) * size * 0x1p-52; };
      Polyline line;
      for (int k = 0; k <= n; ++k) line.push_back(k % 2 == 0 ? Point{0, little()} : Point{size, size + little()});
      RegionData data;
      data.polylines = {line};
      expect_in_order(data, std::to_string(n) + " edges of " + std::to_string(size));
    }
}

// Sums of many threads make them beside one operand, whose memory is not theirs.
TEST(Directions, ListsWithoutSomeHolesHaveMemoryOfTheirOwn) {
  const std::shared_ptr<Operand> o = make_operand(separate_touching(snapped_shapes::pockets(5, 10).data(), {}), 0);
  ASSERT_EQ(o->components.size(), 1u);
  ASSERT_GT(o->loops.size(), 2u);
  std::vector<std::uint8_t> keep(o->loops.size(), 1);
  keep[1] = 0;
  const DirectionList list = sublist(o->directions[0], *o, o->components[0], keep);
  EXPECT_EQ(list.edges.size(), o->directions[0].edges.size() - (o->loops[1].last - o->loops[1].first));
  EXPECT_FALSE(list.edges.get_allocator() == o->directions[0].edges.get_allocator());
}

}  // namespace
}  // namespace dymsum::planar
