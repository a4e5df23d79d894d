// Operands whose vertices move, and their convolution, step by step against those made anew.
#include "planar/edit/followed_convolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/edit/edited_same.h"
#include "planar/edit/moved_operand.h"
#include "planar/operand/make_lattice.h"

namespace dymsum::planar {
namespace {

std::shared_ptr<const Operand> made_anew(const Region& region, std::uint32_t op) {
  return make_operand(separate_touching(region.data(), region.touching_points()), op);
}

void expect_same(const Operand& a, const Operand& b) {
  EXPECT_EQ(a.points->offset, b.points->offset);
  EXPECT_EQ(a.points->x, b.points->x);
  EXPECT_EQ(a.points->y, b.points->y);
  EXPECT_EQ(a.points->width, b.points->width);
  EXPECT_EQ(a.points->height, b.points->height);
  EXPECT_EQ(a.points->exponent, b.points->exponent);
  EXPECT_EQ(a.points->top, b.points->top);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.next, b.next);
  EXPECT_EQ(a.convex, b.convex);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.ey, b.ey);
  for (std::size_t e = 0; e < a.size(); ++e) {
    EXPECT_EQ(a.boxes[e].bx, b.boxes[e].bx);
    EXPECT_EQ(a.boxes[e].dy, b.boxes[e].dy);
  }
  for (std::size_t l = 0; l < a.loops.size(); ++l) {
    EXPECT_EQ(a.loops[l].min_x, b.loops[l].min_x);
    EXPECT_EQ(a.loops[l].max_y, b.loops[l].max_y);
  }
  for (std::size_t c = 0; c < a.components.size(); ++c) {
    EXPECT_EQ(a.components[c].convex, b.components[c].convex);
    EXPECT_EQ(a.components[c].widest_hole, b.components[c].widest_hole);
  }
  for (std::size_t k = 0; k < a.directions.size(); ++k) {
    EXPECT_EQ(a.directions[k].edges, b.directions[k].edges);
    EXPECT_EQ(a.directions[k].rank, b.directions[k].rank);
    EXPECT_EQ(a.directions[k].next, b.directions[k].next);
  }
}

void expect_same(const FollowedConvolution& a, const FollowedConvolution& b, const Operand& p, const Operand& q) {
  EXPECT_EQ(a.size(), b.size());
  const std::array<const Operand*, 2> operands{&p, &q};
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < operands[side]->size(); ++e)
      for (std::uint32_t v = 0; v < operands[1 - side]->size(); ++v)
        ASSERT_EQ(a.find(side, e, v) != kNoRank, b.find(side, e, v) != kNoRank) << side << " " << e << " " << v;
  // The order of the segments is that of their ids.
  std::vector<std::uint64_t> in_a, in_b;
  a.for_each([&](const WalkSegment& s) { in_a.push_back(a.order(s.side, s.edge, s.vertex)); });
  b.for_each([&](const WalkSegment& s) { in_b.push_back(b.order(s.side, s.edge, s.vertex)); });
  EXPECT_EQ(in_a, in_b);
  EXPECT_TRUE(std::is_sorted(in_a.begin(), in_a.end()));
}

struct Moving {
  Region region;
  std::shared_ptr<const Operand> operand;
  OperandSteps steps;
};

// Moves a few vertices of a region; nothing where that is no region.
std::optional<Region> moved_region(oracles::Random& random, const Region& region, const edit_tests::Reach& reach,
                                   std::vector<std::uint32_t>& moved) {
  RegionData data = region.data();
  const int percent = random.chance(20) ? 30 : 3;
  std::uint32_t v = 0;
  for_each_chain(data, [&](std::vector<Point>& chain) {
    for (Point& p : chain) {
      if (random.chance(percent)) {
        p = edit_tests::near(random, reach, p);
        moved.push_back(v);
      }
      ++v;
    }
  });
  Result<Region> made = Region::create(std::move(data));
  if (!made || !made->touching_points().empty()) return std::nullopt;
  return *std::move(made);
}

struct Count {
  int followed = 0, anew = 0, elsewhere = 0, copied = 0;
};

void move_and_compare(oracles::Random& random, const Region& p, const Region& q, const edit_tests::Reach& reach,
                      Count& count) {
  std::array<Moving, 2> of{Moving{p, made_anew(p, 0), {}}, Moving{q, made_anew(q, 1), {}}};
  auto lattice = make_lattice(of[0].operand->points, of[1].operand->points, 0);
  auto convolution = std::make_unique<FollowedConvolution>(*lattice, *of[0].operand, *of[1].operand);
  std::vector<std::shared_ptr<const Operand>> referred;  // by results
  for (int step = 0; step < 30; ++step) {
    const std::uint32_t op = random.chance(50) ? 0 : 1;
    std::vector<std::uint32_t> moved;
    const std::optional<Region> region = moved_region(random, of[op].region, reach, moved);
    if (!region) continue;
    std::shared_ptr<const Operand> next = of[op].steps.next(of[op].operand, *region, moved);
    const auto anew = made_anew(*region, op);
    const bool follows = next != nullptr;
    if (follows) expect_same(*next, *anew);
    else next = anew;
    count.elsewhere += follows && !(next->points->offset == of[op].operand->points->offset);
    const auto before = of[op].operand;  // as the lattice before refers to it
    const auto lattice_before = lattice;
    of[op].region = *region;
    of[op].operand = next;
    const Operand &a = *of[0].operand, &b = *of[1].operand;
    lattice = make_lattice(a.points, b.points, 0);
    const auto filled = [](const Lattice& l, const Operand& o, const Operand& other) {
      std::vector<bool> holes;
      for (const Loop& loop : o.loops)
        holes.push_back(loop.kind == LoopKind::hole && hole_is_filled(l, o, loop, other, other.components[0]));
      return holes;
    };
    const Operand &was_a = op == 0 ? *before : a, &was_b = op == 1 ? *before : b;
    const bool same_holes = filled(*lattice, a, b) == filled(*lattice_before, was_a, was_b) &&
                            filled(*lattice, b, a) == filled(*lattice_before, was_b, was_a);
    if (follows && same_holes && convolution->can_follow()) {
      convolution->follow(*lattice, a, b, op, of[op].steps.moves());
      ++count.followed;
    } else {
      convolution = std::make_unique<FollowedConvolution>(*lattice, a, b);
      ++count.anew;
    }
    of[op].steps.use(next);
    ASSERT_NO_FATAL_FAILURE(expect_same(*convolution, FollowedConvolution(*lattice, a, b), a, b)) << "step " << step;
    if (random.chance(20)) referred.push_back(before), ++count.copied;
    if (testing::Test::HasFailure()) FAIL() << "step " << step;
  }
}

TEST(FollowedConvolution, moved_vertices_on_tiny_grids_equal_what_is_made_anew) {
  Count count;
  for (std::uint64_t round = 1; round <= 300; ++round) {
    SCOPED_TRACE(round);
    oracles::Random random(round);
    const Result<Region> p = Region::create(oracles::random_parts(random, 6));
    const Result<Region> q = Region::create(oracles::random_parts(random, 4));
    if (!p || !q || !p->touching_points().empty() || !q->touching_points().empty()) continue;
    move_and_compare(random, *p, *q, {2, 1}, count);
    if (HasFailure()) return;
  }
  EXPECT_GT(count.followed, 100);
  EXPECT_GT(count.anew, 50);
  EXPECT_GT(count.elsewhere, 50);
}

TEST(FollowedConvolution, moved_vertices_in_all_coordinates_equal_what_is_made_anew) {
  Count count;
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    std::mt19937_64 noise(1);
    const Region p = Region::create(of_kind(shapes::random_polygon(60, 3, 3).data(), kind, noise)).value();
    const Region q = Region::create(of_kind(shapes::noisy_star(30, 0.7, 2).data(), kind, noise)).value();
    const auto box = bounds(p);
    for (std::uint64_t round = 1; round <= 6; ++round) {
      SCOPED_TRACE(round);
      oracles::Random random(round);
      move_and_compare(random, p, q, {0.01 * (box[2] - box[0]), 0}, count);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(count.followed, 300);
  EXPECT_GT(count.elsewhere, 10);
  EXPECT_GT(count.copied, 50);
}

}  // namespace
}  // namespace dymsum::planar
