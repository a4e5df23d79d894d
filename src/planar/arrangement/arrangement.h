// Segments cut at their meetings, and the successor of every sub-edge that can be boundary. The generic case is the
// kill rule; every coincidence goes through the vertex routine. Lemmas 3-5: docs/design/planar-sum.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/poll.h"
#include "base/scratch.h"
#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

/// What bounds a sub-edge: the end of a segment at a pair of vertices, or its crossing with another segment.
struct SubEnd {
  bool pair = true;
  WalkPair at;
  std::uint32_t other = 0;
};

/// Sub-edges: segment s with k events has k + 1 sub-edges, numbered first_sub(s) + 0 .. k; sub-edge i starts at event i
/// - 1.
class Arrangement {
 public:
  Arrangement(const Soup& soup, Meetings meetings, const Chain& chain, const Array<CoveredMark>& covered_marks,
              const Poll* poll = nullptr);

  std::uint32_t sub_count() const { return first_event_.back() + static_cast<std::uint32_t>(soup_.size()); }
  std::uint32_t first_sub(std::uint32_t s) const { return first_event_[s] + s; }
  std::uint32_t event_count(std::uint32_t s) const { return first_event_[s + 1] - first_event_[s]; }

  /// The sub-edge that continues the boundary after `sub` (on segment s), or kNone where none does.
  struct Step {
    std::uint32_t sub = kNone, segment = kNone;
  };
  /// The successor map, with what it reads at hand: for those who walk all of it.
  class Walker {
   public:
    explicit Walker(const Arrangement& a)
        : first_event_(a.first_event_.data()),
          events_(a.events_.data()),
          sub_after_(a.sub_after_.data()),
          next_(a.chain_.next().data()),
          crossings_(a.meetings_.crossings.data()),
          flags_(a.flags_.data()),
          arrangement_(a) {}

    /// Sub-edges [begin, end) of a segment.
    std::uint32_t begin(std::uint32_t s) const { return first_event_[s] + s; }
    std::uint32_t end(std::uint32_t s) const { return first_event_[s + 1] + s + 1; }
    /// Goes on to the successor of a sub-edge; false where there is none: then the numbers are not to be used.
    bool advance(std::uint32_t& sub, std::uint32_t& segment) const {
      if (flags_[sub] & (kNoBoundary | kDegenerateEnd)) {
        const Step to = arrangement_.linked({sub, segment});
        sub = to.sub;
        segment = to.segment;
        return sub != kNone;
      }
      if (sub + 1 == end(segment)) {
        segment = next_[segment];
        if (segment == kNone) {
          sub = kNone;
          return false;
        }
        sub = begin(segment);
      } else {
        const std::uint32_t e = events_[sub - segment], a = crossings_[e].a;
        if (a == segment) {
          sub = kNone;
          return false;
        }
        sub = sub_after_[e];
        segment = a;
      }
      if (!(flags_[sub] & kNoBoundary)) return true;
      sub = kNone;
      return false;
    }
    bool ends_segment(Step at) const { return at.sub + 1 == end(at.segment); }
    /// Whether the boundary can come into `at` at its start.
    bool alive_at_start(Step at) const {
      const std::uint8_t f = flags_[at.sub];
      if (f & (kNoBoundary | kDegenerateStart)) return !(f & kNoBoundary) && f & kEntered;
      return at.sub == begin(at.segment) || crossings_[events_[at.sub - at.segment - 1]].a == at.segment;
    }

   private:
    const std::uint32_t *first_event_, *events_, *sub_after_, *next_;
    const Crossing* crossings_;
    const std::uint8_t* flags_;
    const Arrangement& arrangement_;
  };

  /// The node at which a sub-edge ends, if it is a degenerate one, or kNone.
  std::uint32_t end_node(Step at) const { return flags_[at.sub] & kDegenerateEnd ? linked_node(at) : kNone; }

  /// Whether a sub-edge is the last one of its segment.
  bool ends_segment(Step at) const { return at.sub == first_event_[at.segment + 1] + at.segment; }
  /// The ends of a sub-edge.
  SubEnd start_of(Step at) const {
    const std::uint32_t k = at.sub - first_sub(at.segment);
    return k > 0 ? event_end(at.segment, event(at.segment, k - 1)) : SubEnd{true, soup_.start(at.segment), 0};
  }
  SubEnd end_of(Step at) const {
    const std::uint32_t k = at.sub - first_sub(at.segment);
    if (k < event_count(at.segment)) return event_end(at.segment, event(at.segment, k));
    return {true, soup_.end(at.segment), 0};
  }
  SegmentPosition start_position(Step at) const;
  SegmentPosition end_position(Step at) const;
  /// An end of a sub-edge, rounded: |x - exact| and |y - exact| are at most error.
  struct RoundedEnd {
    double x = 0, y = 0, error = 0;
  };
  RoundedEnd rounded_end(Step at) const {
    const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
    const SoupBox& b = soup_.boxes[s];
    if (k == event_count(s)) return {b.bx, b.by, soup_.point_error};
    const std::uint32_t e = event(s, k);
    const double dx = soup_.dx(s), dy = soup_.dy(s), t = parameter(s, e);
    return {b.ax + t * dx, b.ay + t * dy, soup_.step_error(parameter_error(s, e), dx, dy)};
  }
  Cut start_cut(Step at) const;
  Cut end_cut(Step at) const;
  double start_parameter(Step at) const {
    const std::uint32_t k = at.sub - first_sub(at.segment);
    return k > 0 ? parameter(at.segment, event(at.segment, k - 1)) : 0;
  }
  double end_parameter(Step at) const {
    const std::uint32_t k = at.sub - first_sub(at.segment);
    return k < event_count(at.segment) ? parameter(at.segment, event(at.segment, k)) : 1;
  }
  /// A parameter strictly inside the sub-edge, or nothing where doubles do not decide.
  std::optional<double> inner_parameter(Step at) const;
  /// Some point strictly inside the sub-edge.
  SegmentPosition sample(Step at) const;
  SegmentPosition position_of_cut(std::uint32_t s, const Cut& cut, double t, double t_error) const;

  /// A degenerate node: a candidate for a tight point unless the boundary passes through it.
  struct Node {
    std::uint32_t index = 0;  ///< as in end_node, 1 .. degenerate_nodes()
    std::uint32_t segment = 0;
    SubEnd end;
    std::uint32_t sub_after = 0;  ///< the sub-edge of the segment that starts there, or the number after its last one
  };
  const Array<Node>& nodes() const { return nodes_; }
  SegmentPosition position_of(const Node& node) const;
  /// Sub-edges covered from both sides by coinciding segments, candidates for tight segments; each position once.
  const Array<Step>& covered_subs() const { return covered_subs_; }
  std::uint64_t degenerate_nodes() const { return degenerate_nodes_; }
  std::uint64_t exact_orders() const { return exact_orders_; }
  std::uint64_t crossing_count() const { return meetings_.crossings.size(); }
  const Array<Crossing>& crossings() const { return meetings_.crossings; }

 private:
  // An event of a segment is a crossing or a touch.
  static constexpr std::uint32_t kTouchBit = 0x80000000;
  enum Flag : std::uint8_t { kNoBoundary = 1, kDegenerateStart = 2, kDegenerateEnd = 4, kEntered = 8 };

  Step linked(Step from) const;
  std::uint32_t linked_node(Step at) const;
  void build_events(const Poll* poll);
  void sort_events(const Poll* poll);
  struct EventTimes;
  std::uint32_t sort_by_parameter(std::uint32_t segment, std::span<std::uint32_t> events, EventTimes& to) const;
  bool too_close(std::uint32_t segment, std::span<const std::uint32_t> events, const EventTimes& at, bool fine) const;
  void mark_covered(const Array<CoveredMark>& marks);
  void find_degenerate_nodes(const Poll* poll);
  struct Ray;
  struct Group;
  struct Spot;
  struct NodeBuffers;
  struct NodeClasses;
  void join_suspects(NodeClasses& nodes, const Poll* poll) const;
  void process_nodes(NodeClasses& nodes, const Poll* poll);
  void process_node(const Array<Spot>& spots, const Array<WalkPair>& pairs, NodeBuffers& buffers);
  void group_rays(NodeBuffers& buffers) const;
  void link_rays(NodeBuffers& buffers, const Node& where);
  std::pair<std::uint32_t, std::uint32_t> equal_run(std::uint32_t s, std::uint32_t k) const;
  double denominator(std::uint32_t s, const Cut& cut, double& relative_error) const;
  // The k-th event of segment s, k < event_count(s); its parameter and a bound on the parameter's error.
  std::uint32_t event(std::uint32_t s, std::uint32_t k) const { return events_[first_event_[s] + k]; }
  double parameter(std::uint32_t s, std::uint32_t event) const {
    if (event & kTouchBit) return meetings_.touches[event & ~kTouchBit].t;
    const Crossing& c = meetings_.crossings[event];
    return c.a == s ? c.ta : c.tb;
  }
  double parameter_error(std::uint32_t s, std::uint32_t event) const {
    if (event & kTouchBit) return meetings_.touches[event & ~kTouchBit].error;
    return soup_.parameter_error(s, other(s, event));
  }
  // The other segment of a crossing.
  std::uint32_t other(std::uint32_t s, std::uint32_t crossing) const {
    const Crossing& c = meetings_.crossings[crossing];
    return c.a == s ? c.b : c.a;
  }
  std::uint32_t position(std::uint32_t s, std::uint32_t event) const;
  Cut event_cut(std::uint32_t s, std::uint32_t event) const;
  SegmentPosition event_position(std::uint32_t s, std::uint32_t event) const;
  SubEnd event_end(std::uint32_t s, std::uint32_t event) const {
    if (event & kTouchBit) return {true, meetings_.touches[event & ~kTouchBit].pair, 0};
    return {false, {}, other(s, event)};
  }
  struct CutRatio;
  CutRatio cut_ratio(std::uint32_t s, std::uint32_t event) const;
  int compare_events(std::uint32_t s, std::uint32_t a, std::uint32_t b) const;

  const Soup& soup_;
  const Chain& chain_;
  Meetings meetings_;
  Array<std::uint32_t> first_event_;
  Array<std::uint32_t> events_;
  Array<std::uint32_t> sub_after_;  // per crossing: the sub-edge of its a that starts there, which continues b
  Array<std::uint8_t> flags_;       // per sub-edge
  struct Link {
    Step to;
    std::uint32_t node = 0;
  };
  KeyIndices linked_subs_;  // sub-edges with degenerate ends, where the boundary goes on,
  Array<Link> links_;       // and there
  Array<Node> nodes_;
  Array<Step> covered_subs_;
  Array<std::uint32_t> cut_segments_;  // those with events
  Array<std::uint32_t> suspects_;      // segments with touches, or with events that may coincide
  std::uint64_t degenerate_nodes_ = 0;
  mutable std::uint64_t exact_orders_ = 0;
};

}  // namespace dymsum::planar
