#include "planar/region/region_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "dymsum/region.h"
#include "exact/orient.h"

namespace dymsum::planar {
namespace {

// The status of the validation sweep: the edges that meet the sweep line, ordered from bottom to top.

/// An ordered list of edges with search by point: a treap over flat arrays whose nodes are also threaded into a doubly
/// linked list. Search, insert and erase take O(log m) expected for m edges; neighbours and replacement O(1).
class SweepStatus {
 public:
  using Node = std::uint32_t;
  static constexpr Node kNone = 0xffffffff;

  struct Edge {
    Point left, right;  ///< ends, lexicographically left < right
    std::uint32_t id = 0;
    bool forward = true;  ///< the edge runs from left to right along its ring
  };

  const Edge& edge(Node node) const { return nodes_[node].edge; }
  Node next(Node node) const { return nodes_[node].next; }
  Node previous(Node node) const { return nodes_[node].previous; }
  std::size_t peak_size() const { return nodes_.size(); }

  /// Sign of p's height over the node's edge, for a p within the edge's lexicographic extent. Exact.
  int side(Node node, Point p) const;
  /// The lowest edge that is not strictly below p, or kNone; `below` is the one before it. Exact.
  struct Position {
    Node below, at_or_above;
  };
  Position locate(Point p) const;

  void replace(Node node, const Edge& edge) { nodes_[node].edge = edge; }
  /// Inserts directly above `below` (kNone: at the bottom).
  Node insert_above(Node below, const Edge& edge);
  void erase(Node node);

 private:
  struct Links {
    Edge edge;
    Node child[2];
    Node parent, previous, next;
  };

  Node new_node(const Edge& edge);
  void set_child_of_parent(Node parent, Node old_child, Node new_child);
  void rotate_up(Node node);

  std::vector<Links> nodes_;
  std::vector<Node> free_;
  Node root_ = kNone;
  Node bottom_ = kNone;
};

// Heap priorities of treap nodes: a fixed scrambling of the node index (splitmix64's finisher), so that the same input
// takes the same steps everywhere.
std::uint64_t priority(SweepStatus::Node node) {
  std::uint64_t z = node + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

int SweepStatus::side(Node node, Point p) const {
  const Edge& e = nodes_[node].edge;
  if (p.y > std::max(e.left.y, e.right.y)) return 1;
  if (p.y < std::min(e.left.y, e.right.y)) return -1;
  if (p == e.left || p == e.right) return 0;
  return exact::orient_sign(e.left, e.right, p);
}

SweepStatus::Position SweepStatus::locate(Point p) const {
  Position position{kNone, kNone};
  for (Node node = root_; node != kNone;) {
    const bool above = side(node, p) > 0;
    (above ? position.below : position.at_or_above) = node;
    node = nodes_[node].child[above ? 1 : 0];
  }
  return position;
}

SweepStatus::Node SweepStatus::new_node(const Edge& edge) {
  const Links fresh{edge, {kNone, kNone}, kNone, kNone, kNone};
  if (free_.empty()) {
    nodes_.push_back(fresh);
    return static_cast<Node>(nodes_.size() - 1);
  }
  const Node node = free_.back();
  free_.pop_back();
  nodes_[node] = fresh;
  return node;
}

void SweepStatus::set_child_of_parent(Node parent, Node old_child, Node new_child) {
  if (parent == kNone) {
    root_ = new_child;
  } else {
    nodes_[parent].child[nodes_[parent].child[1] == old_child ? 1 : 0] = new_child;
  }
}

void SweepStatus::rotate_up(Node node) {
  const Node parent = nodes_[node].parent;
  const Node grandparent = nodes_[parent].parent;
  const int side = nodes_[parent].child[1] == node ? 1 : 0;
  const Node inner = nodes_[node].child[1 - side];
  nodes_[parent].child[side] = inner;
  if (inner != kNone) nodes_[inner].parent = parent;
  nodes_[node].child[1 - side] = parent;
  set_child_of_parent(grandparent, parent, node);
  nodes_[parent].parent = node;
  nodes_[node].parent = grandparent;
}

SweepStatus::Node SweepStatus::insert_above(Node below, const Edge& edge) {
  const Node node = new_node(edge);
  const Node above = below == kNone ? bottom_ : nodes_[below].next;
  nodes_[node].previous = below;
  nodes_[node].next = above;
  (below == kNone ? bottom_ : nodes_[below].next) = node;
  if (above != kNone) nodes_[above].previous = node;
  if (root_ == kNone) {
    root_ = node;
    return node;
  }
  // Of two neighbours in order, one has no child on the side of the other.
  const bool under_below = below != kNone && nodes_[below].child[1] == kNone;
  const Node parent = under_below ? below : above;
  nodes_[parent].child[under_below ? 1 : 0] = node;
  nodes_[node].parent = parent;
  while (nodes_[node].parent != kNone && priority(node) > priority(nodes_[node].parent)) rotate_up(node);
  return node;
}

void SweepStatus::erase(Node node) {
  while (nodes_[node].child[0] != kNone && nodes_[node].child[1] != kNone) {
    const Node* child = nodes_[node].child;
    rotate_up(priority(child[0]) > priority(child[1]) ? child[0] : child[1]);
  }
  const Links& gone = nodes_[node];
  const Node only = gone.child[0] != kNone ? gone.child[0] : gone.child[1];
  set_child_of_parent(gone.parent, node, only);
  if (only != kNone) nodes_[only].parent = gone.parent;
  (gone.previous == kNone ? bottom_ : nodes_[gone.previous].next) = gone.next;
  if (gone.next != kNone) nodes_[gone.next].previous = gone.previous;
  free_.push_back(node);
}

}  // namespace

void RingList::add(const Ring& ring) {
  if (points.size() + ring.size() >= 0xffffffff) throw std::length_error("a region has fewer than 2^32 - 1 vertices");
  ring_of.insert(ring_of.end(), ring.size(), ring_count());
  points.insert(points.end(), ring.begin(), ring.end());
  ring_begin.push_back(static_cast<std::uint32_t>(points.size()));
}

namespace {

constexpr std::uint32_t kNone = RingPosition::kNone;

// The position where two properly crossing segments meet, rounded: for messages. A power of two keeps products in
// range.
Point rough_crossing(const SweepStatus::Edge& a, const SweepStatus::Edge& b) {
  double largest = 0;
  for (const Point p : {a.left, a.right, b.left, b.right}) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const int shift = -2 - std::ilogb(largest);
  const auto scaled = [shift](Point p) { return Point{std::scalbn(p.x, shift), std::scalbn(p.y, shift)}; };
  const Point a0 = scaled(a.left), a1 = scaled(a.right), b0 = scaled(b.left), b1 = scaled(b.right);
  const double cross = (a1.x - a0.x) * (b1.y - b0.y) - (a1.y - a0.y) * (b1.x - b0.x);
  const double along = (b0.x - a0.x) * (b1.y - b0.y) - (b0.y - a0.y) * (b1.x - b0.x);
  double t = cross == 0 ? 0.5 : along / cross;
  t = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.5;
  return {(1 - t) * a.left.x + t * a.right.x, (1 - t) * a.left.y + t * a.right.y};
}

class RingSweep {
 public:
  explicit RingSweep(const RingList& rings) : rings_(rings) {}
  RingLayout run();

 private:
  using Node = SweepStatus::Node;

  // A ray from the current point along an edge. Rays of one strand (the two edges at a vertex, or the two halves of an
  // edge through the point) share its name: the vertex, or the edge with the flag.
  struct Ray {
    SweepStatus::Edge edge;
    std::uint64_t strand;
  };
  static constexpr std::uint64_t kThrough = std::uint64_t{1} << 32;
  static std::uint32_t edge_of(std::uint64_t strand) { return static_cast<std::uint32_t>(strand); }

  void sort_events();
  void visit(std::span<const std::uint32_t> vertices);
  void collect_rays_right(std::span<const std::uint32_t> vertices);
  void collect_rays_left(Point p);
  bool sort_rays_right(Point p);
  bool strands_interleave(Point p);
  void place_new_rings();
  void update_status();
  void check_neighbours(Node lower, Node upper);
  void clash(std::uint32_t edge, std::uint32_t other, Point at);

  const RingList& rings_;
  RingLayout layout_;
  SweepStatus status_;
  std::vector<std::uint32_t> events_;  // vertices in lexicographic order
  std::vector<Node> node_of_;          // edge -> node while it is in the status
  std::vector<Ray> right_;             // rays to the right of the current point, from bottom to top
  std::vector<std::uint64_t> left_;    // strands of the rays to the left, from bottom to top
  std::vector<Node> range_;            // nodes of the rays to the left, from bottom to top
  std::vector<std::uint64_t> open_;    // strands met once on the way around the point
  Node below_ = SweepStatus::kNone;    // neighbours of the range
  Node ending_ = SweepStatus::kNone;   // the node of an edge that ends at the current point
};

void RingSweep::sort_events() {
  struct Key {
    double x;
    std::uint32_t vertex;
  };
  std::vector<Key> keys(rings_.points.size());
  for (std::uint32_t v = 0; v < keys.size(); ++v) keys[v] = {rings_.points[v].x, v};
  std::sort(keys.begin(), keys.end(), [this](const Key& a, const Key& b) {
    if (a.x != b.x) return a.x < b.x;
    const double ay = rings_.points[a.vertex].y, by = rings_.points[b.vertex].y;
    return ay != by ? ay < by : a.vertex < b.vertex;
  });
  events_.resize(keys.size());
  std::transform(keys.begin(), keys.end(), events_.begin(), [](const Key& key) { return key.vertex; });
}

RingLayout RingSweep::run() {
  sort_events();
  node_of_.assign(rings_.points.size(), SweepStatus::kNone);
  layout_.rings.resize(rings_.ring_count());
  for (std::size_t i = 0; i < events_.size() && !layout_.clash;) {
    std::size_t end = i + 1;
    while (end < events_.size() && rings_.points[events_[end]] == rings_.points[events_[i]]) ++end;
    visit(std::span(events_).subspan(i, end - i));
    i = end;
  }
  return std::move(layout_);
}

void RingSweep::visit(std::span<const std::uint32_t> vertices) {
  const Point p = rings_.points[vertices.front()];
  collect_rays_right(vertices);
  collect_rays_left(p);
  if (!sort_rays_right(p)) return;
  if (right_.size() + left_.size() > 2) {
    if (strands_interleave(p)) return;
    layout_.touching_points.push_back(p);
  }
  place_new_rings();
  update_status();
}

// Edges that start at p.
void RingSweep::collect_rays_right(std::span<const std::uint32_t> vertices) {
  right_.clear();
  ending_ = SweepStatus::kNone;
  for (const std::uint32_t v : vertices) {
    const Point p = rings_.points[v];
    const std::uint32_t next = rings_.next(v), previous = rings_.previous(v);
    const Point ahead = rings_.points[next], behind = rings_.points[previous];
    if (lex_less(p, ahead)) {
      right_.push_back({{p, ahead, v, true}, v});
    } else {
      ending_ = node_of_[v];
    }
    if (lex_less(p, behind)) {
      right_.push_back({{p, behind, previous, false}, v});
    } else {
      ending_ = node_of_[previous];
    }
  }
}

// Edges in the status that contain p: they end there or pass through; the latter also go on to the right.
void RingSweep::collect_rays_left(Point p) {
  left_.clear();
  range_.clear();
  Node node = ending_;
  if (node == SweepStatus::kNone) {
    const SweepStatus::Position position = status_.locate(p);
    below_ = position.below;
    node = position.at_or_above;
  } else {
    below_ = status_.previous(node);
    while (below_ != SweepStatus::kNone && status_.side(below_, p) == 0) {
      node = below_;
      below_ = status_.previous(node);
    }
  }
  for (; node != SweepStatus::kNone && status_.side(node, p) == 0; node = status_.next(node)) {
    const SweepStatus::Edge& e = status_.edge(node);
    range_.push_back(node);
    if (e.right == p) {
      left_.push_back(e.forward ? rings_.next(e.id) : e.id);
    } else {
      left_.push_back(kThrough | e.id);
      right_.push_back({e, kThrough | e.id});
    }
  }
}

// Sorts rays by direction from p, all within the half-plane to its right. False after a clash: two edges run along each
// other.
bool RingSweep::sort_rays_right(Point p) {
  const auto turn = [p](const Ray& a, const Ray& b) { return exact::orient_sign(p, a.edge.right, b.edge.right); };
  if (right_.size() > 1) {
    std::sort(right_.begin(), right_.end(), [&turn](const Ray& a, const Ray& b) { return turn(a, b) > 0; });
  }
  for (std::size_t i = 1; i < right_.size(); ++i) {
    if (turn(right_[i - 1], right_[i]) != 0) continue;
    clash(right_[i - 1].edge.id, right_[i].edge.id, p);
    return false;
  }
  return true;
}

// Walks once around p. Every strand is met twice; those met in between must be met twice in between.
bool RingSweep::strands_interleave(Point p) {
  open_.clear();
  const std::size_t count = right_.size() + left_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t strand = i < right_.size() ? right_[i].strand : left_[count - 1 - i];
    if (open_.empty() || open_.back() != strand) {
      open_.push_back(strand);
    } else {
      open_.pop_back();
    }
  }
  if (open_.empty()) return false;
  // What remains on the stack is a sequence without equal neighbours in which every strand occurs twice: the strand
  // between whose two occurrences the fewest others lie interleaves with the one beside its first occurrence.
  std::size_t first = 0, second = open_.size();
  std::vector<std::pair<std::uint64_t, std::size_t>> by_name;
  for (std::size_t i = 0; i < open_.size(); ++i) by_name.emplace_back(open_[i], i);
  std::sort(by_name.begin(), by_name.end());
  for (std::size_t i = 0; i + 1 < by_name.size(); i += 2) {
    if (by_name[i + 1].second - by_name[i].second < second - first) {
      first = by_name[i].second;
      second = by_name[i + 1].second;
    }
  }
  clash(edge_of(open_[first]), edge_of(open_[first + 1]), p);
  return true;
}

// A ring is met first at its lexicographically smallest point, where all its rays go right. What lies under the lowest
// of them is outside the ring: the face above the edge below it.
void RingSweep::place_new_rings() {
  for (std::size_t i = 0; i < right_.size(); ++i) {
    const Ray& ray = right_[i];
    RingPosition& position = layout_.rings[rings_.ring_of[ray.edge.id]];
    if (position.first_vertex != kNone) continue;
    position.first_vertex = edge_of(ray.strand);
    position.counter_clockwise = ray.edge.forward;
    if (i == 0 && below_ == SweepStatus::kNone) continue;
    const SweepStatus::Edge& under = i > 0 ? right_[i - 1].edge : status_.edge(below_);
    const std::uint32_t ring = rings_.ring_of[under.id];
    const bool inside = under.forward == layout_.rings[ring].counter_clockwise;
    position.container = inside ? ring : layout_.rings[ring].container;
  }
}

// Replaces the rays to the left by those to the right and looks at the pairs that became neighbours.
void RingSweep::update_status() {
  const std::size_t kept = std::min(range_.size(), right_.size());
  Node top = below_;
  Node lowest = SweepStatus::kNone;
  for (std::size_t i = 0; i < right_.size(); ++i) {
    if (i < kept) {
      top = range_[i];
      status_.replace(top, right_[i].edge);
    } else {
      top = status_.insert_above(top, right_[i].edge);
    }
    node_of_[right_[i].edge.id] = top;
    if (i == 0) lowest = top;
  }
  for (std::size_t i = kept; i < range_.size(); ++i) status_.erase(range_[i]);
  if (lowest != SweepStatus::kNone) check_neighbours(below_, lowest);
  const Node above = top != SweepStatus::kNone ? status_.next(top) : SweepStatus::kNone;
  check_neighbours(top, above);
}

// `lower` is strictly below `upper` right after the current point: they cross exactly when that is reversed at the end
// of the shorter one.
void RingSweep::check_neighbours(Node lower, Node upper) {
  if (lower == SweepStatus::kNone || upper == SweepStatus::kNone || layout_.clash) return;
  const SweepStatus::Edge& a = status_.edge(lower);
  const SweepStatus::Edge& b = status_.edge(upper);
  const bool a_is_shorter = lex_less(a.right, b.right);
  const bool crossing = a_is_shorter ? status_.side(upper, a.right) > 0 : status_.side(lower, b.right) < 0;
  if (crossing) clash(a.id, b.id, rough_crossing(a, b));
}

void RingSweep::clash(std::uint32_t edge, std::uint32_t other, Point at) {
  layout_.clash = RingClash{std::min(edge, other), std::max(edge, other), at};
}

}  // namespace

RingLayout layout_rings(const RingList& rings) { return RingSweep(rings).run(); }

}  // namespace dymsum::planar
