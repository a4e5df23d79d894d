// Coordinates of rings along axes of their own, and which axes those are.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact/big.h"
#include "planar/boolean/line_families.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

inline constexpr RingAxes kOwnAxes{Point{1, 0}, Point{0, 1}};

/// Chains of one region along common axes: a position is shift + x axes[0] + y axes[1], exactly.
struct AlongAxes {
  RingAxes axes = kOwnAxes;
  Position shift;
  Position center;  ///< the midpoint of all
  std::vector<std::size_t> chains;
  std::vector<std::vector<Point>> at;  ///< chain of the list above -> vertices, as doubles of few digits
  std::size_t merged = 0;              ///< values that became one with another one

  Position position(Point along) const;
};

/// Values within half the tolerance become one. Along other axes than the coordinates' own they are multiples
/// of the unit from the midpoint on, so that what is symmetric stays so; along these
/// a run becomes the value that occurs most often, and doubles stay what they are; rounded ones were equal before only
/// if they are so still. No vertex moves by more than half the tolerance.
AlongAxes along_axes(const std::vector<LineSet>& sets, const std::vector<LineChain>& all,
                     std::vector<std::size_t> chains, const RingAxes& axes);

/// The axes of every chain, in whatever order the regions are: of the coordinates' own and of those of chains with
/// edges in a common direction the ones along which its edges have the fewest directions, and the fewest at no right
/// angle to each other; of several such those that do for most chains, then those along which the edges of all these
/// have the fewest directions together, then the own ones.
std::vector<RingAxes> choose_axes(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains,
                                  const LineFamilies& found);

}  // namespace dymsum::planar
