// The complex of growing discs against CGAL's segment Delaunay graph: every disc of one is a disc of the other, with
// centre and radius exactly ours inside of CGAL's intervals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cgal/delaunay_discs.h"
#include "dymsum/shapes.h"
#include "exact/orient.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "shape/complex/complex.h"

namespace dymsum {
namespace {

using exact::RootExpression;
using shape::Complex;
using shape::Node;

bool lies_in(const RootExpression& v, const std::array<double, 2>& range) {
  return exact::compare(v, RootExpression(range[0])) >= 0 && exact::compare(v, RootExpression(range[1])) <= 0;
}

/// Doubles first, with room for their rounding: most pairs are not alike.
bool may_be(const Node& node, const sdg::Disc& disc) {
  const double size = 1e-6 * (1 + std::abs(node.centre.x) + std::abs(node.centre.y) + node.radius);
  const auto near = [&](double v, double low, double high) { return v > low - size && v < high + size; };
  return near(node.centre.x, disc.x[0], disc.x[1]) && near(node.centre.y, disc.y[0], disc.y[1]) &&
         near(node.radius, std::sqrt(disc.radius2[0]), std::sqrt(disc.radius2[1]));
}

bool is_disc(const Complex& c, std::uint32_t n, const sdg::Disc& disc) {
  if (!may_be(c.nodes[n], disc)) return false;
  const shape::ExactDisc exact = exact_disc(c, n);
  return lies_in(exact.centre.x, disc.x) && lies_in(exact.centre.y, disc.y) &&
         lies_in(exact.radius * exact.radius, disc.radius2);
}

/// Vertices in the middle of straight runs are sites of CGAL's, and none of ours.
RegionData without_flat_vertices(RegionData data) {
  const auto strip = [](Ring& ring) {
    Ring kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point before = ring[(i + ring.size() - 1) % ring.size()], after = ring[(i + 1) % ring.size()];
      if (exact::orient_sign(before, ring[i], after) != 0) kept.push_back(ring[i]);
    }
    ring = kept;
  };
  for (Part& part : data.parts) {
    strip(part.outer);
    for (Ring& hole : part.holes) strip(hole);
  }
  return data;
}

/// How many discs there are.
std::size_t expect_same_discs(const RegionData& given, const std::string& name) {
  SCOPED_TRACE(name);
  const RegionData data = without_flat_vertices(given);
  const Region region = Region::create(data).value();
  const std::vector<sdg::Disc> discs = sdg::discs_of(data);
  std::vector<bool> seen(discs.size(), false);
  for (const shape::Side side : {shape::Side::outside, shape::Side::inside}) {
    const Complex c = make_complex(region, side).value();
    for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
      if (c.nodes[n].kind == Node::Kind::corner) continue;
      bool found = false;
      for (std::size_t i = 0; i < discs.size(); ++i) {
        if (!is_disc(c, n, discs[i])) continue;
        found = seen[i] = true;
      }
      const bool three = c.nodes[n].kind == Node::Kind::joint || c.nodes[n].kind == Node::Kind::pass;
      EXPECT_TRUE(found || !three) << "CGAL has no disc of radius " << c.nodes[n].radius << " at "
                                   << c.nodes[n].centre.x << " " << c.nodes[n].centre.y;
    }
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const bool is_a_vertex = discs[i].radius2[1] == 0;
    EXPECT_TRUE(seen[i] || is_a_vertex) << "only CGAL has a disc of squared radius " << discs[i].radius2[1] << " at "
                                        << discs[i].x[0] << " " << discs[i].y[0];
  }
  return discs.size();
}

TEST(SegmentDelaunay, CombsStarsAndGridsOfHoles) {
  std::size_t discs = expect_same_discs(shapes::comb(5, 2, 1, 3).data(), "comb");
  discs += expect_same_discs(snapped_shapes::star(5, 1, 3).data(), "star");
  discs += expect_same_discs(shapes::grate(4, 2, 1, 3).data(), "grid of holes");
  discs += expect_same_discs(shapes::noisy_star(24, 0.3, 1).data(), "noisy star");
  discs += expect_same_discs(shapes::random_polygon(16, 1, 3).data(), "random polygon");
  EXPECT_GT(discs, 200U);
}

TEST(SegmentDelaunay, RandomRegions) {
  const std::uint64_t first = oracles::setting("DYMSUM_FIRST_SEED", 0);
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", 200) / 10;
  std::size_t discs = 0;
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
    oracles::Random random(3000 + seed);
    const RegionData data = oracles::random_parts(random, 6);
    if (Region::create(data).value().touching_points().empty())
      discs += expect_same_discs(data, "DYMSUM_FIRST_SEED=" + std::to_string(seed));
  }
  EXPECT_GT(discs, 5 * count);
}

}  // namespace
}  // namespace dymsum
