// Two operands at exact poses: doubles of one scale for filters, integers of one unit where these do not decide.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/double_pair.h"
#include "dymsum/planar_local_sum.h"
#include "exact/big.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

using exact::Big;

template <class Number>
struct PointOf {
  Number x, y;
  friend PointOf operator+(const PointOf& a, const PointOf& b) { return {a.x + b.x, a.y + b.y}; }
  friend PointOf operator-(const PointOf& a, const PointOf& b) { return {a.x - b.x, a.y - b.y}; }
};
template <class Number>
Number cross(const PointOf<Number>& a, const PointOf<Number>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Number>
Number dot(const PointOf<Number>& a, const PointOf<Number>& b) {
  return a.x * b.x + a.y * b.y;
}
using BigPoint = PointOf<Big>;
using PairPoint = PointOf<base::DoublePair>;

inline Point less(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
/// The sign of a x b where it is proved for vectors whose components are off by at most `off`, or 0.
inline int proved_cross(Point a, Point b, double off) {
  const double value = a.x * b.y - a.y * b.x;
  const double error = 2 * off * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y) + 2 * off);
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// (x, y) / w, w > 0.
struct BigPosition {
  Big x, y, w;
};
/// The sign of a - b along an axis.
int compare(const BigPosition& a, const BigPosition& b, int axis);
bool same_position(const BigPosition& a, const BigPosition& b);
BigPosition halfway(const BigPosition& a, const BigPosition& b);

/// Integers count multiples of 2^exponent / den.
struct LocalUnit {
  exact::BigInteger den = 1;
  int exponent = 0;
  exact::BigRational value(const Big& n, const Big& w) const;
  double rounded(const Big& n, const Big& w) const;
  RationalPoint point(const BigPosition& position) const;
};

using PosePair = std::array<PlanarPose, 2>;

/// Doubles are scaled by one power of two, so that all sums of vertices are within [-1, 1]; vertices, and sums of two,
/// are off by less than kOff in each coordinate.
class PosedRegions {
 public:
  static constexpr double kOff = 0x1p-46;

  /// `positions` are further points that have to be integers.
  PosedRegions(const Operand& p, const Operand& q, const PosePair& poses, const std::vector<Point>& positions);

  const Operand& operand(std::uint32_t op) const { return *operands_[op]; }
  /// A point of an operand's own coordinates where it stands.
  Point posed(std::uint32_t op, Point v) const {
    const Map& m = map_[op];
    return {m.xx * v.x + m.xy * v.y, m.yx * v.x + m.yy * v.y};
  }
  Point vertex(std::uint32_t op, std::uint32_t walk) const { return posed(op, own(op, walk)); }
  /// What a length of an operand's own coordinates becomes, at most.
  double stretched(std::uint32_t op, double length) const { return length * map_[op].factor * (1 + 0x1p-40) + kOff; }
  double angle(std::uint32_t op) const { return map_[op].angle; }
  /// Scaled, rounded; numbers beyond 2 in magnitude are 2.
  double scaled(double coordinate) const;
  int scale() const { return scale_; }

  const BigPoint& exact(std::uint32_t op, std::uint32_t walk) const;
  BigPoint exact(Point v) const { return {exact_number(v.x), exact_number(v.y)}; }
  Big exact_number(double v) const;
  /// An integer as a fraction of what is more than any coordinate of a sum, in pairs of doubles: off by less than
  /// kPairOff, and so are those of vertices and sums of two.
  static constexpr double kPairOff = 0x1p-98;
  base::DoublePair pair(const Big& n) const;
  const PairPoint& pair(std::uint32_t op, std::uint32_t walk) const;
  const LocalUnit& unit() const { return unit_; }
  /// The position in scaled doubles, rounded.
  Point scaled(const BigPosition& position) const;
  /// The same of pairs: what is at most 1 there errs by three roundings more than it is off, twice.
  Point scaled(const PairPoint& at) const { return {at.x.value() * pair_scale_, at.y.value() * pair_scale_}; }

 private:
  struct Map {
    double xx = 1, xy = 0, yx = 0, yy = 1, factor = 1, angle = 0;  // scaled
    Big exact_xx, exact_xy, exact_yx, exact_yy;
  };
  Point own(std::uint32_t op, std::uint32_t walk) const {
    const Operand& o = *operands_[op];
    return o.points->input[o.source[walk]];
  }
  std::array<const Operand*, 2> operands_;
  std::array<Map, 2> map_;
  LocalUnit unit_;
  int scale_ = 0;
  int top_ = 0;            // all sums are below 2^top_ in units
  double pair_scale_ = 1;  // of pairs: from 2^-top_ units, between 1 and 2
  mutable std::array<std::vector<std::optional<BigPoint>>, 2> exact_;
  mutable std::array<std::vector<std::optional<PairPoint>>, 2> pairs_;
};

/// The factors of the coordinates of an operand before it rotates.
Point factor_of(const PlanarPose& pose);

/// How far vertices of an operand move from one pose to another, at most, and how much it turns; in its units.
struct PoseChange {
  double distance = 0, turn = 0;
};
PoseChange change_of(const Operand& operand, const PlanarPose& from, const PlanarPose& to);

}  // namespace dymsum::planar
