// Slow answers about discs and regions, from the definitions alone: no complex, no levels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/growing_disc.h"

namespace dymsum::oracles {

/// The squared distance of a point from the region, as a rational.
dymsum::Rational squared_distance(const dymsum::Region& region, dymsum::Point z);
/// The same from its complement: 0 outside and on the boundary.
dymsum::Rational squared_depth(const dymsum::Region& region, dymsum::Point z);
/// Whether z lies inside or on the boundary of the parts. Exact.
bool in_parts(const dymsum::Region& region, dymsum::Point z);

/// Their roots as doubles, of doubles: for points well away from what is asked.
double distance(const dymsum::Region& region, dymsum::Point z);
double depth(const dymsum::Region& region, dymsum::Point z);

/// How often the rings of a set wind about a point that is well away from them: 1 inside, 0 outside.
int winding(const dymsum::DiscSet& set, dymsum::Point z);

/// Whether z lies in a disc of radius r that keeps to where `clear` is at least r, by trying centres on a grid about z
/// of so many steps a radius. Nothing where the grid does not decide.
template <class Clear>
std::optional<bool> reached(const Clear& clear, dymsum::Point z, double r, int steps) {
  const double h = r / steps, slack = h * 0.7072;  // no centre is further from the grid
  bool maybe = false;
  for (int i = -steps - 1; i <= steps + 1; ++i)
    for (int j = -steps - 1; j <= steps + 1; ++j) {
      const dymsum::Point c{z.x + i * h, z.y + j * h};
      const double far = h * std::hypot(i, j);
      if (far > r + slack) continue;
      const double room = clear(c);
      if (far <= r && room >= r) return true;
      maybe |= room >= r - slack;
    }
  if (maybe) return std::nullopt;
  return false;
}

/// All positions at pieces of the rings: their midpoints, and the corners.
struct BoundaryPosition {
  dymsum::Point at;
  dymsum::Point left;  ///< unit vector into the set
  double length = 0;   ///< of the piece
};
std::vector<BoundaryPosition> midpoints(const dymsum::DiscSet& set);

/// What every set promises of itself: pieces join, smooth corners are smooth, orientation, one outer ring a part.
void check_form(const dymsum::DiscSet& set);

}  // namespace dymsum::oracles
