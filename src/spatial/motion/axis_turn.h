// Exact turns about an axis of integers as (chart, t) on the circle, so that no angle is an exception.
#pragma once

#include "dymsum/solid_rotation_events.h"
#include "exact/algebraic_root.h"
#include "spatial/convex/exact_positions.h"

namespace dymsum::spatial {

/// theta = 2 atan(|axis| t) + pi chart.
struct ChartPosition {
  int chart = 0;
  exact::BigRational t;
};

/// What turns of one axis have in common. P's quaternion is (1, t axis) in chart 0, (-square t, axis) in chart 1.
class RotationCircle {
 public:
  /// Requires an axis that is not zero and has no common divisor.
  explicit RotationCircle(TurnAxis axis);

  const TurnAxis& axis() const { return axis_; }
  std::int64_t square() const { return square_; }  ///< |axis|^2
  double length() const { return length_; }
  /// The position of a rotation in the chart where |t| is at most about 1 / |axis|.
  ChartPosition position(const AxisTurn& turn) const;
  AxisTurn turn(const ChartPosition& position) const;
  ExactPose pose(const ChartPosition& position) const;
  /// The angle within 2^-48, in (-pi, 3 pi).
  double radians(int chart, double t) const;
  /// The parameter at which charts meet: t = reach of chart 0 is t = -other_reach of chart 1, and back.
  exact::BigRational reach(int chart) const;

  /// 1 + square t^2, primitive.
  const exact::Terms& divisor() const { return divisor_; }
  /// What polynomials of turned vectors are over: the divisor, times |axis|^2 in chart 1.
  const exact::Terms& weight(int chart) const { return weight_[chart]; }
  /// The vector turned, times the weight.
  exact::Vector3<exact::RootValue> turned(int chart, const exact::Vector3<exact::Big>& v,
                                          const exact::RootPoint* at) const;

 private:
  TurnAxis axis_;
  std::int64_t square_ = 1;
  double length_ = 1;
  exact::Terms divisor_;
  std::array<exact::Terms, 2> weight_;
};

}  // namespace dymsum::spatial
