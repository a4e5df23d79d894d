// Segments cut at their meetings, and the successor of every sub-edge that can be boundary. The generic case is the kill rule; every
// coincidence goes through the vertex routine. Lemmas 3-5: docs/design/planar-sum.md.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <unordered_map>
#include <vector>

#include "planar/crossings.h"
#include "planar/soup.h"

namespace dymsum::planar {

/// What bounds a sub-edge: the end of a segment at a pair of vertices, or its crossing with another segment.
struct SubEnd {
  bool pair = true;
  WalkPair at;
  std::uint32_t other = 0;
};

/// Sub-edges: segment s with k events has k + 1 sub-edges, numbered first_sub(s) + 0 .. k; sub-edge i starts at event i - 1.
class Arrangement {
 public:
  Arrangement(const Soup& soup, Meetings meetings, const Chain& chain, const Array<DeadMark>& dead_marks);

  std::uint32_t sub_count() const { return first_event_.back() + static_cast<std::uint32_t>(soup_.size()); }
  std::uint32_t first_sub(std::uint32_t s) const { return first_event_[s] + s; }
  std::uint32_t event_count(std::uint32_t s) const { return first_event_[s + 1] - first_event_[s]; }
  std::uint32_t segment_of(std::uint32_t sub) const;

  /// The sub-edge that continues the boundary after `sub` (on segment s), or kNone when `sub` is dead.
  struct Step {
    std::uint32_t sub = kNone, segment = kNone;
  };
  Step successor(Step from) const;
  /// Whether the boundary can come into `sub` at its start.
  bool alive_at_start(Step at) const;

  /// The node at which a sub-edge ends, if it is a degenerate one, or kNone.
  std::uint32_t end_node(Step at) const;

  /// Where a sub-edge starts and ends.
  SubEnd start_of(Step at) const;
  SubEnd end_of(Step at) const;
  Place start_place(Step at) const;
  Place end_place(Step at) const;
  /// Where a sub-edge ends, rounded: |x - exact| and |y - exact| are at most error.
  struct RoundedEnd {
    double x = 0, y = 0, error = 0;
  };
  RoundedEnd rounded_end(Step at) const;
  Cut start_cut(Step at) const;
  Cut end_cut(Step at) const;
  double start_parameter(Step at) const;
  double end_parameter(Step at) const;
  /// Some point strictly inside the sub-edge.
  Place sample(Step at) const;
  Place place(std::uint32_t s, const Cut& cut, double t, double t_error) const;

  /// A degenerate node: a candidate for a tight point unless the boundary passes through it.
  struct Node {
    std::uint32_t number = 0;  ///< as in end_node
    std::uint32_t segment = 0;
    SubEnd end;
    Place place;
  };
  const Array<Node>& nodes() const { return nodes_; }
  /// Sub-edges covered from both sides by coinciding segments, candidates for tight segments; each place once.
  const Array<Step>& covered_subs() const { return covered_subs_; }
  std::uint64_t degenerate_nodes() const { return degenerate_nodes_; }
  std::uint64_t exact_orders() const { return exact_orders_; }
  std::uint64_t crossing_count() const { return meetings_.crossings.size(); }
  const Array<Crossing>& crossings() const { return meetings_.crossings; }
  std::size_t bytes() const;
  bool sub_dead(std::uint32_t sub) const { return flags_[sub] & kDead; }

 private:
  // An event refers to a crossing (and which of its two segments this is) or to a touch.
  struct Event {
    double t;
    float error;
    std::uint32_t ref;
  };
  static constexpr std::uint32_t kTouchBit = 0x80000000;
  enum Flag : std::uint8_t { kDead = 1, kDegenerateStart = 2, kDegenerateEnd = 4, kEntered = 8 };

  void build_events();
  void sort_events();
  void mark_dead(const Array<DeadMark>& marks);
  void find_degenerate_nodes();
  struct Ray;
  struct Spot;
  void process_node(const Array<Spot>& spots, const Array<WalkPair>& pairs);
  void link_rays(Array<Ray>& rays, const Node& where);
  std::pair<std::uint32_t, std::uint32_t> equal_run(std::uint32_t s, std::uint32_t k) const;
  double denominator(std::uint32_t s, const Cut& cut, double& relative_error) const;
  double step_error(double t_error, double dx, double dy) const;
  Cut event_cut(const Event& e, std::uint32_t segment) const;
  SubEnd event_end(const Event& e, std::uint32_t segment) const;
  int compare_events(std::uint32_t s, const Event& a, const Event& b) const;
  bool is_a(const Event& e, std::uint32_t s) const { return meetings_.crossings[e.ref].a == s; }

  const Soup& soup_;
  const Chain& chain_;
  Meetings meetings_;
  Array<std::uint32_t> first_event_;
  Array<Event> events_;
  struct Positions {
    std::uint32_t a, b;  // event indices within the two segments
  };
  Array<Positions> positions_;  // per crossing
  Array<std::uint8_t> flags_;   // per sub-edge
  struct Link {
    Step to;
    std::uint32_t node = 0;
  };
  std::pmr::unordered_map<std::uint32_t, Link> links_;  // at degenerate ends
  Array<Node> nodes_;
  Array<Step> covered_subs_;
  Array<std::uint32_t> suspects_;  // segments with touches, or with events that may coincide
  std::uint64_t degenerate_nodes_ = 0;
  mutable std::uint64_t exact_orders_ = 0;
};

}  // namespace dymsum::planar
