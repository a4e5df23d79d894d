// The full turn in ranges of angles, each with its window and the events that may happen in it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cspace/events/crossing_orders.h"
#include "cspace/events/near_angle.h"

namespace dymsum::planar {

/// A window with its events.
struct PreparedWindow {
  RotationRange range;
  std::unique_ptr<EventWindow> window;
  std::unique_ptr<OverlapFilter> filter;
  RotationEvents found;
  std::optional<CrowdedEnd> at_end;  ///< where it ends with a crowded quarter turn
};

/// Ranges of angles one after the other, with their windows and events. Several may be prepared at a time.
class EventWindows {
 public:
  /// `reference`: all events, none left out.
  EventWindows(const TurningForms& forms, const RotationCatalog& catalog, bool reference);

  int count() const { return 2 * per_half_turn_; }
  RotationRange range_of(int k) const;
  enum class Halved : std::uint8_t { where_crowded, always };
  /// One window or, where the range is halved, several. `again` is called now and then: it throws to stop.
  std::vector<PreparedWindow> prepare(
      int k, Halved halved, const std::function<void()>& again = [] {}) const;

 private:
  void add(const RotationRange& range, int depth, Halved halved, const std::function<void()>& again,
           std::vector<PreparedWindow>& parts) const;
  void add_parts(const RotationRange& range, Halved halved, const std::function<void()>& again,
                 std::vector<PreparedWindow>& parts) const;
  bool beside_crowd(const RotationRange& range) const;
  /// An angle at which more edges are aligned than there are, but for a rounding.
  struct NearCrowd {
    NearAngle angle;
    RotationRange range;  ///< around it
    double per_edge = 0;
    std::optional<Alignment> exactly;  ///< a pair of edges that is aligned at the angle itself, a quarter turn
  };
  void find_near_crowds();
  const NearCrowd* around(const RotationRange& range) const;
  const NearCrowd* beside(const RotationRange& range) const;

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  bool reference_;
  double pairs_;
  int per_half_turn_;
  std::vector<Alignment> all_;
  std::optional<CrowdedQuarters> crowded_;
  std::vector<NearCrowd> near_;
  std::optional<RotationGrid> grid_;
};

}  // namespace dymsum::planar
