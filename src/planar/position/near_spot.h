// Positions for questions asked often: doubles decide nearly always, and exact numbers are kept only where doubles do
// not hold a position.
#pragma once

#include <cstdint>
#include <deque>

#include "planar/position/position_signs.h"

namespace dymsum::planar {

/// A position by its nearest doubles and the side of them on which it lies. Rounding to nearest is monotone, so
/// positions are ordered as their nearest doubles, then as these sides.
struct NearSpot {
  Point at;
  std::int8_t off_x = 0, off_y = 0;  ///< the signs of exact - at
  const Position* exact = nullptr;   ///< null: `at` is the position
};

/// Requires: finite.
inline NearSpot near_spot(Point p) { return {{p.x + 0.0, p.y + 0.0}}; }
/// The position, which is added to `kept` unless doubles hold it. Requires: its nearest doubles are finite.
NearSpot near_spot(Position p, std::deque<Position>& kept);

int compare_x(const NearSpot& a, const NearSpot& b);
int compare_y(const NearSpot& a, const NearSpot& b);
/// The sign of (b - a) x (c - a), exactly.
int orientation(const NearSpot& a, const NearSpot& b, const NearSpot& c);
/// True when c lies on the closed segment from a to b, which may be one point.
bool on_segment(const NearSpot& a, const NearSpot& b, const NearSpot& c);

}  // namespace dymsum::planar
