// The planar graph that the segments of a soup form when they are cut at all their meetings: nodes are positions, every
// edge stands for all sub-edges between its two nodes. Knows no convolution and decides nothing about sides.
#pragma once

#include <cstdint>
#include <span>

#include "base/memory_budget.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/crossings.h"
#include "planar/arrangement/soup.h"

namespace dymsum::planar {

class SegmentGraph {
 public:
  /// `meetings` holds all meetings of the soup.
  SegmentGraph(const Soup& soup, Meetings meetings);

  struct Node {
    SubEnd end;                 ///< as seen from `segment`
    std::uint32_t segment = 0;  ///< one that passes through
    std::uint32_t passes = 0;   ///< segments that pass through, start or end here
    SegmentPosition position;
  };
  /// Part of a segment between two neighbouring nodes on it.
  struct SubEdge {
    std::uint32_t from = 0, to = 0, segment = 0;
    std::uint32_t from_event = kNone, to_event = kNone;  ///< internal: kNone at the segment's ends
  };
  /// The sub-edges [first, last) between nodes low < high; they coincide.
  struct Edge {
    std::uint32_t low = 0, high = 0, first = 0, last = 0;
  };
  /// An edge as seen from a node: from its low to its high end, or backwards.
  struct Ray {
    std::uint32_t edge = 0;
    bool forward = true;
  };

  const base::CountedArray<Node>& nodes() const { return nodes_; }
  const base::CountedArray<SubEdge>& sub_edges() const { return sub_edges_; }
  const base::CountedArray<Edge>& edges() const { return edges_; }
  /// The rays of a node, counter-clockwise; their directions differ.
  std::span<const Ray> rays(std::uint32_t node) const {
    return {rays_.data() + first_ray_[node], rays_.data() + first_ray_[node + 1]};
  }
  /// The order of two rays of one node by direction, counter-clockwise from +x: -1, 0, 1.
  int compare(const Ray& a, const Ray& b) const;
  /// Whether a sub-edge runs from the low to the high node of its edge.
  static bool forward(const Edge& e, const SubEdge& s) { return s.from == e.low; }

  /// Some point strictly inside an edge, on the segment of its first sub-edge.
  SegmentPosition sample(std::uint32_t edge) const;
  std::uint64_t crossing_count() const { return meetings_.crossings.size(); }
  std::uint64_t exact_orders() const { return exact_orders_; }
  std::size_t bytes() const;

 private:
  // A crossing, or (behind the crossings) a touch, on one of its segments.
  struct Event {
    double t, error;
    std::uint32_t ref;
  };
  // A position on a segment: one of its ends or an event.
  struct Stop {
    SubEnd end;
    Cut cut;
    double t = 0, error = 0;
  };

  void build_events();
  void find_nodes();
  void find_edges();
  void find_rays();
  int compare_events(std::uint32_t s, const Event& a, const Event& b);
  WalkPair touched(const Event& e) const { return meetings_.touches[e.ref - meetings_.crossings.size()].pair; }
  bool is_touch(const Event& e) const { return e.ref >= meetings_.crossings.size(); }
  Stop stop(std::uint32_t s, const Event& e) const;
  Stop end_stop(std::uint32_t s, bool start) const;
  SegmentPosition position(std::uint32_t s, const Stop& stop) const;

  const Soup& soup_;
  Meetings meetings_;
  base::CountedArray<std::uint32_t> first_event_;
  base::CountedArray<Event> events_;
  base::CountedArray<Node> nodes_;
  base::CountedArray<SubEdge> sub_edges_;
  base::CountedArray<Edge> edges_;
  base::CountedArray<std::uint32_t> first_ray_;
  base::CountedArray<Ray> rays_;
  std::uint64_t exact_orders_ = 0;
};

}  // namespace dymsum::planar
