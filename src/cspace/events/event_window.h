// The window of angles between two exact ones: its segments, and the pairs of them that may meet.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/window/rotating_window.h"

namespace dymsum::planar {

/// t in (t_low, t_high] of a chart.
struct RotationRange {
  int chart = 0;
  double t_low = 0, t_high = 0;
  double theta(double t) const { return 2 * std::atan(t) + (chart == 1 ? std::numbers::pi : 0.0); }
};

class EventWindow : public RotatingWindow {
 public:
  EventWindow(const RotationGrid& grid, const RotationCatalog& catalog, const RotationRange& range, bool mask);

  /// Segments of which pieces may meet, a < b.
  struct SegmentPair {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const SegmentPair&, const SegmentPair&) = default;
  };
  RotationRange range;
  double low = 0, high = 0;               ///< angles, rounded outwards
  base::CountedArray<SegmentPair> pairs;  ///< sorted

  /// Whether two segments are a pair. Requires a < b. By the few pairs of a.
  bool meet(std::uint32_t a, std::uint32_t b) const;

 private:
  void sort_pairs();
  std::vector<std::uint32_t> pairs_of_;  // those of segment a are pairs[pairs_of_[a] .. pairs_of_[a + 1])
};

}  // namespace dymsum::planar
