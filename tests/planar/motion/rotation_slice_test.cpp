// Sums at an orientation against static sums of operands that were rotated beforehand: multiplied by the denominator
// their vertices are integers.
#include <gtest/gtest.h>

#include <random>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/sanitized.h"
#include "planar/position/exact_source.h"

namespace dymsum {
namespace {

struct Turn {
  std::int64_t n, d;
};

// (c, -s; s, c) with c = d^2 - n^2, s = 2 n d for operand 1; d^2 + n^2 times the identity for operand 0.
Region mapped(const Region& region, std::int64_t c, std::int64_t s) {
  RegionData data = region.data();
  const auto map = [&](Point& v) {
    v = {static_cast<double>(c) * v.x - static_cast<double>(s) * v.y,
         static_cast<double>(s) * v.x + static_cast<double>(c) * v.y};
  };
  for (Part& part : data.parts) {
    for (Point& v : part.outer) map(v);
    for (Ring& hole : part.holes)
      for (Point& v : hole) map(v);
  }
  return *Region::create(std::move(data));
}

std::vector<std::vector<RationalPoint>> rings(const PlanarSum& sum, std::int64_t divisor) {
  std::vector<std::vector<RationalPoint>> all;
  const auto add = [&](const SumRing& ring) {
    all.emplace_back();
    for (const SumVertex& v : ring.vertices) {
      const RationalPoint p = sum.exact(v);
      const auto divided = [&](const Rational& r) {
        return exact::to_rational(exact::BigRational(exact::exact_value(r) / divisor));
      };
      all.back().push_back({divided(p.x), divided(p.y)});
    }
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return all;
}

Region random_shape(std::mt19937_64& random, int reach, bool hole) {
  const auto at = [&] { return static_cast<double>(static_cast<int>(random() % (2 * reach + 1)) - reach); };
  for (;;) {
    RegionData data;
    data.parts.emplace_back();
    const int n = 3 + static_cast<int>(random() % 5);
    for (int i = 0; i < n; ++i) data.parts[0].outer.push_back({at(), at()});
    if (hole) data.parts[0].holes.push_back({{at(), at()}, {at(), at()}, {at(), at()}});
    Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.empty()) return repaired->region;
  }
}

void expect_slice(const Region& robot, const Region& obstacle, Turn t, Semantics semantics) {
  const std::int64_t c = t.d * t.d - t.n * t.n, s = 2 * t.n * t.d, w = t.d * t.d + t.n * t.n;
  SumOptions options;
  options.semantics = semantics;
  const PlanarSum slice = *cspace_slice(robot, obstacle, *Orientation::of(t.n, t.d), options);
  const PlanarSum whole = *nfp(mapped(obstacle, w, 0), mapped(robot, c, s), options);
  EXPECT_EQ(rings(slice, 1), rings(whole, w));
  EXPECT_EQ(slice.tight_points.size(), whole.tight_points.size());
  EXPECT_EQ(slice.tight_segments.size(), whole.tight_segments.size());
  for (const SumPart& part : slice.parts)
    for (const SumVertex& v : part.outer.vertices) {
      const RationalPoint exact = slice.exact(v);
      EXPECT_LE(std::abs(exact.x.to_double() - v.at.x), slice.at_error * 1.01 + 1e-300);
      EXPECT_LE(std::abs(exact.y.to_double() - v.at.y), slice.at_error * 1.01 + 1e-300);
    }
}

TEST(RotationSlice, equals_the_sum_of_rotated_operands) {
  std::mt19937_64 random(1);
  for (int i = 0; i < (oracles::kSanitized ? 1000 : 3000); ++i) {
    const bool hole = random() % 3 == 0;
    const Region robot = random_shape(random, 6, false), obstacle = random_shape(random, hole ? 12 : 6, hole);
    const Turn t{static_cast<std::int64_t>(random() % 41) - 20, static_cast<std::int64_t>(random() % 20)};
    if (t.n == 0 && t.d == 0) continue;
    SCOPED_TRACE(testing::Message() << "pair " << i << " t " << t.n << "/" << t.d);
    expect_slice(robot, obstacle, t, random() % 2 == 0 ? Semantics::open : Semantics::closed);
  }
}

// Rotations with small denominators, several parts, and coordinates whose sums are rounded: p + q = p' + q' in
// hundreds, and the two sums are seldom the same doubles.
TEST(RotationSlice, finds_equal_sums_of_different_pairs_that_are_rounded_differently) {
  std::mt19937_64 random(3);
  const std::vector<Turn> turns = {{1, 2}, {1, 3}, {2, 3}, {3, 1}, {-1, 2}, {-3, 2}, {1, 5}, {-2, 5}};
  for (int i = 0; i < 400; ++i) {
    const double hair = static_cast<double>(random() % 1024) * 0x1p-40;
    const auto parts = [&](double step) {
      RegionData data;
      for (int k = 0; k < 2; ++k) {
        const Region one = random_shape(random, 3, false);
        for (Part part : one.data().parts) {
          for (Point& v : part.outer) v = {v.x + step * k + hair, v.y};
          data.parts.push_back(part);
        }
      }
      return *Region::create(data);
    };
    const Region robot = parts(8), obstacle = parts(7);
    const Turn t = turns[random() % turns.size()];
    SCOPED_TRACE(testing::Message() << "pair " << i << " t " << t.n << "/" << t.d);
    expect_slice(robot, obstacle, t, random() % 2 == 0 ? Semantics::open : Semantics::closed);
    if (HasFailure()) return;
  }
}

TEST(RotationSlice, equals_the_sum_of_rotated_operands_in_every_tier) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 50; ++i) {
    const Region robot = random_shape(random, 6, false), obstacle = random_shape(random, 9, true);
    const Orientation theta = *Orientation::of(static_cast<std::int64_t>(random() % 41) - 20, 7);
    SumOptions options;
    options.semantics = Semantics::open;
    const PlanarSum first = *cspace_slice(robot, obstacle, theta, options);
    for (const int bits : {61, 512, 4096}) {
      planar::SumInternals::min_tier_bits(options) = bits;
      EXPECT_TRUE(first == *cspace_slice(robot, obstacle, theta, options));
    }
  }
}

TEST(RotationSlice, keeps_thousands_of_bits) {
  std::mt19937_64 random(3);
  const Region robot = random_shape(random, 6, false), obstacle = random_shape(random, 9, true);
  exact::BigInteger d = 1;
  d <<= 900;
  const Orientation a = *Orientation::of(exact::to_rational(exact::BigRational(exact::BigInteger(d / 3), d)));
  EXPECT_EQ((a * a.inverse()), Orientation());
  const PlanarSum slice = *cspace_slice(robot, obstacle, a);
  const PlanarSum near = *cspace_slice(robot, obstacle, *Orientation::of(1, 3));
  EXPECT_EQ(slice.stats.tier_bits, 0);
  EXPECT_NEAR(slice.area(), near.area(), 1e-9);
  EXPECT_FALSE(slice.area_exact() == near.area_exact());
}

TEST(RotationSlice, orientations_of_every_width_fit_their_tier) {
  // Tangents of 3 to 140 bits and operands of 2 to 6: the integers pass the limits of all tiers bit by bit.
  for (const double width : {3.0, 6.0, 12.0, 24.0, 48.0})
    for (int bits = 3; bits < 140; ++bits) {
      const exact::BigInteger d = exact::BigInteger(1) << bits, n = d / 3 + 1;
      const Orientation theta = *Orientation::of(exact::to_rational(exact::BigRational(n, d)));
      EXPECT_EQ(
          cspace_slice(shapes::rectangle(4, -1, 4 + width, 1), shapes::rectangle(0, 0, 5, 1), theta)->vertex_count(),
          8u);
    }
}

TEST(Orientation, names_angles) {
  EXPECT_EQ(Orientation::of(1, 0)->radians(), M_PI);
  EXPECT_EQ(*Orientation::of(2, 6), *Orientation::of(1, 3));
  EXPECT_EQ(*Orientation::of(2, -6), *Orientation::of(-1, 3));
  EXPECT_EQ(Orientation::parse("0.25")->tan_half(), *Rational::of(1, 4));
  EXPECT_TRUE(Orientation::parse("inf")->is_half_turn());
  EXPECT_THROW((void)Orientation::half_turn().tan_half(), std::invalid_argument);
  EXPECT_NE(Orientation::half_turn(), Orientation());
  EXPECT_EQ(Orientation::parse("1/0").error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(*Orientation::of(3, 2) * Orientation::of(3, 2)->inverse(), Orientation());
  EXPECT_EQ(*Orientation::of(1, 2) * *Orientation::of(1, 3), *Orientation::of(1, 1))
      << "Euler's sum for a quarter of pi";
  EXPECT_EQ(Orientation::of(0, 0).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(Orientation::parse("a").error().code, ErrorCode::malformed);
  EXPECT_EQ(Orientation::nearest(NAN).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(*Orientation::nearest(M_PI / 2), *Orientation::of(1, 1));
  EXPECT_EQ(*Orientation::nearest(-M_PI), Orientation::half_turn());
  EXPECT_EQ(*Orientation::of(1, 1) * *Orientation::of(1, 1), Orientation::half_turn());
  for (double angle = -10; angle < 10; angle += 0.0371) {
    EXPECT_NEAR(std::remainder(Orientation::nearest(angle)->radians() - angle, 2 * M_PI), 0, 0x1p-49);
    for (const double error : {1e-2, 1e-5, 1e-9, 1e-13})
      EXPECT_NEAR(std::remainder(Orientation::nearest(angle, error)->radians() - angle, 2 * M_PI), 0, error);
  }
  EXPECT_LE(Orientation::nearest(1.234567, 1e-3)->tan_half().denominator().size(), 3u);
}

}  // namespace
}  // namespace dymsum
