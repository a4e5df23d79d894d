// Families of a turn: any sum of one equals that from scratch, in every cell, at angles of changes and between.
#include "dymsum/rotation_family.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kTurnSeed = 20261201;

int turn_rounds(int usual) {
  const char* queried = std::getenv("DYMSUM_FUZZ_FAMILIES");
  return queried != nullptr ? std::atoi(queried) : usual;
}

/// The sum that a family has to give, by other means: P turned, or Q.
PlanarSum by_itself(const Region& p, const Region& q, const Orientation& theta, const FamilyOptions& options) {
  SumOptions sum;
  sum.semantics = options.semantics;
  const Region second = options.reflect_q ? negated(q) : q;
  return options.moving == MovingOperand::p ? rotated_sum(p, second, theta, sum).value()
                                            : rotated_sum(second, p, theta, sum).value();
}

struct Counts {
  std::size_t compared = 0, in_cells = 0, at_changes = 0;
};

/// Compares at orientations with small tangents, at those of changes, and inside of some cells.
void check_turns(const Region& p, const Region& q, const FamilyOptions& options, int count, Random& random,
                 Counts& counts) {
  const Result<RotationFamily> family = RotationFamily::create(p, q, options);
  ASSERT_TRUE(family.ok()) << family.error().to_string();
  std::vector<Orientation> thetas{Orientation(), Orientation::half_turn()};
  for (int k = 0; k < count; ++k) {
    thetas.push_back(Orientation::of(random.below(19) - 9, 1 + random.below(9)).value());
    thetas.push_back(Orientation::nearest(6.2 * random.below(10007) / 10007).value());
    if (family->angles().empty()) continue;
    const EventAngle& angle =
        family->angles()[static_cast<std::size_t>(random.below(1 << 20)) % family->angles().size()];
    if (angle.exact) thetas.push_back(*angle.exact);
    thetas.push_back(Orientation::nearest(angle.theta).value());
  }
  for (const Orientation& theta : thetas) {
    const PlanarSum sum = family->at(theta).value();
    ++counts.compared;
    const std::optional<std::uint32_t> cell = family->cell_of(theta);
    (cell ? counts.in_cells : counts.at_changes) += 1;
    EXPECT_TRUE(sum == by_itself(p, q, theta, options)) << theta.radians();
    for (const SumPart& part : sum.parts)
      for (const SumVertex& v : part.outer.vertices) {
        const RationalPoint at = sum.exact(v);
        EXPECT_LE(std::abs(at.x.to_double() - v.at.x), sum.at_error * (1 + 0x1p-40));
        EXPECT_LE(std::abs(at.y.to_double() - v.at.y), sum.at_error * (1 + 0x1p-40));
      }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(RotationFamily, of_tiny_parts_equals_sums_from_scratch) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kTurnSeed));
  Counts counts;
  for (int k = 0; k < turn_rounds(40); ++k) {
    Random random(kTurnSeed + static_cast<std::uint64_t>(k));
    const RegionData p = random_parts(random, 5), q = random_parts(random, 4);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q));
    FamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    options.reflect_q = k % 3 == 0;
    options.semantics = k % 5 == 0 ? Semantics::open : k % 5 == 1 ? Semantics::regular : Semantics::closed;
    check_turns(Region::create(p).value(), Region::create(q).value(), options, 6, random, counts);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(counts.in_cells, 500u);
  EXPECT_GT(counts.at_changes, 50u);
}

TEST(RotationFamily, of_every_kind_of_coordinates_equals_sums_from_scratch) {
  Counts counts;
  Random random(kTurnSeed);
  for (const CoordinateKind kind : kCoordinateKinds) {
    std::mt19937_64 noise(kTurnSeed);
    const auto of = [&](const Region& r) { return Region::create(of_kind(r.data(), kind, noise)); };
    const Result<Region> p = of(shapes::noisy_star(14, 0.6, 5)), q = of(shapes::gear(4, 0.5, 0.75, 0.125));
    SCOPED_TRACE(name_of(kind));
    ASSERT_TRUE(p.ok() && q.ok());
    check_turns(*p, *q, {}, 8, random, counts);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(counts.in_cells, 100u);
}

TEST(RotationFamily, knows_cells_and_what_comes_next) {
  const Region bar = shapes::rectangle(-2, -0.5, 2, 0.5), square = shapes::rectangle(0, 0, 1, 1);
  const RotationFamily family = RotationFamily::create(bar, square).value();
  ASSERT_EQ(family.angles().size(), 4u);  // quarter turns
  EXPECT_EQ(family.cell_of(Orientation()), std::nullopt);
  EXPECT_EQ(family.next(Orientation())->exact->tan_half().to_string(), "1/1");
  EXPECT_EQ(family.next(Orientation::of(1, 3).value())->exact->tan_half().to_string(), "1/1");
  EXPECT_EQ(family.at(Orientation()).value().area_exact().to_string(), "10/1");
  const std::vector<Lifetime> lives = family.lifetimes();
  EXPECT_EQ(lives.size(), family.work().names);
  for (const Lifetime& life : lives) EXPECT_LT(life.last_cell, family.work().cells);
}

TEST(RotationFamily, turns_about_any_point_that_is_exact) {
  const Region bar = shapes::rectangle(0, 0, 4, 1), square = shapes::rectangle(0, 0, 1, 1);
  const Orientation quarter = Orientation::of(1, 1).value();
  FamilyOptions options;
  // About (4, 0) the bar comes to stand on [3, 4] x [-4, 0].
  const RotationFamily family = RotationFamily::create(bar, square, Point{4, 0}, options).value();
  EXPECT_EQ(family.at(quarter).value(), minkowski_sum(shapes::rectangle(3, -4, 4, 0), square).value());
  options.reflect_q = true;
  EXPECT_EQ(RotationFamily::create(bar, square, Point{4, 0}, options).value().at(quarter).value(),
            nfp(shapes::rectangle(3, -4, 4, 0), square).value());
  options.moving = MovingOperand::q;
  EXPECT_EQ(RotationFamily::create(square, bar, Point{4, 0}, options).value().at(quarter).value(),
            nfp(square, shapes::rectangle(3, -4, 4, 0)).value());
  EXPECT_EQ(RotationFamily::create(bar, square, Point{0x1p-60, 0}).error().code, ErrorCode::unsupported_operand);
  const Region line = Region::create({{}, {{{0, 0}, {1, 0}}}, {}}).value();
  EXPECT_EQ(RotationFamily::create(bar, line).error().code, ErrorCode::unsupported_operand);
}

TEST(RotationFamily, inner_and_outer_are_on_the_safe_side) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kTurnSeed));
  SumOptions regular;
  regular.semantics = Semantics::regular;
  std::size_t inner_parts = 0;
  for (int k = 0; k < turn_rounds(6); ++k) {
    Random random(kTurnSeed + 900 + static_cast<std::uint64_t>(k));
    const RegionData p = random_parts(random, 5), q = random_parts(random, 3);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q));
    FamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    options.reflect_q = k % 3 == 0;
    const RotationFamily family =
        RotationFamily::create(Region::create(p).value(), Region::create(q).value(), options).value();
    const Orientation a = Orientation::nearest(0.3 * k).value(), b = Orientation::nearest(0.3 * k + 0.2).value();
    const PlanarSum outer = family.outer(a, b, 0.25).value(), inner = family.inner(a, b, 0.25).value();
    inner_parts += inner.parts.size();
    for (int i = 0; i <= 5; ++i) {
      const PlanarSum sum = family.at(Orientation::nearest(0.3 * k + 0.04 * i).value()).value();
      EXPECT_TRUE(difference(inner, sum, regular).value().parts.empty()) << i;
      EXPECT_TRUE(difference(sum, outer, regular).value().parts.empty()) << i;
    }
    EXPECT_LE(outer.area(), family.at(a).value().area() + 0.5 * 60) << "within a quarter of the sums";
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(inner_parts, 2u);
  const Region square = shapes::rectangle(0, 0, 1, 1);
  const RotationFamily family = RotationFamily::create(square, square).value();
  const Orientation still = Orientation::of(1, 3).value();
  EXPECT_EQ(family.outer(still, still, 1).value(), family.at(still).value());
  EXPECT_EQ(family.outer(still, Orientation(), 0).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(family.inner(still, Orientation(), 1e-9).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace dymsum::oracles
