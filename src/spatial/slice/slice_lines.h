// The lines along which facets cut a slice.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "spatial/slice/slice_plane.h"

namespace dymsum::spatial {

/// What is known of all segments with one cut.
struct CutLine {
  /// 1 or -1: they belong to facets through the plane whose normals are all the cut's, or all opposite to it; 0 for
  /// others.
  std::int8_t side = 0;
  /// No segment with another cut lies on the same line.
  bool alone = true;
  bool frame = false;
};

/// By cut. O(n) exact hashes for n cuts.
std::unordered_map<PlaneId, CutLine> cut_lines(const SlicePlane& plane);

}  // namespace dymsum::spatial
