// A frame of a turning sum against the slice that it has to equal.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/rotating_sum.h"
#include "exact/big.h"
#include "planar/position/exact_source.h"

namespace dymsum::rotating_frames {

inline Orientation at(double radians, double error = 1e-6) { return Orientation::nearest(radians, error).value(); }

inline PlanarSum fresh(const Region& p, const Region& q, const Orientation& theta, const MovingOptions& options) {
  SumOptions sum_options;
  sum_options.semantics = options.semantics;
  if (options.reflect_q) return cspace_slice(q, p, theta, sum_options).value();
  if (options.moving == MovingOperand::p) return rotated_sum(p, q, theta, sum_options).value();
  // P + R Q is R (R^-1 P + Q): the same positions need Q in the turning place, and numbers the other way round.
  return rotated_sum(q, p, theta, sum_options).value();
}

inline bool same_contacts(const SumRing& a, const SumRing& b) {
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                    [](const SumVertex& u, const SumVertex& v) {
                      return u.in == v.in && u.out == v.out && u.corner_p == v.corner_p && u.corner_q == v.corner_q;
                    });
}

inline void expect_frame(const RotatingSum& sum, const PlanarSum& wanted, bool contacts) {
  ASSERT_TRUE(sum.sum() == wanted);
  if (sum.work().rebuilt) return;
  ASSERT_EQ(sum.sum().parts.size(), wanted.parts.size());
  const auto ring = [&](const SumRing& ours, const SumRing& theirs) {
    EXPECT_TRUE(!contacts || same_contacts(ours, theirs));
    for (std::size_t k = 0; k < ours.vertices.size(); k += 1 + ours.vertices.size() / 5) {
      const RationalPoint exact = sum.sum().exact(ours.vertices[k]);
      const auto off = [&](double v, const Rational& r) -> exact::BigRational {
        return exact::BigRational(abs(exact::BigRational(exact::exact_value(v) - exact::exact_value(r))));
      };
      const exact::BigRational bound = exact::exact_value(sum.sum().at_error);
      EXPECT_LE(off(ours.vertices[k].at.x, exact.x), bound);
      EXPECT_LE(off(ours.vertices[k].at.y, exact.y), bound);
    }
  };
  for (std::size_t i = 0; i < wanted.parts.size(); ++i) {
    ring(sum.sum().parts[i].outer, wanted.parts[i].outer);
    for (std::size_t h = 0; h < wanted.parts[i].holes.size(); ++h)
      ring(sum.sum().parts[i].holes[h], wanted.parts[i].holes[h]);
  }
}

}  // namespace dymsum::rotating_frames
