// The exact order of turns and events along a range of angles.
#pragma once

#include <optional>

#include "dymsum/solid_rotation_events.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

/// Angles from one turn counter-clockwise to another one, or of a whole turn from -pi (excluded) to pi.
class TurnOrder {
 public:
  /// Requires `from` and `to` both or none, and apart.
  TurnOrder(const RotationCircle& circle, std::optional<AxisTurn> from, std::optional<AxisTurn> to);

  bool holds(const AxisTurn& turn) const;
  /// -1, 0 or 1 where a turn of the range lies before an event of it, at it, or behind it. Exact.
  int compare(const AxisTurn& turn, const SolidRotationEvent& event) const;

 private:
  /// How far behind the beginning an angle is, within 2^-40, if that is in the range.
  double ahead(double radians, bool below_zero) const;
  double ahead(const AxisTurn& turn) const;
  double ahead(const SolidRotationEvent& event) const;
  /// A turn's t in a chart; nothing for infinity.
  std::optional<exact::BigRational> seen_in(int chart, const AxisTurn& turn) const;
  /// The sign of a - b for turns that are less than a quarter turn apart.
  int compare(const AxisTurn& a, const AxisTurn& b) const;

  const RotationCircle& circle_;
  std::optional<AxisTurn> from_, to_;
};

}  // namespace dymsum::spatial
