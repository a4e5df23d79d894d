// Relative maps of scaled poses: the same integers from machine words and from numbers of any size.
#include "spatial/gauss/signs.h"

#include "spatial/convex/convex_cases.h"

namespace dymsum::test {
namespace {

using spatial::PoseFactors;
using spatial::RelativeMap;

/// The same pose, with fractions too long for machine words.
PoseFactors lengthened(PoseFactors f) {
  for (std::size_t k = 0; k < 3; ++k) {
    f.num[k] <<= 30;
    f.den[k] <<= 30;
  }
  return f;
}

TEST(RelativeMap, of_scaled_poses_is_the_same_from_words_and_from_numbers_of_any_size) {
  std::mt19937_64 random(63);
  int narrow = 0, wide = 0, beyond = 0;
  for (int k = 0; k < 600; ++k) {
    const auto factor = [&] {
      const std::uint64_t most = k % 3 == 0 ? 40 : 1 << 20;
      return exact::BigInteger(1 + random() % most);
    };
    PoseFactors p, q;
    p.scaled = q.scaled = true;
    for (std::size_t i = 0; i < 3; ++i) {
      p.num[i] = factor();
      p.den[i] = factor();
      if (k % 4 == 0) continue;
      q.num[i] = factor();
      q.den[i] = factor();
    }
    if (k % 2 == 0) p.rotation = random_rotation(random);
    if (k % 5 == 0) p.rotation = *Rotation::of(3, -1, 2, 0);
    if (k % 7 == 0) q.rotation = random_rotation(random);
    const RelativeMap map(p, q), same(lengthened(p), lengthened(q));
    ASSERT_TRUE(map == same) << k;
    ++(map.bits() <= 62 ? narrow : map.bits() <= 126 ? wide : beyond);
    // One after the other is a multiple of nothing done.
    const auto both = map.matrix<exact::Big>(0);
    const auto back = map.matrix<exact::Big>(1);
    const auto column = exact::apply(both, exact::Vector3<exact::Big>{back[0].x, back[1].x, back[2].x});
    EXPECT_GT(sign(column.x), 0);
    EXPECT_EQ(sign(column.y), 0);
    EXPECT_EQ(sign(column.z), 0);
  }
  EXPECT_GT(narrow, 50);
  EXPECT_GT(wide, 50);
  EXPECT_GT(beyond, 50);
}

}  // namespace
}  // namespace dymsum::test
