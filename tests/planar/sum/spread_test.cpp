// Operands of which the coordinates, together, are farther apart than the exponents of doubles reach: up to 2^1000
// beside 2^-1074. All engines give the exact sum and positions within at_error; sums that move say that they do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/orientation_sum.h"
#include "dymsum/planar_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scale_range.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/exact_shape.h"
#include "oracles/pair_text.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "oracles/vertices_by.h"

namespace dymsum {
namespace {

using oracles::Big;

RegionData stretched(const RegionData& region, int by_x, int by_y) {
  return oracles::vertices_by(region, [&](Point p) { return Point{std::ldexp(p.x, by_x), std::ldexp(p.y, by_y)}; });
}

Region region_of(const RegionData& data) { return Region::create(data).value(); }
Region scaled(const Region& region, int by) { return region_of(stretched(region.data(), by, by)); }

oracles::ExactShape<Big> shape_of(const PlanarSum& sum) { return canonical(oracles::exact_shape<Big>(sum)); }

// The names of engines that gave another answer than the first one, or positions that err by more than they say.
std::string disagreement(const Region& p, const Region& q, Semantics semantics, const PlanarSum& fast) {
  SumOptions options;
  options.semantics = semantics;
  for (const auto& [engine, name] : {std::pair{Engine::brute, "brute"}, std::pair{Engine::winding, "winding"}}) {
    options.engine = engine;
    const Result<PlanarSum> other = minkowski_sum(p, q, options);
    if (!other) return std::string(name) + ": " + other.error().to_string();
    if (!(*other == fast)) return name;
  }
  const Rational allowed = Rational::of(fast.at_error).value();
  const auto errs = [&](const SumVertex& v) {
    const auto exact = fast.exact(v);
    const Rational dx = exact.x - Rational::of(v.at.x).value(), dy = exact.y - Rational::of(v.at.y).value();
    return dx > allowed || -dx > allowed || dy > allowed || -dy > allowed;
  };
  for (const SumPart& part : fast.parts) {
    for (const SumVertex& v : part.outer.vertices)
      if (errs(v)) return "at_error";
    for (const SumRing& hole : part.holes)
      for (const SumVertex& v : hole.vertices)
        if (errs(v)) return "at_error";
  }
  return "";
}

std::string wrong(const Region& p, const Region& q, Semantics semantics = Semantics::closed) {
  SumOptions options;
  options.semantics = semantics;
  const Result<PlanarSum> sum = minkowski_sum(p, q, options);
  if (!sum) return sum.error().to_string();
  const std::string verdict = oracles::check_sum(p, q, semantics, *sum);
  return verdict.empty() ? disagreement(p, q, semantics, *sum) : verdict;
}

TEST(Spread, a_minute_operand_beside_a_huge_one) {
  const Region u = shapes::letter_u(4, 4, 1), triangle = region_of({{{{{0, 0}, {3, 1}, {1, 2}}, {}}}, {}, {}});
  for (const auto& [e, f] : {std::pair{500, -580},
                             {660, -670},
                             {-580, 500},
                             {990, -1060},
                             {-1060, 990},
                             {200, -620},
                             {200, -560},
                             {-1070, -1070},
                             {-1074, -100},
                             {900, 20}}) {
    EXPECT_EQ(wrong(scaled(triangle, e), scaled(u, f)), "") << e << " " << f;
    EXPECT_EQ(wrong(scaled(triangle, e), scaled(negated(triangle), f)), "") << e << " " << f;
  }
}

// Every coincidence stays when both axes are scaled, each by its own power of two.
TEST(Spread, axes_of_different_sizes_keep_every_coincidence) {
  constexpr std::array<std::array<int, 2>, 5> kSizes{{{600, -600}, {-1074, 990}, {450, -400}, {990, -60}, {-1073, 4}}};
  oracles::Random random(1);
  for (int k = 0; k < 15; ++k) {
    const oracles::Pair pair = oracles::random_pair(random, 4);
    const Region p = region_of(pair.p), q = region_of(pair.q);
    const auto [ex, ey] = kSizes[static_cast<std::size_t>(k % 5)];
    const Region far_p = region_of(stretched(pair.p, ex, ey)), far_q = region_of(stretched(pair.q, ex, ey));
    const auto near = oracles::exact_shape<Big>(minkowski_sum(p, q).value());
    const Result<PlanarSum> far = minkowski_sum(far_p, far_q);
    ASSERT_TRUE(far.ok()) << far.error().to_string();
    const auto power = [](int by) { return oracles::from_double<Big>(std::ldexp(1.0, by)); };
    const oracles::Affine<Big> map{power(ex), 0, 0, power(ey), {0, 0}};
    EXPECT_TRUE(canonical(oracles::exact_shape<Big>(*far)) == oracles::mapped(near, map))
        << ex << " " << ey << "\n"
        << oracles::to_text(pair.p, pair.q);
    EXPECT_EQ(disagreement(far_p, far_q, Semantics::closed, *far), "") << oracles::to_text(pair.p, pair.q);
  }
}

// Every coordinate has an exponent of its own.
TEST(Spread, coordinates_of_all_sizes_in_both_operands) {
  oracles::Random random(2);
  const auto number = [&] { return std::ldexp(double(random.below(15) - 7), random.below(2060) - 1074); };
  const auto polygon = [&] {
    for (;;) {
      Ring ring;
      for (int corners = 3 + random.below(3); corners > 0; --corners) {
        const double x = number();
        ring.push_back({x, number()});
      }
      for (int turned = 0; turned < 2; ++turned) {
        if (Result<Region> made = Region::create({{{ring, {}}}, {}, {}})) return *std::move(made);
        std::reverse(ring.begin(), ring.end());
      }
    }
  };
  for (int k = 0; k < 4; ++k) {
    const Region p = polygon(), q = polygon();
    EXPECT_EQ(wrong(p, q), "") << oracles::to_text(p.data(), q.data());
  }
}

// Places just inside and just outside, whatever else is huge.
TEST(Spread, positions_are_told_apart) {
  const Region huge = scaled(region_of({{{{{0, 0}, {3, 1}, {1, 2}}, {}}}, {}, {}}), 500);
  const Region u = scaled(shapes::letter_u(4, 4, 1), -580);
  EXPECT_TRUE(contains(huge, u, {0, 0x1p-578}));
  EXPECT_FALSE(contains(huge, u, {0, std::nextafter(0x1p-578, 1)}));
  EXPECT_FALSE(contains(huge, u, {0, 0x1p1023}));
  EXPECT_FALSE(contains(huge, u, {-0x1p-1074, 0}));
  EXPECT_THROW(contains(scaled(huge, 510), u, {0, 0}), std::invalid_argument);
}

// Enough for a mask, where there is one.
TEST(Spread, operands_with_many_edges) {
  const Region gear = scaled(snapped_shapes::gear(16, 1, 1.75), 500),
               star = scaled(snapped_shapes::star(16, 1, 2), -550);
  SumOptions options;
  options.engine = Engine::brute;
  const PlanarSum sum = minkowski_sum(gear, star).value();
  EXPECT_TRUE(sum == minkowski_sum(gear, star, options).value());
  EXPECT_GT(sum.vertex_count(), 16u * 4);
}

TEST(Spread, erosions_and_no_fit_polygons) {
  const Region u = shapes::letter_u(4, 4, 1);
  for (const auto& [e, f] : {std::pair{500, -580}, {-600, 500}}) {
    const Region p = scaled(u, e), q = scaled(u, f);
    EXPECT_EQ(oracles::check_nfp(p, q, nfp(p, q).value()), "") << e << " " << f;
    EXPECT_EQ(oracles::check_erode(p, q, erode(p, q).value()), "") << e << " " << f;
  }
}

// A quarter turn is a region of its own; at another angle the engines agree, and the area is that of what is huge.
TEST(Spread, orientations_at_rest) {
  const Region u = shapes::letter_u(4, 4, 1), p = scaled(u, 500), q = scaled(u, -580);
  RegionData data = p.data();
  for (Point& v : data.parts[0].outer) v = {0 - v.y, v.x};
  EXPECT_TRUE(shape_of(rotated_sum(p, q, Orientation::parse("1").value()).value()) ==
              shape_of(minkowski_sum(region_of(data), q).value()));
  const Orientation some = Orientation::parse("1/3").value();
  const Region origin = region_of({{}, {}, {Point{0, 0}}});
  for (const auto& [a, b] : {std::pair{p, q}, std::pair{q, p}}) {
    const Result<PlanarSum> sum = rotated_sum(a, b, some);
    ASSERT_TRUE(sum.ok()) << sum.error().to_string();
    EXPECT_TRUE(sum->area_exact() > minkowski_sum(p, origin)->area_exact());
    EXPECT_EQ(sum->area(), minkowski_sum(p, origin)->area());
    for (const Engine engine : {Engine::brute, Engine::winding}) {
      SumOptions options;
      options.engine = engine;
      EXPECT_TRUE(shape_of(rotated_sum(a, b, some, options).value()) == shape_of(*sum));
    }
  }
}

TEST(Spread, sums_that_move_say_what_they_do_not_take) {
  const Region u = shapes::letter_u(4, 4, 1), huge = scaled(u, 500), minute = scaled(u, -580);
  const auto refused = [](const auto& result) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::unsupported_operand);
    EXPECT_NE(result.error().message.find("2^920"), std::string::npos) << result.error().to_string();
    EXPECT_TRUE(result.error().evidence.x.has_value());
  };
  refused(ScalingSum::create(huge, minute));
  refused(ScalingSum::create(minute, huge));
  refused(RotatingSum::create(huge, minute));
  EXPECT_TRUE(scale_range(huge, {{0, 0}}, minute).ok()) << "the part is measured in a unit of its own";
}

// Up to there they equal sums at rest.
TEST(Spread, sums_that_move_within_their_limit) {
  const Region u = shapes::letter_u(4, 4, 1), star = snapped_shapes::star(5, 1, 2);
  for (const auto& [e, f] : {std::pair{400, -330}, {-330, 400}, {960, 200}, {-1020, -250}, {-250, -1020}}) {
    const Region p = scaled(u, e), q = scaled(star, f);
    ScalingSum moving = ScalingSum::create(p, q).value();
    for (const double s : {1.0, 1.125, 1.25, 3.0}) {
      ASSERT_TRUE(moving.set(s).ok());
      RegionData larger = p.data();
      for (Point& v : larger.parts[0].outer) v = {s * v.x, s * v.y};
      EXPECT_TRUE(shape_of(moving.sum()) == shape_of(minkowski_sum(region_of(larger), q).value()))
          << e << " " << f << " " << s;
    }
    RotatingSum turning = RotatingSum::create(p, q).value();
    for (const char* t : {"0", "1/5", "1/3", "1"}) {
      const Orientation theta = Orientation::parse(t).value();
      ASSERT_TRUE(turning.set(theta).ok());
      EXPECT_TRUE(shape_of(turning.sum()) == shape_of(rotated_sum(p, q, theta).value())) << e << " " << f << " " << t;
    }
  }
}

}  // namespace
}  // namespace dymsum
