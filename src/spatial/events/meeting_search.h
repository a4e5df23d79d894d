// All exact points at which moving facets, facet edges and corners meet and that are not provably covered: between the
// scales of these the arrangement of the facets outside the open sum stays what it is.
#pragma once

#include <functional>
#include <vector>

#include "spatial/events/meeting_point.h"

namespace dymsum::spatial {

/// Scales between which facets move by about their own size.
std::vector<double> window_ends(const MovingFacets& all, double low, double high);

/// Features of one kind that are not deep inside the open sum, by where they are in a window of scales.
class LiveFeatures {
 public:
  LiveFeatures() = default;
  /// Features by their indices, and in the same positions their boxes.
  LiveFeatures(BoxTree tree, std::vector<std::uint32_t> features)
      : tree_(std::move(tree)), features_(std::move(features)) {}
  std::size_t size() const { return features_.size(); }
  std::uint32_t operator[](std::size_t position) const { return features_[position]; }
  const Box& box(std::uint32_t position) const { return tree_.box(position); }
  /// Calls f(feature) for those that may come near a box; f(position).
  template <class F>
  void for_each(const Box& box, F f) const {
    tree_.for_each(box, [&](std::uint32_t k) { f(features_[k]); });
  }
  template <class F>
  void for_each_position(const Box& box, F f) const {
    tree_.for_each(box, f);
  }

 private:
  BoxTree tree_;
  std::vector<std::uint32_t> features_;
};

struct Meetings {
  std::vector<MeetingEvent> points;  ///< each once
  LiveFeatures facets;
  std::uint64_t candidates = 0, exact = 0;
};

/// The meetings at scales from `low` to `high`. `query` is called now and then, and may throw.
Meetings find_meetings(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high,
                       const std::function<void()>& query);

}  // namespace dymsum::spatial
