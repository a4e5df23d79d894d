// A range of angles with one set of segments: those that are not inside the obstacle at every angle of it, and the
// pairs of them that may meet.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "planar/turning/rotating_window.h"

namespace dymsum::planar {

/// t in (t_low, t_high] of a chart.
struct TurnRange {
  int chart = 0;
  double t_low = 0, t_high = 0;
  double theta(double t) const { return 2 * std::atan(t) + (chart == 1 ? std::numbers::pi : 0.0); }
};

class TurnWindow {
 public:
  TurnWindow(const TurnGrid& base, const TurnCatalog& catalog, const TurnRange& range, bool mask);

  /// A pair of segments that may meet outside dead cells, a < b, by their numbers here. Pairs with a common end meet
  /// nowhere else and are left out.
  struct Meeting {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const Meeting&, const Meeting&) = default;
  };
  TurnRange range;
  double low = 0, high = 0, middle = 0, half = 0;  ///< angles, rounded outwards
  Heading heading;                                 ///< of the middle
  std::vector<WalkSegment> segments;
  std::vector<Meeting> meetings;        ///< sorted
  std::vector<std::uint32_t> first_of;  ///< those of segment a are meetings[first_of[a] .. first_of[a + 1])
  std::vector<Point> turned;            ///< vertices of the turning operand at the middle, about its centre
  std::size_t all_segments = 0;         ///< before the mask

  /// Whether two segments are a meeting. Requires a < b. By the few meetings of a.
  bool meet(std::uint32_t a, std::uint32_t b) const;

 private:
  void sort_meetings();
};

}  // namespace dymsum::planar
