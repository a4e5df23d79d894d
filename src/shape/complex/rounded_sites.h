// Sites with coordinates of few bits, for a diagram that needs no more than to be close.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/complex/walks.h"

namespace dymsum::shape {

struct RoundedPoint {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const RoundedPoint&, const RoundedPoint&) = default;
};

struct RoundedSegment {
  RoundedPoint a, b;  ///< a < b
  std::uint32_t site = 0;
  friend auto operator<=>(const RoundedSegment&, const RoundedSegment&) = default;
};

struct RoundedSites {
  std::vector<RoundedPoint> points;      ///< per boundary point
  std::vector<RoundedSegment> segments;  ///< of the edges whose ends differ, in order
  int bits = 0;
  bool lossless = false;  ///< they are the sites themselves, scaled
};

inline constexpr int kMostBits = 30;

/// Requires: bits at most kMostBits.
RoundedSites round_sites(const Walks& walks, int bits);

/// Whether no two of the segments have more in common than an end of both, or the whole. Exact; O(n log n) in practice.
bool is_planar(const RoundedSites& sites);

}  // namespace dymsum::shape
