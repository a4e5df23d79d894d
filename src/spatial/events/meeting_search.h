// All exact points at which moving facets, facet edges and corners meet and that are not provably covered: between the
// scales of these the arrangement of the facets outside the open sum stays what it is.
#pragma once

#include <functional>
#include <vector>

#include "spatial/events/meeting_point.h"
#include "spatial/events/proved_overlap.h"

namespace dymsum::spatial {

struct MeetingEvent {
  ExactMeeting at;
  NearMeeting near;
};

/// Scales between which facets move by about their own size.
std::vector<double> window_ends(const MovingFacets& all, double low, double high);

/// Facets that may come near a box at some scales of a window, but for those deep inside the open sum.
class LiveFacets {
 public:
  LiveFacets(BoxTree tree, std::vector<std::uint32_t> facets) : tree_(std::move(tree)), facets_(std::move(facets)) {}
  template <class F>
  void for_each(const Box& box, F f) const {
    tree_.for_each(box, [&](std::uint32_t k) { f(facets_[k]); });
  }

 private:
  BoxTree tree_;
  std::vector<std::uint32_t> facets_;
};

struct Meetings {
  std::vector<MeetingEvent> points;  ///< each once
  LiveFacets facets;
  std::uint64_t candidates = 0, exact = 0;
};

/// At scales from `low` to `high`. `query` is called now and then, and may throw.
Meetings find_meetings(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high,
                       const std::function<void()>& query);

}  // namespace dymsum::spatial
