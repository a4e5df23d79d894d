// The stages of a sum near a position: docs/design/local-sum.md.
#pragma once

#include <array>
#include <vector>

#include "dymsum/local_sum.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/moving/moving_solid_sum.h"

namespace dymsum::spatial {

// The walls that cut a sum to a box: those of the box, and those of a slightly larger one within which all is known.

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

/// Whether a facet's box overlaps a box of the space.
bool comes_near(const SumSpace& space, const SumFacet& facet, const Box& box);

/// A position of the box that is queried: whether anything bounds the sum in the box or not, or only where nothing
/// does.
struct Centre {
  std::array<exact::BigRational, 3> at;
  bool always = false;
};

struct LocalBoundary {
  SolidBoundary boundary;      ///< its cells and tight features lie in the box
  bool centre_inside = false;  ///< the centre lies in the open sum, where it was queried
};

/// Requires the facets near the larger box of the walls, in a space with positions for them; all facets for `brute`,
/// where every cell and place of the whole sum is tested by itself.
LocalBoundary local_boundary(PosedSpace& space, ReducedConvolution convolution, const SolidPair& pair, ClipWalls& walls,
                             const Centre& centre, const SpatialOptions& options, SpatialStats& stats,
                             StageWatch& watch);

}  // namespace dymsum::spatial
