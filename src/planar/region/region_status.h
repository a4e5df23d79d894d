// The status of the validation sweep: the edges that meet the sweep line, ordered from bottom to top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::planar {

inline bool lex_less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

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

}  // namespace dymsum::planar
