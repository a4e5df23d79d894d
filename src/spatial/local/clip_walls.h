// The walls that cut a sum to a box: those of the box, and those of a slightly larger one within which all is known.
#pragma once

#include <array>
#include <vector>

#include "dymsum/local_sum.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

/// Bounds of the sum of two posed solids, in their own units, with room for rounding; infinite where doubles fail.
struct SumBounds {
  std::array<double, 3> low{}, high{};
};
SumBounds sum_bounds(const SolidPair& pair, const PosePair& poses);

class ClipWalls {
 public:
  /// Walls beyond the bounds are left out. `with_margin`: with the walls of the larger box.
  ClipWalls(const ClipBox& box, const SumBounds& bounds, bool with_margin);

  bool misses() const { return misses_; }  ///< the box is provably apart from the bounds
  const std::vector<AxisLevel>& levels() const { return levels_; }

  /// Adds the walls' planes to a space that has places for the levels behind `vertices` of P.
  void add_planes(SumSpace& space, std::uint32_t vertices);
  const std::vector<PlaneId>& planes() const { return planes_; }
  /// The larger box in doubles of the space, a little larger.
  Box reach(const SumSpace& space, std::uint32_t vertices) const;

  /// What of an arrangement lies in the closed box (`inside`), its edges without those in a wall (`linked`), and the
  /// same of the larger box.
  struct Scopes {
    ArrangementScope inside, within;
    std::vector<bool> inside_linked, within_linked;  ///< per edge
  };
  Scopes scopes(const SumSpace& space, const SolidArrangement& arrangement) const;

 private:
  struct Wall {
    int axis = 0;
    int inward = 1;  // the sign of the coordinate's growth towards the inside
    bool outer = false;
  };
  void add_wall(const AxisLevel& level, int inward, bool outer);

  std::vector<Wall> walls_;
  std::vector<AxisLevel> levels_;
  std::vector<PlaneId> planes_;
  bool misses_ = false;
};

}  // namespace dymsum::spatial
