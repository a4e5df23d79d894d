// Forms around an angle against exact signs at rational angles near it, and intervals of roots against roots that are
// known.
#include "cspace/events/near_angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cspace/obstacle/obstacle_slices.h"
#include "oracles/random.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

Region turned_square(double degrees, double size) {
  const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta);
  RegionData data;
  data.parts.push_back({{}, {}});
  for (const Point p : {Point{0, 0}, {3 * size, 0}, {3 * size, size}, {size, size}, {size, 2 * size}, {0, 2 * size}})
    data.parts[0].outer.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
  return Region::create(std::move(data)).value();
}

struct Decided {
  int proved = 0, all = 0;
  void compare(int sign, int exact) {
    ++all;
    proved += sign != 0;
    EXPECT_TRUE(sign == 0 || sign == exact);
  }
};

// The angles lie around that by 10^-20 to 0.1, most of them where sides are smaller than what doubles lose.
TEST(NearAngle, signs_are_the_exact_ones) {
  oracles::Random random(3);
  for (const auto& [chart, t] : {std::pair{0, 0.0}, {0, 1.0}, {1, -1.0}, {1, 0.0}, {0, 0.26794919243112270}}) {
    const double obstacle_at = t == 0 || std::abs(t) == 1 ? 30 : 60;
    const auto base =
        pair_of_regions(turned_square(obstacle_at, 1), turned_square(30, 1), PairOptions{.moved = 1, .reflect_q = true})
            .value();
    const TurningForms forms(*base);
    const NearAngle angle(forms, chart, t);
    EXPECT_EQ(angle.exact(), t == 0 || std::abs(t) == 1);
    Decided sides, products;
    for (int k = 0; k < 400; ++k) {
      const auto any = [&](std::uint32_t op) {
        return static_cast<std::uint32_t>(random.below(static_cast<int>(forms.size(op))));
      };
      const auto segment = [&] {
        const auto side = static_cast<std::uint32_t>(random.below(2));
        return WalkSegment{side, any(side), any(1 - side)};
      };
      const double u = random.signed_unit() * std::ldexp(1.0, -4 - random.below(60));
      const BigRational v = exact::exact_value(u), from = exact::exact_value(t),
                        at = (from + v) / (BigRational(1) - from * v);
      const WalkSegment a = segment(), b = segment(), c = segment();
      const Pair p{any(0), any(1)}, start = TurningForms::start(a);
      const int side = forms.exact_side(a, p, chart).sign_at(at);
      sides.compare(angle.side(a, p).polynomial()(u).sign(), side);
      sides.compare(angle.side_polynomial(a, p)(u).sign(), side);
      const int meet = forms.exact_concurrency(a, b, c, chart).sign_at(at);
      products.compare(difference_of_products(angle.side(b, start).polynomial(), angle.cross(a, c).polynomial(),
                                              angle.side(c, start).polynomial(), angle.cross(a, b).polynomial())(u)
                           .sign(),
                       meet);
      if (!angle.exact()) continue;
      products.compare(difference_of_products(angle.exact_side(b, start), angle.exact_cross(a, c),
                                              angle.exact_side(c, start), angle.exact_cross(a, b))(u)
                           .sign(),
                       meet);
    }
    EXPECT_GT(sides.proved * 2, sides.all);
    EXPECT_GT(products.proved * 3, products.all);
  }
}

// Products of linear factors, of which some have their roots at zero, at the ends, or twice.
TEST(NearAngle, all_roots_are_in_narrow_intervals) {
  oracles::Random random(4);
  int narrow = 0, all = 0;
  for (int k = 0; k < 2000; ++k) {
    NearPolynomial p;
    p.degree = 4;
    p.c = {random.signed_unit(), 0, 0, 0, 0};
    std::vector<double> roots;
    for (std::size_t n = 1; n <= 4; ++n) {
      double root = random.signed_unit() * std::ldexp(1.0, -22 - random.below(40));
      if (random.below(8) == 0) root = 0;
      if (!roots.empty() && random.below(8) == 0) root = roots.back();
      if (random.below(4) == 0) root = 1.5 + 0.5 * random.signed_unit();
      for (std::size_t j = n; j > 0; --j) p.c[j] = p.c[j - 1] - root * p.c[j];
      p.c[0] *= -root;
      roots.push_back(root);
    }
    // Rounding moved the roots: as much as the coefficients may err by.
    for (std::size_t j = 0; j < 5; ++j) p.error[j] = p.c[j] == 0 ? 0 : 0x1p-50 * std::abs(p.c[j]) + 0x1p-300;
    const double low = random.below(2) == 0 ? -0x1p-20 : 0, high = 0x1p-20;
    const std::vector<NearRoot> found = near_roots(p, low, high);
    for (const double root : roots) {
      if (root < low || root > high) continue;
      ++all;
      const auto holds = [&](const NearRoot& r) { return r.low <= root && root <= r.high; };
      const auto in = std::find_if(found.begin(), found.end(), holds);
      EXPECT_NE(in, found.end()) << root;
      if (in != found.end()) narrow += in->high - in->low <= 0x1p-20 * std::abs(root);
    }
    EXPECT_EQ(sign_in(p, low, high) != 0 && !found.empty(), false);
  }
  EXPECT_GT(all, 2000);
  EXPECT_GT(narrow * 10, all * 4);
}

}  // namespace
}  // namespace dymsum::planar
