// The arrangement of the live segments of a sum while its operands are edited: segments with the events along them in
// order, kept under insertion and removal. docs/design/edited-sum.md, "Arrangement".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planar/arrangement/crossings.h"
#include "planar/edit/counted_cover.h"
#include "planar/edit/followed_convolution.h"
#include "planar/edit/segment_cuts.h"
#include "planar/edit/walk_changes.h"

namespace dymsum::planar {

/// The k-th sub-edge of a segment: it ends at the segment's k-th event, or at its end.
struct LiveSubEdge {
  std::uint32_t segment = kNone, k = 0;
  friend bool operator==(const LiveSubEdge&, const LiveSubEdge&) = default;
};

/// An event of a segment by its id, which stays while the event does; or an end of the segment.
struct EventName {
  static constexpr std::uint32_t kStart = 0xfffffffe, kEnd = 0xffffffff;
  std::uint32_t segment = kNone, id = kStart;
  std::uint64_t key() const { return std::uint64_t{segment} << 32 | id; }
  friend bool operator==(const EventName&, const EventName&) = default;
};

/// All that meets at a position where more happens than two segments crossing.
struct EditNode {
  struct Ray {
    LiveSubEdge sub;
    bool out = false;
  };
  std::vector<Ray> rays;
  std::vector<EventName> names;  ///< of the position on each segment there
  std::uint64_t key = 0;         ///< the least of these, as numbers
};

/// How the boundary goes on at a node: links from sub-edges that arrive to those that leave; and sub-edges that leave
/// and are covered from both sides.
struct LiveNodeLinks {
  std::vector<std::pair<LiveSubEdge, LiveSubEdge>> links;
  std::vector<LiveSubEdge> cracks;
};

class EditArrangement {
 public:
  /// Marks of sub-edges: which cycle passes. Cycles have numbers from kFirstCycle on.
  static constexpr std::uint32_t kNoCycle = 0, kFresh = 1, kFirstCycle = 2;

  EditArrangement(const PlacedPair& placed, const FollowedConvolution& convolution, const CountedCover& cover);
  EditArrangement(const EditArrangement&) = delete;

  // Steps of an edit, in this order.

  /// Takes segments out that the edit does not leave as they were. Requires: the operands and the convolution before.
  void remove_changed(const std::array<WalkChanges, 2>& changes, const FollowedConvolution& after);
  /// What stays gets its new names, on the new lattice; and its new numbers, where these are `elsewhere`: the lattice
  /// begins at another position or spans another length.
  void rename(const PlacedPair& placed, const FollowedConvolution& after, const std::array<WalkChanges, 2>& changes,
              bool elsewhere);
  /// Puts new segments in, and segments in cells that are covered no longer, and finds what they meet.
  void add_changed(const std::array<WalkChanges, 2>& changes, std::span<const GridCell> uncovered);

  // The arrangement.

  const Soup& soup() const { return *soup_; }
  std::size_t live_count() const { return live_.size(); }
  std::size_t crossing_count() const { return crossings_.size() - free_crossings_.size(); }
  std::size_t node_count() const { return pairs_.size(); }
  const FollowedConvolution& convolution() const { return *convolution_; }

  std::uint32_t event_count(std::uint32_t s) const { return static_cast<std::uint32_t>(slots_[s].events.size()); }
  std::uint32_t mark(LiveSubEdge at) const { return slots_[at.segment].marks[at.k]; }
  void set_mark(LiveSubEdge at, std::uint32_t mark) { slots_[at.segment].marks[at.k] = mark; }
  /// The sub-edge that starts at an event, or kNone where that is gone.
  LiveSubEdge sub_from(EventName start) const;
  EventName start_name(LiveSubEdge at) const {
    return {at.segment, at.k == 0 ? EventName::kStart : slots_[at.segment].events[at.k - 1].id};
  }
  bool ends_segment(LiveSubEdge at) const { return at.k == event_count(at.segment); }
  /// What bounds a sub-edge, its parameter and the parameter's error.
  struct End {
    SubEnd end;
    double t = 0, error = 0;
  };
  End start_of(LiveSubEdge at) const {
    return at.k == 0 ? segment_end(at.segment, 0) : event_end(at.segment, at.k - 1);
  }
  End end_of(LiveSubEdge at) const {
    return ends_segment(at) ? segment_end(at.segment, 1) : event_end(at.segment, at.k);
  }
  SegmentPosition position(const End& end, std::uint32_t segment) const {
    return position_of_cut(*soup_, segment, cut_of(*soup_, end.end), end.t, end.error);
  }
  SegmentPosition sample(LiveSubEdge at) const;

  /// Where the boundary goes on after a sub-edge; kNone where it does not.
  LiveSubEdge next(LiveSubEdge at);
  /// The node at which a sub-edge ends, if it ends at one.
  std::optional<EditNode> end_node(LiveSubEdge at) const;
  /// The node at a named position, if it still is one.
  std::optional<EditNode> node_at(EventName name) const;
  LiveNodeLinks links_of(const EditNode& node) const;
  SegmentPosition position_of(EventName name) const;

  // What the last edit changed.

  /// Marks of sub-edges that are no longer what they were.
  std::vector<std::uint32_t> take_broken() { return std::exchange(broken_, {}); }
  /// Segments with sub-edges that are marked kFresh.
  std::vector<std::uint32_t> take_fresh();
  /// Nodes that changed or are gone, and those that are new or as they are now.
  std::vector<std::uint64_t> take_old_nodes() { return std::exchange(old_nodes_, {}); }
  std::vector<EditNode> take_new_nodes() { return std::exchange(new_nodes_, {}); }

  struct Work {
    std::uint64_t removed = 0, added = 0, pairs = 0, events = 0, exact_signs = 0;
  };
  const Work& work() const { return work_; }

 private:
  static constexpr std::uint32_t kTouchBit = 0x80000000;
  struct Event {
    double t;
    std::uint32_t id;
  };
  struct Slot {
    std::vector<Event> events;
    std::vector<std::uint32_t> marks;
    std::vector<std::uint32_t> cells;  // in whose lists it is
    std::uint32_t prev = kNone;
    std::array<std::uint32_t, 2> next_of{kNone, kNone}, prev_of{kNone, kNone};  // of its edge, of its vertex
    bool alive = false, suspect = false, start_node = false, end_node = false, fresh = false;
  };
  struct PairMeetings {
    WalkPair pair;
    std::vector<std::uint32_t> touches;
    std::vector<std::uint64_t> same;
  };
  class LiveChain final : public Chain {
   public:
    explicit LiveChain(const EditArrangement& all) : Chain(nullptr), all_(all) {}
    void incident(WalkPair v, Array<Incidence>& out) const override;
    Array<std::uint32_t>& links() { return next_; }

   private:
    const EditArrangement& all_;
  };
  struct Spot {
    std::uint32_t segment, begin, end;
  };
  struct NodeSearch;

  static std::uint64_t key(const WalkSegment& s) {
    return std::uint64_t{s.side} << 62 | std::uint64_t{s.edge} << 31 | s.vertex;
  }
  static std::uint64_t key(WalkPair v) { return std::uint64_t{v.p} << 32 | v.q; }
  WalkSegment name(std::uint32_t s) const {
    const SoupSegment& g = soup_->segments[s];
    return {g.side(), g.edge(), g.vertex};
  }
  std::uint32_t find_live(const WalkSegment& s) const {
    const auto it = live_.find(key(s));
    return it == live_.end() ? kNone : it->second;
  }
  std::optional<WalkSegment> follower(const WalkSegment& s) const;
  std::optional<WalkSegment> predecessor(const WalkSegment& s) const;
  std::vector<Incidence> incident(WalkPair v) const;

  // The first segments of an edge of `side`, of a vertex of the other operand.
  std::uint32_t& first_of_edge(std::uint32_t side, std::uint32_t edge) { return first_of_[side][edge]; }
  std::uint32_t& first_of_vertex(std::uint32_t side, std::uint32_t vertex) { return first_of_[2 + side][vertex]; }
  void list(std::uint32_t s);
  void unlist(std::uint32_t s);
  void list_all();

  // Segments.
  std::uint32_t add(const WalkSegment& s);
  void remove(std::uint32_t s);
  void relink();
  void set_next(std::uint32_t s, std::uint32_t next);
  bool stays(std::uint32_t s, const std::array<WalkChanges, 2>& changes, const FollowedConvolution& after) const;
  bool has_live_cell(const SoupBox& box) const;
  void add_missing(const WalkSegment& w);
  std::vector<std::uint32_t> gone(const std::array<WalkChanges, 2>& changes, const FollowedConvolution& after);
  void open_cells(std::span<const GridCell> cells);
  template <class F>
  void for_each_cell(const SoupBox& b, F&& f) const;

  void rename_indices(const std::array<WalkChanges, 2>& changes);
  void round_again();

  // Events.
  void find_meetings();
  void add_crossing(const Crossing& c);
  void add_touch(const Touch& t);
  void add_same(WalkPair a, WalkPair b);
  PairMeetings& meetings_at(WalkPair v);
  void drop_pair(WalkPair v);
  std::uint32_t insert_event(std::uint32_t s, Event e);
  void erase_event(std::uint32_t s, std::uint32_t id);
  std::uint32_t index_of(std::uint32_t s, std::uint32_t id) const;
  bool has_crossing(std::uint32_t a, std::uint32_t b) const;
  bool close(std::uint32_t s, std::uint32_t k) const;
  int compare(std::uint32_t s, const Event& a, const Event& b) const;
  double error(std::uint32_t s, std::uint32_t id) const {
    return id & kTouchBit ? touches_[id & ~kTouchBit].error : soup_->parameter_error(s, other(s, id));
  }
  std::uint32_t other(std::uint32_t s, std::uint32_t id) const {
    return crossings_[id].a == s ? crossings_[id].b : crossings_[id].a;
  }
  SubEnd sub_end(std::uint32_t s, std::uint32_t id) const {
    if (id & kTouchBit) return {true, touches_[id & ~kTouchBit].pair, 0};
    return {false, {}, other(s, id)};
  }
  End event_end(std::uint32_t s, std::uint32_t k) const {
    const Event& e = slots_[s].events[k];
    return {sub_end(s, e.id), e.t, error(s, e.id)};
  }
  End segment_end(std::uint32_t s, double t) const {
    return {{true, t == 0 ? soup_->start(s) : soup_->end(s), 0}, t, 0};
  }
  void freshen(std::uint32_t s, std::uint32_t k);

  // Nodes.
  Spot equal_run(std::uint32_t s, std::uint32_t k) const;
  bool degenerate(std::uint32_t s, std::uint32_t k) const;
  void search(NodeSearch& found) const;
  std::optional<EditNode> node_of(NodeSearch& found) const;
  void unsettle(const EditNode& node);
  void unsettle_nodes_of(std::uint32_t s);
  void settle_nodes();

  std::optional<Soup> soup_;
  const FollowedConvolution* convolution_;
  const CountedCover& cover_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_;
  std::unordered_map<std::uint64_t, std::uint32_t> live_;
  std::array<std::vector<std::uint32_t>, 4> first_of_;
  LiveChain chain_;
  std::vector<std::uint32_t> relink_;
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
  std::vector<std::array<std::uint32_t, 2>> candidates_;

  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> free_crossings_;
  std::vector<Touch> touches_;
  std::vector<std::uint32_t> free_touches_;
  std::unordered_map<std::uint64_t, PairMeetings> pairs_;

  std::unordered_map<std::uint64_t, LiveSubEdge> links_;  // of nodes that were looked at since the last change
  std::vector<std::uint32_t> broken_, fresh_;
  std::vector<EventName> unsettled_;
  std::vector<std::uint64_t> old_nodes_;
  std::vector<EditNode> new_nodes_;
  Work work_;
};

}  // namespace dymsum::planar
