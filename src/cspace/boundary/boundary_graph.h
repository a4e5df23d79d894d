// The boundary of the slice while the angle grows, as a graph: visible sub-edges are nodes, linked into loops, and each
// loop has the free cell on its right. It knows no geometry: what changes at an angle is planned by others, as an edit,
// and applied here.
//
// Invariants between edits, of the nodes that are alive:
// - links are mutual, and `left` and `right` are the segments of the linked nodes;
// - the nodes of a segment are the list that begins at first_on();
// - the nodes of one loop have one cell, which no other loop has and which has not ended.
// A node whose neighbours change ends, and another one begins with the same segment: nodes are patches of the obstacle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/scratch.h"
#include "cspace/events/exact_position.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

// Segments by index: those of edges of the fixed operand first, then those of edges of the turning one.

class SegmentIndex {
 public:
  /// How many vertices the walks of the operands have.
  SegmentIndex(std::uint32_t fixed, std::uint32_t turning) : n0_(fixed), n1_(turning) {}
  std::size_t count() const { return std::size_t{2} * n0_ * n1_; }
  std::uint32_t of(const WalkSegment& s) const {
    return s.side == 0 ? s.edge * n1_ + s.vertex : n0_ * n1_ + s.edge * n0_ + s.vertex;
  }
  WalkSegment segment(std::uint32_t index) const {
    if (index < n0_ * n1_) return {0, index / n1_, index % n1_};
    return {1, (index - n0_ * n1_) / n0_, (index - n0_ * n1_) % n0_};
  }

 private:
  std::uint32_t n0_, n1_;
};

// Elements 0, 1, ... in classes that may be joined.

/// A class is named by its smallest element, in whatever order classes were joined.
class Partition {
 public:
  explicit Partition(std::size_t count = 0) : classes_(static_cast<std::uint32_t>(count)) {}
  std::size_t size() const { return classes_.size(); }
  /// A class of its own.
  std::uint32_t add() { return classes_.add(); }
  std::uint32_t find(std::uint32_t i) const { return classes_.root(i); }
  void join(std::uint32_t a, std::uint32_t b) {
    a = classes_.root(a);
    b = classes_.root(b);
    if (a != b) classes_.unite(std::max(a, b), std::min(a, b));
  }

 private:
  UnionFind classes_;
};

/// No node, no cell, no angle.
inline constexpr std::uint32_t kNobody = 0xffffffff;

/// What changes near a position: nodes that go, and what comes instead.
struct BoundaryEdit {
  /// New nodes along `segments`: they begin where `first` begins and end where `last` ends, two nodes that go.
  struct Run {
    std::uint32_t first = kNobody, last = kNobody;
    std::vector<WalkSegment> segments;
  };
  std::vector<Run> runs;
  std::vector<std::uint32_t> gone;               ///< all nodes that go
  std::vector<std::vector<WalkSegment>> births;  ///< new loops
  bool loops_may_change = false;                 ///< loops may split, join or vanish
  bool empty() const { return runs.empty() && gone.empty() && births.empty(); }
};

/// What changes where a slice is taken: the loops after the angle, of nodes that stay and of new ones. Of a slice that
/// is cut to a box the pieces of loops in it: nodes outside stay.
struct SliceEdit {
  struct Position {
    std::uint32_t segment = 0, left = 0, right = 0;
    std::uint32_t stays = kNobody;  ///< the node, or kNobody for a new one
  };
  /// What a piece follows, or what follows it: a node outside, or a position by its index along all loops.
  struct End {
    std::uint32_t node = kNobody, position = kNobody;
  };
  struct Loop {
    std::vector<Position> positions;
    bool outer = false;
    bool open = false;  ///< a piece, and then:
    End before, after;
    std::uint32_t cell = kNobody;  ///< of new nodes, unless loops may change
  };
  std::vector<Loop> loops;
  bool loops_may_change = true;      ///< loops may split, join, begin or vanish
  std::vector<std::uint32_t> ended;  ///< by their segments
  /// A node that ended and a position, by its index along all loops.
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Pairs continued;  ///< the position is what the node goes on as
  Pairs touching;   ///< walls of a passage that is shut at the angle, before and after it
  /// Whether it changes nothing.
  bool empty() const {
    const auto is_new = [](const Position& p) { return p.stays == kNobody; };
    return ended.empty() && std::all_of(loops.begin(), loops.end(), [&](const Loop& loop) {
             return std::none_of(loop.positions.begin(), loop.positions.end(), is_new);
           });
  }
};

class BoundaryGraph {
 public:
  struct Node {
    WalkSegment segment;
    std::uint32_t id = 0;                          ///< of the segment
    std::uint32_t prev = kNobody, next = kNobody;  ///< along the boundary
    std::uint32_t left = 0, right = 0;             ///< the segments of prev and next
    std::uint32_t begin = kNobody, end = kNobody;  ///< angles
    std::uint32_t next_on_segment = kNobody, prev_on_segment = kNobody;
    std::uint32_t cell = 0;             ///< on the right, now
    std::uint32_t born_cell = kNobody;  ///< when it began
    bool alive = true;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;  ///< (angle, cell) from the second one on
  };
  struct Cell {
    std::uint32_t begin = kNobody, end = kNobody;
    bool unbounded = false;  ///< told only where the turn begins, or where nesting was looked at
  };
  /// A free cell that goes on in another one at an angle.
  struct CellLink {
    std::uint32_t from = 0, to = 0;
  };

  explicit BoundaryGraph(SegmentIndex segments) : segments_(segments), first_on_(segments.count(), kNobody) {}

  const SegmentIndex& segments() const { return segments_; }
  const base::CountedArray<Node>& nodes() const { return nodes_; }
  const Node& operator[](std::uint32_t n) const { return nodes_[n]; }
  /// The first of the list of nodes of a segment that are alive, along next_on_segment.
  std::uint32_t first_on(std::uint32_t segment) const { return first_on_[segment]; }
  std::uint32_t first_on(const WalkSegment& s) const { return first_on_[segments_.of(s)]; }
  /// Increasing. O(those).
  std::vector<std::uint32_t> alive() const;
  SubEdge sub_edge(std::uint32_t n) const {
    return {nodes_[n].segment, segments_.segment(nodes_[n].left), segments_.segment(nodes_[n].right)};
  }
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<CellLink>& cell_links() const { return cell_links_; }
  /// Cells before and after an angle that touch each other there, in a passage that is shut.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& touching_cells() const { return touching_cells_; }
  std::uint32_t shell_of(std::uint32_t node) const { return shells_.find(node); }
  /// The connected components of free space.
  const Partition& components() const { return components_; }

  /// Begins the edits of one angle; the angle gets its index once something changes there.
  void begin_angle();
  void set_angle(std::uint32_t index) { now_ = index; }
  std::uint32_t angle() const { return now_; }
  void apply(const BoundaryEdit& edit);
  void apply(const SliceEdit& edit);
  void join_shells(std::uint32_t a, std::uint32_t b) { shells_.join(a, b); }
  void join_components(std::uint32_t a, std::uint32_t b) { components_.join(a, b); }
  void set_unbounded(std::uint32_t cell) { cells_[cell].unbounded = true; }

  /// What the edits of this angle did: whether a node began or ended; those that ended; nodes of before with another
  /// one after them now, and the former one; loops without a predecessor.
  bool changed() const { return changed_; }
  const std::vector<std::uint32_t>& ended() const { return ended_; }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& relinked() const { return relinked_; }
  std::uint32_t loops_born() const { return loops_born_; }

  /// Joins the end of the turn to its start. Whether they are the same boundary.
  bool close();
  /// The node that after close() goes on in this one after the end of the turn, or itself.
  std::uint32_t continued(std::uint32_t node) const { return continued_.empty() ? node : continued_[node]; }

  /// Throws std::logic_error unless the invariants hold. O(nodes).
  void check() const;

 private:
  using Ends = std::map<std::uint32_t, std::uint32_t>;  // of old nodes, and the new ones that have them
  std::uint32_t add_node(const WalkSegment& s, std::uint32_t cell);
  void end_node(std::uint32_t n);
  void link(std::uint32_t from, std::uint32_t to);
  std::vector<std::uint32_t> add_run(const BoundaryEdit::Run& run);
  void add_loop(const std::vector<WalkSegment>& segments, std::vector<std::uint32_t>& fresh);
  std::vector<std::uint32_t> relink(const Ends& starts, const Ends& ends);
  void refresh(std::vector<std::uint32_t> touched);
  std::uint32_t new_cell(bool unbounded);
  struct Claim {
    std::uint32_t node, cell;
  };
  void share_out(const std::vector<std::uint32_t>& touched, const std::vector<std::uint32_t>& lost,
                 const std::vector<Claim>& more);
  void give_cell(const std::vector<std::uint32_t>& loop, std::uint32_t cell);

  SegmentIndex segments_;
  base::CountedArray<Node> nodes_;
  std::vector<std::uint32_t> recently_alive_;  // increasing: all that are alive, and fewer others
  std::size_t recently_ended_ = 0;             // of these
  std::vector<std::uint32_t> first_on_;
  std::vector<Cell> cells_;
  std::vector<CellLink> cell_links_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touching_cells_;
  Partition shells_, components_;
  std::uint32_t at_start_ = 0;  // nodes, the first ones
  std::vector<std::uint32_t> continued_;
  std::uint32_t now_ = kNobody;
  bool changed_ = false;
  std::vector<std::uint32_t> ended_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> relinked_;
  std::uint32_t loops_born_ = 0;
};

// What lies between the boundary before an angle and a whole slice after it.

/// A loop of a slice: its segments, by index, in order.
struct SliceLoop {
  std::vector<std::uint32_t> segments;
  bool outer = false;
};

/// The edit, without `continued`. Nodes with the same segment and neighbours stay, but for those that are `parted`:
/// they end, and touch what begins in their place. O(n log n).
SliceEdit slice_difference(const BoundaryGraph& before, const std::vector<SliceLoop>& after,
                           const std::function<bool(std::uint32_t)>& parted);

}  // namespace dymsum::planar
