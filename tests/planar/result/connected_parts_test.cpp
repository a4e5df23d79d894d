// Parts of inner fits that touch one another: against the Boolean engine, which finds parts by its own sweep.
#include <gtest/gtest.h>

#include <cstdio>

#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kPartSeed = 20261130;

SumOptions regular_parts() {
  SumOptions options;
  options.semantics = Semantics::regular;
  return options;
}

std::size_t rings_of_parts(const PlanarSum& sum) { return sum.parts.size() + sum.hole_count(); }

/// The same parts as the Boolean engine finds for them.
bool as_united(const PlanarSum& fit) {
  PlanarSum parts = fit;
  parts.segments.clear();
  parts.points.clear();
  parts.tight_segments.clear();
  parts.tight_points.clear();
  const PlanarSum united_parts = united(parts, parts, regular_parts()).value();
  return united_parts.parts.size() == fit.parts.size() && united_parts == parts;
}

/// Cells of a lattice chosen at random, those that share a corner joined or not.
Region random_cells(Random& random, int width, int height) {
  std::vector<bool> cells;
  for (int k = 0; k < width * height; ++k) cells.push_back(random.below(3) != 0);
  cells[0] = true;
  return Region::create(cells_region(cells, width, height, random.below(2) == 0)).value();
}

TEST(ConnectedParts, four_squares_in_a_ring_are_four_parts_and_no_hole) {
  // Squares of side 2 about (0, 2), (2, 0), (0, -2), (-2, 0) touch at four corners; the frame grows them by 1.
  const Region ring = Region::create({{{{{-1, 1}, {1, 1}, {1, 3}, {-1, 3}}, {}},
                                       {{{1, -1}, {3, -1}, {3, 1}, {1, 1}}, {}},
                                       {{{-1, -3}, {1, -3}, {1, -1}, {-1, -1}}, {}},
                                       {{{-3, -1}, {-1, -1}, {-1, 1}, {-3, 1}}, {}}},
                                      {},
                                      {}})
                          .value();
  const Region point = Region::create({{}, {}, {Point{0, 0}}}).value();
  const PlanarSum fit = erode(ring, point).value();
  EXPECT_EQ(fit.parts.size(), 4u);
  EXPECT_EQ(fit.hole_count(), 0u);
  EXPECT_EQ(fit, minkowski_sum(ring, point).value());
  EXPECT_EQ(rotated_erode(ring, point, Orientation::parse("3/4").value()).value().parts.size(), 4u);
}

TEST(ConnectedParts, of_cells_are_those_of_a_union) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kPartSeed));
  const Region point = Region::create({{}, {}, {Point{0, 0}}}).value();
  std::size_t touching = 0, several = 0;
  for (int k = 0; k < 300; ++k) {
    Random random(kPartSeed + static_cast<std::uint64_t>(k));
    const Region cells = random_cells(random, 4 + k % 3, 4), box = shapes::rectangle(0, 0, 0.5, 0.5);
    SCOPED_TRACE("cells " + std::to_string(k) + "\n" + to_wkt(cells.data()));
    const PlanarSum itself = minkowski_sum(cells, point, regular_parts()).value();
    const PlanarSum fit = erode(cells, point, regular_parts()).value();
    EXPECT_EQ(fit, itself);
    for (const PlanarSum& part :
         {fit, erode(cells, box).value(), erode(minkowski_sum(cells, box).value(), box).value()})
      EXPECT_TRUE(as_united(part));
    touching += fit.vertex_count();
    several += rings_of_parts(fit) > 2;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(touching, 3000u);
  EXPECT_GT(several, 100u);
}

TEST(ConnectedParts, name_contacts_that_pass_through_their_positions) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kPartSeed));
  std::size_t compared = 0;
  for (int k = 0; k < 200; ++k) {
    Random random(kPartSeed + 1000 + static_cast<std::uint64_t>(k));
    const Region p = Region::create(mapped(random_parts(random, 6), 2, 1, 0, 1)).value(),
                 q = Region::create(RegionData{{{random_polygon(random, 2, 4), {}}}, {}, {}}).value();
    const PlanarSum fit = erode(p, q).value();
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p.data()) + "\n" + to_wkt(q.data()));
    EXPECT_TRUE(as_united(fit));
    for (const SumPart& part : fit.parts)
      for (const SumVertex& v : part.outer.vertices) {
        const RationalPoint at = fit.exact(v);
        EXPECT_LE(std::abs(at.x.to_double() - v.at.x), fit.at_error + 1e-15);
        EXPECT_LE(std::abs(at.y.to_double() - v.at.y), fit.at_error + 1e-15);
        ++compared;
      }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(compared, 300u);
}

TEST(ConnectedParts, of_turned_decimal_and_noisy_cells_are_those_of_a_union) {
  std::size_t parts = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int k = 0; k < 10; ++k) {
      Random random(kPartSeed + 2000 + static_cast<std::uint64_t>(k));
      std::mt19937_64 noise(kPartSeed);
      const Region cells = random_cells(random, 5, 5);
      const Result<Region> p = Region::create(of_kind(cells.data(), kind, noise));
      if (!p) continue;  // rounding has spoilt cells that touched
      const PlanarSum fit = erode(*p, shapes::rectangle(0, 0, 0.25, 0.25)).value();
      EXPECT_TRUE(as_united(fit));
      parts += fit.parts.size();
    }
  EXPECT_GT(parts, 20u);
}

}  // namespace
}  // namespace dymsum::oracles
