// The points at which features meet in a window of scales, each once, and what is known to be covered.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "spatial/events/meeting_point.h"
#include "spatial/events/proved_overlap.h"

namespace dymsum::spatial {

struct MeetingEvent {
  ExactMeeting at;
  NearMeeting near;
};

class MeetingList {
 public:
  /// A list of meetings at scales from `low` to `high`, of a sum of that span. Keeps the reference.
  MeetingList(const ScaledOverlap& overlap, double low, double high, double span)
      : overlap_(overlap), low_(low), high_(high), span_(span) {}

  bool is_beside_window(const NearMeeting& at) const { return at.s < low_ - at.s_radius || at.s > high_ + at.s_radius; }
  /// Whether the doubles of an exact point are in the window.
  bool is_in_window(const NearMeeting& at) const {
    return at.s >= low_ * (1 - 0x1p-50) && at.s <= high_ * (1 + 0x1p-50);
  }
  /// Whether all of the cell of (x, s) around a point provably lies in the open sum. Many tuples meet in one point, and
  /// query it.
  bool is_covered(const NearMeeting& at);
  /// Lists a point unless it is not in the window, provably covered or listed already.
  void add(ExactMeeting at);
  std::vector<MeetingEvent> take() { return std::move(found_); }

 private:
  using GridCell = std::array<std::int64_t, 4>;
  struct GridCellHash {
    std::size_t operator()(const GridCell& cell) const {
      std::uint64_t h = 0;
      for (const std::int64_t c : cell) {
        h ^= static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
        h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 29;
      }
      return h;
    }
  };

  const ScaledOverlap& overlap_;
  double low_, high_, span_;
  std::vector<MeetingEvent> found_;
  std::unordered_multimap<GridCell, std::size_t, GridCellHash> found_at_;  // by their doubles
  std::unordered_map<GridCell, bool, GridCellHash> covered_;  // small cells of (x, s), provably or perhaps not
  std::unordered_set<GridCell, GridCellHash> covered_at_;     // doubles of points that provably are
};

}  // namespace dymsum::spatial
