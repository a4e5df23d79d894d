#include "planar/region/region_status.h"

#include <algorithm>

#include "exact/orient.h"

namespace dymsum::planar {

namespace {

// Heap priorities of treap nodes: a fixed scrambling of the node index (splitmix64's finisher), so that the same input
// takes the same steps everywhere.
std::uint64_t priority(SweepStatus::Node node) {
  std::uint64_t z = node + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

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

}  // namespace dymsum::planar
