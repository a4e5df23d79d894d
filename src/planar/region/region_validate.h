// The checks behind Region::create, and the way to make regions whose validity is already proved.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::planar {

/// The first coordinate that is NaN or infinite, with its part and ring, or chain, and vertex.
std::optional<Error> check_finite(const RegionData& data);

/// What makes `data` not a valid region (see Region), or nothing. Evidence: `part`, `ring`, `vertex` (the start of the
/// first edge), the `other_` ones, and the position (not of a coordinate that is not finite); for polylines `ring` and
/// for points `vertex` count them, and `part` is not set. Of two edges the first is the one with the smaller number; of
/// two rings the first is the misplaced one: the hole, or the part inside another one, and its vertex a
/// lexicographically smallest one. Checks run in this order: coordinates; lengths, repeated vertices, area; crossings;
/// orientation; nesting. Exact. O(n log n) for n vertices.
struct Validation {
  std::optional<Error> error;
  std::vector<Point> touching_points;  ///< of the rings; only without an error
};
Validation validate(const RegionData& data);

/// The same, always by the sweep, whose answer `plainly_valid` saves in the common case.
Validation validate_in_full(const RegionData& data);

/// What a new region keeps for sums: nothing yet. Defined with PreparedRegion, of which regions know no more.
std::shared_ptr<PreparedRegion> not_yet_prepared();

/// What the rooms behind Region may do with it.
struct RegionInternals {
  static Region make(RegionData data, std::vector<Point> touching_points);
  /// What sums keep of the region, so that the next sum with it starts faster. Null for the default region.
  static PreparedRegion* prepared(const Region& region) { return region.prepared_.get(); }
};

/// Region made of data that are known to be valid, such as a reflected region, with the points at which its rings
/// touch.
Region trusted_region(RegionData data, std::vector<Point> touching_points);

}  // namespace dymsum::planar
