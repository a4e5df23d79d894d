#include "spatial/sum/vertex_signs.h"

#include <algorithm>
#include <climits>
#include <cmath>

#include "spatial/mesh/fine_coordinate.h"
#include "spatial/mesh/rounded_vector.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

using exact::Big;
using exact::BigInteger;
using exact::FineInterval;

namespace {

int bits(const BigInteger& v) { return v.is_zero() ? INT_MIN / 4 : static_cast<int>(msb(abs(v))) + 1; }

const FineInterval& component(const exact::Vector3<FineInterval>& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// num / den 2^-shift, which is at most 1 in magnitude.
FineInterval fine_ratio(const BigInteger& num, const BigInteger& den, int shift) {
  if (num.is_zero()) return {};
  const int n = bits(num), d = bits(den);
  const FineInterval ratio = fine_coordinate(Big(num), -n) / fine_coordinate(Big(den), -d);
  return ratio * FineInterval(std::ldexp(1.0, std::max(n - d - shift, -1000)));
}

}  // namespace

void VertexSigns::make_positions() {
  const SpatialPositions& positions = SpatialSumInternals::positions(sum_);
  positions_.resize(sum_.vertices.size());
  int top[3] = {INT_MIN / 4, INT_MIN / 4, INT_MIN / 4};
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    std::array<BigInteger, 4>& h = positions_[v].h = positions.homogeneous(v);
    for (std::size_t axis = 0; axis < 3; ++axis) top[axis] = std::max(top[axis], bits(h[axis]) - bits(h[3]) + 1);
  }
  for (Position& p : positions_)
    p.fine = {fine_ratio(p.h[0], p.h[3], top[0]), fine_ratio(p.h[1], p.h[3], top[1]),
              fine_ratio(p.h[2], p.h[3], top[2])};
}

// Axes may be scaled, and rows of determinants, by any positive factors: weights are positive.
int VertexSigns::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) {
  const Position &p = position(a), &q = position(b), &r = position(c);
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto gap = [](const Position& to, const Position& from, std::size_t k) {
    return component(to.fine, k) - component(from.fine, k);
  };
  if (const auto s = sign_of(gap(q, p, i) * gap(r, p, j) - gap(q, p, j) * gap(r, p, i))) return *s;
  const auto minor = [&](std::size_t k, std::size_t l) { return BigInteger(q.h[k] * r.h[l] - q.h[l] * r.h[k]); };
  return BigInteger(p.h[i] * minor(j, 3) - p.h[j] * minor(i, 3) + p.h[3] * minor(i, j)).sign();
}

int VertexSigns::side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const Position &o = position(a), &p = position(b), &q = position(c), &r = position(d);
  if (const auto s = sign_of(dot(cross(p.fine - o.fine, q.fine - o.fine), r.fine - o.fine))) return *s;
  // det(b - a, c - a, d - a) is the negative of the determinant of the rows (a, 1), (b, 1), (c, 1), (d, 1), here by
  // pairs of rows.
  const auto minor = [](const Position& x, const Position& y, std::size_t k, std::size_t l) {
    return BigInteger(x.h[k] * y.h[l] - x.h[l] * y.h[k]);
  };
  const auto pair = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return BigInteger(minor(o, p, i, j) * minor(q, r, k, l) + minor(o, p, k, l) * minor(q, r, i, j));
  };
  return -BigInteger(pair(0, 1, 2, 3) - pair(0, 2, 1, 3) + pair(0, 3, 1, 2)).sign();
}

}  // namespace dymsum::spatial
