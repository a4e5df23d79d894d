// A radius among the nodes of a complex.
#pragma once

#include <string>

#include "dymsum/growing_disc.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

/// Nodes [0, below) have smaller radii, [below, up_to) this one.
struct Level {
  std::uint32_t below = 0, up_to = 0;
  exact::RootExpression exact;
  exact::Interval near;  ///< contains it
  double radius = 0;     ///< the nearest double
  std::string text;
  bool holds(std::uint32_t node) const { return below <= node && node < up_to; }
};

/// Events are the radii of nodes beyond 0. O(n).
std::vector<DiscEvent> disc_events(const Complex& complex);
/// Error out_of_range for a negative radius, one that is no positive double, and an event that there is not.
Result<Level> level_at(const Complex& complex, const DiscRadius& r);

/// Whether an edge rises from nodes [0, cut) to one of the others or to infinity: the disc there, with `cut` between
/// two radii or just above or below one, touches on both sides of it.
inline bool crosses(const Edge& edge, std::uint32_t cut) { return edge.low < cut && edge.high >= cut; }

}  // namespace dymsum::shape
