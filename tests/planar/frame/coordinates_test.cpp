// Moving planar sums of coordinates of all kinds: frames inside windows are the sums that are computed anew.
#include <gtest/gtest.h>

#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

struct MovingPair {
  Region p, q;
};

std::vector<MovingPair> moving_pairs(CoordinateKind kind, std::mt19937_64& random) {
  std::vector<MovingPair> pairs;
  const auto add = [&](const Region& one, const Region& other) {
    Result<Region> p = Region::create(of_kind(one.data(), kind, random)),
                   q = Region::create(of_kind(other.data(), kind, random));
    if (p.ok() && q.ok()) pairs.push_back({*std::move(p), *std::move(q)});
  };
  add(shapes::comb(5, 2, 1, 3), shapes::comb(3, 2, 1, 3));
  add(snapped_shapes::gear(8, 3, 4), snapped_shapes::gear(5, 1, 2));
  add(shapes::random_polygon(20, 1, 9), shapes::noisy_star(13, 0.6, 9));
  return pairs;
}

TEST(FrameCoordinates, of_every_kind_scale_as_sums_anew) {
  std::mt19937_64 random(7302);
  for (const CoordinateKind kind : kCoordinateKinds) {
    const std::vector<MovingPair> pairs = moving_pairs(kind, random);
    ASSERT_GE(pairs.size(), 2u) << name_of(kind);
    int updated = 0;
    for (const auto& [p, q] : pairs) {
      MovingOptions windows, anew;
      windows.mode = FrameMode::window;
      anew.mode = FrameMode::rebuild;
      ScalingSum sum = ScalingSum::create(p, q, windows).value(), wanted = ScalingSum::create(p, q, anew).value();
      for (int k = 0; k < oracles::rounds(12); ++k) {
        const double s = 0.9 + 0.017 * k;
        ASSERT_TRUE(sum.set(s).ok() && wanted.set(s).ok());
        ASSERT_TRUE(sum.sum() == wanted.sum()) << name_of(kind) << ", scale " << s;
        updated += !sum.work().rebuilt;
      }
    }
    EXPECT_GT(updated, 0) << name_of(kind);
  }
}

TEST(FrameCoordinates, of_every_kind_turn_as_sums_anew) {
  std::mt19937_64 random(7303);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int updated = 0;
    for (const auto& [p, q] : moving_pairs(kind, random)) {
      MovingOptions windows, anew;
      windows.mode = FrameMode::window;
      anew.mode = FrameMode::rebuild;
      RotatingSum sum = RotatingSum::create(p, q, windows).value(), wanted = RotatingSum::create(p, q, anew).value();
      for (int k = 0; k < oracles::rounds(12); ++k) {
        const Orientation theta = Orientation::nearest(0.02 * k).value();
        ASSERT_TRUE(sum.set(theta).ok() && wanted.set(theta).ok());
        ASSERT_TRUE(sum.sum() == wanted.sum()) << name_of(kind) << ", angle " << theta.radians();
        updated += !sum.work().rebuilt;
      }
    }
    EXPECT_GT(updated, 0) << name_of(kind);
  }
}

}  // namespace
}  // namespace dymsum
