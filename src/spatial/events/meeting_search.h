// All exact points at which moving facets, borders and corners meet and that are not surely covered: between the scales
// of these the arrangement of the facets outside the open sum stays what it is.
#pragma once

#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "spatial/events/meeting_point.h"
#include "spatial/events/scaled_overlap.h"

namespace dymsum::spatial {

struct MeetingEvent {
  ExactMeeting at;
  NearMeeting near;
};

/// Scales between which facets move by about their own size.
std::vector<double> window_ends(const MovingFacets& all, double low, double high);

class EventSearch {
 public:
  EventSearch(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high);

  /// The points at scales from `low` to `high`, each once. `ask` is called now and then, and may
  /// throw.
  std::vector<MeetingEvent> run(const std::function<void()>& ask);
  /// Facets that may come near a box at some of these scales, but for those deep inside the open sum.
  template <class F>
  void for_each_facet(const Box& box, F f) const {
    facets_.for_each(box, [&](std::uint32_t k) { f(live_[k]); });
  }
  std::uint64_t candidates() const { return candidates_; }
  std::uint64_t exact() const { return exact_; }

 private:
  using Cell = std::array<std::int64_t, 4>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  void corners_on_facets();
  void corners_on_borders();
  void borders_on_borders();
  void lasting_crossing(std::uint32_t e, std::uint32_t g);
  bool bounds_plane(std::uint32_t border, std::uint32_t name) const;
  void borders_through_facets();
  void four_facets();
  void facet_neighbours();
  bool may_cross(std::uint32_t f, std::uint32_t g) const;
  bool is_covered(const NearMeeting& at);
  void add(ExactMeeting at);
  /// Four hyperplanes by their names, in order.
  using PlaneNames = std::array<std::uint32_t, 4>;
  struct PlaneNamesHash {
    std::size_t operator()(const PlaneNames& names) const;
  };
  /// What needs not to be asked again of four hyperplanes, whatever facets and borders lie in them.
  enum class Common : std::uint8_t {
    open,     ///< a point outside of what is looked at, perhaps
    lasting,  ///< no one point in common
    done,     ///< the point is listed, covered, or at no scale of the window
  };
  template <class MayHold, class Holds>
  Common four_planes(PlaneNames names, const std::array<const PlaneRow*, 4>& rows,
                     const std::array<const MovingPlane*, 4>& planes, MayHold may_hold, Holds holds);
  bool is_in_window(const NearMeeting& at) const;
  template <class Exact>
  void decide(Meets meets, const NearMeeting& near, Exact exact);
  void ask_now_and_then() {
    if (++asked_ % 4096 == 0 && ask_) (*ask_)();
  }
  Box swept(SumPoint corner) const;
  Box swept(std::span<const SumPoint> corners) const;

  const MovingFacets& all_;
  const ScaledOverlap& overlap_;
  double low_, high_, span_, room_;
  std::vector<std::uint32_t> live_, live_borders_, live_corners_;  // facets and so on that are not deep inside
  BoxTree facets_, borders_, corners_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  // of live facets, with larger indices, sorted
  std::vector<MeetingEvent> found_;
  std::unordered_multimap<Cell, std::size_t, CellHash> found_at_;  // by their doubles
  std::unordered_map<Cell, bool, CellHash> covered_;               // small cells of (x, s), surely or perhaps not
  std::unordered_set<Cell, CellHash> covered_at_;                  // doubles of points that surely are
  std::unordered_map<PlaneNames, Common, PlaneNamesHash> known_;   // not those that are open
  const std::function<void()>* ask_ = nullptr;
  std::uint64_t candidates_ = 0, exact_ = 0, asked_ = 0;
};

}  // namespace dymsum::spatial
