// Parts of segments in boxes against exact rationals.
#include "planar/mask/interior_mask.h"

#include <gtest/gtest.h>

#include <array>

#include "exact/big.h"
#include "oracles/random.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

struct Exact {
  BigRational from = 0, to = 1;
};

Exact exact_part(const std::array<int, 4>& s, const std::array<int, 4>& box) {
  Exact part;
  for (int axis = 0; axis < 2; ++axis) {
    const BigRational low = box[axis] - s[axis], high = box[2 + axis] - s[axis];
    const int d = s[2 + axis];
    if (d == 0) {
      if (low > 0 || high < 0) part.to = -1;
      continue;
    }
    const BigRational u = low / d, v = high / d;
    part.from = std::max(part.from, std::min(u, v));
    part.to = std::min(part.to, std::max(u, v));
  }
  return part;
}

TEST(SegmentClip, equals_exact_rationals) {
  oracles::Random random(27182);
  int inside = 0, outside = 0, straight = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto number = [&] { return random.below(19) - 9; };
    const std::array<int, 4> s{number(), number(), number(), number()};
    const int x = number(), y = number();
    const std::array<int, 4> box{x, y, x + random.below(7), y + random.below(7)};
    const SegmentClip::Part part = SegmentClip(s[0], s[1], s[2], s[3]).within(box[0], box[1], box[2], box[3]);
    const Exact exact = exact_part(s, box);
    straight += s[2] == 0 || s[3] == 0;
    if (exact.to < exact.from) {
      ++outside;
      EXPECT_LT(part.to, part.from + 0x1p-50);
      continue;
    }
    ++inside;
    EXPECT_NEAR(part.from, exact::round_to_double(exact.from), 0x1p-50);
    EXPECT_NEAR(part.to, exact::round_to_double(exact.to), 0x1p-50);
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 300);
  EXPECT_GT(straight, 100);
}

}  // namespace
}  // namespace dymsum::planar
