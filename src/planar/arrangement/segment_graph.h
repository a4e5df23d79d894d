// The planar graph that the segments of a soup form when they are cut at all their meetings: nodes are positions, every
// edge stands for all sub-edges between its two nodes. Knows no convolution and decides nothing about sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

// Rays to the right through the segments of a soup: which ones they pass, exactly. Segments are listed by rows of their
// heights, so that a ray looks at those of its row alone.

class RayRows {
 public:
  /// O(n): a segment counts in all rows that it reaches, about 8 n in all.
  explicit RayRows(const Soup& soup);

  /// Calls f(segment, by) for those that the ray to +x passes which starts at x moved infinitely little to the right of
  /// its segment, then infinitely less ahead: `by` is 1 for a segment that runs up, which goes around counter-clockwise
  /// what lies left of it, and -1 for one that runs down. Requires: x is no node.
  template <class F>
  void for_each_passed(const SegmentPosition& x, F&& f) const {
    const Lattice& lattice = soup_.lattice;
    const Point d = lattice.vector(x.on.edge);
    // The sign of the height of a vertex over x where that height is zero.
    const int tie = d.x != 0 ? (d.x > 0 ? 1 : -1) : (d.y > 0 ? -1 : 1);
    const auto height = [&](WalkPair v) {
      const int h = lattice.compare_coordinate(soup_.exact(v), x, 1);
      return h != 0 ? h : tie;
    };
    const double margin = x.error + margin_;
    // A row's segments reach it with the margin of their ends; the position errs by its own.
    const std::size_t low = row(x.y - x.error), high = row(x.y + x.error);
    for (std::size_t r = low; r <= high; ++r)
      for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k) {
        const std::uint32_t s = listed_[k];
        const SoupBox& b = soup_.boxes[s];
        const double bottom = std::min(b.ay, b.by), top = std::max(b.ay, b.by);
        if (std::max(low, row(bottom - margin_)) != r) continue;  // each in one row
        if (top < x.y - margin || bottom > x.y + margin || std::max(b.ax, b.bx) < x.x - margin) continue;
        const int from = height(soup_.start(s)), to = height(soup_.end(s));
        if (from == to) continue;
        int side = lattice.side(soup_.exact(s), x);
        if (side == 0) side = -lattice.dot(soup_.exact(s).edge, x.on.edge);
        if (side == 0) side = lattice.cross(soup_.exact(s).edge, x.on.edge);
        // An upward segment is passed from its left, a downward one from its right.
        if (side == to) f(s, to);
      }
  }

 private:
  std::size_t row(double y) const {
    const double r = (y - low_) * per_row_;
    return r <= 0 ? 0 : r >= last_ ? static_cast<std::size_t>(last_) : static_cast<std::size_t>(r);
  }

  const Soup& soup_;
  double low_ = 0, per_row_ = 0, last_ = 0, margin_ = 0;
  base::CountedArray<std::uint32_t> first_, listed_;
};

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
