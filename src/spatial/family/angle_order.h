// The exact order of angles and events along a range of angles.
#pragma once

#include <optional>

#include "dymsum/solid_rotation_events.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

/// Angles from one counter-clockwise to another one, or all from -pi (excluded) to pi.
class AngleOrder {
 public:
  /// Requires `from` and `to` both or none, and apart.
  AngleOrder(const RotationCircle& circle, std::optional<ChartPosition> from, std::optional<ChartPosition> to);

  bool holds(const ChartPosition& theta) const;
  /// -1, 0 or 1 where an angle of the range lies before an event of it, at it, or behind it. Exact.
  int compare(const ChartPosition& theta, const SolidRotationEvent& event) const;

 private:
  /// How far behind the beginning an angle is, within 2^-40, if that is in the range.
  double ahead(double radians, bool below_zero) const;
  double ahead(const ChartPosition& theta) const;
  double ahead(const SolidRotationEvent& event) const;
  /// The t of an angle in a chart; nothing for infinity.
  std::optional<exact::BigRational> seen_in(int chart, const ChartPosition& theta) const;
  /// The sign of a - b for angles that are less than a quarter of the circle apart.
  int compare(const ChartPosition& a, const ChartPosition& b) const;

  const RotationCircle& circle_;
  std::optional<ChartPosition> from_, to_;
};

}  // namespace dymsum::spatial
