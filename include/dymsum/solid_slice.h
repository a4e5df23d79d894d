// One height of a sum of solids, without the rest of it: what a tool that moves at that height needs to know.
#pragma once

#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/planar_sum.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The section of P (+) Q by the plane of one z.
struct SolidSlice {
  double z = 0;
  /// { (x, y) : (x, y, z) in P (+) Q } as a planar set with exact positions: its parts, its pieces without area (the
  /// top edge of a roof), and its tight features: positions at which the solids touch without overlapping while they
  /// overlap everywhere around at this height. Contacts of vertices (SumVertex::in and out) hold in `p` an index of
  /// `contacts`, or SumVertex::kNone.
  PlanarSum section;
  /// Parts of the section in which the solids only touch: faces of the sum that lie in the plane, also tight ones.
  std::vector<SumPart> touching;
  std::vector<SolidContact> contacts;  ///< what touches along the edges of the section

  struct Stats {
    int bits = 0;                           ///< of coordinates on the common grid
    std::uint64_t facets = 0, crossed = 0;  ///< of the reduced convolution; of these, meeting the plane
    std::uint64_t cells = 0, collision_tests = 0;
  } stats;
};

/// The slice of P (+) Q at z, equal to that of the whole sum: parts, pieces, and what is tight there. Exact. Where the
/// plane runs through vertices, along edges or along faces of the sum, too. Cost: finding the facets of the reduced
/// convolution, and an arrangement of those that meet the plane in it: O(N + k log k + T) for N facets, k that meet it
/// and T of their crossings there, and collision tests for cells that no facet proves to be covered.
/// Of results the regular part counts, whatever fractions its vertices are. Errors: not_finite for z, else as
/// minkowski_sum.
Result<SolidSlice> slice_of_sum(const SpatialOperand& p, const SpatialOperand& q, double z,
                                const SpatialOptions& options = {});

}  // namespace dymsum
