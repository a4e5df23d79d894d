// Point location among rings: horizontal slabs between the heights of their vertices, in a binary tree of slabs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/position/near_spot.h"

namespace dymsum::planar {

/// The location of points against the set bounded by rings that do not cross (even-odd; they may touch in points). An
/// edge is kept at the O(log n) nodes of the tree whose slabs it spans and that together are its height. Edges of a
/// node do not meet inside its slab, so they have an order from left to right, and so have their sides at any point of
/// the closed slab. Exact. O(n log^2 n) to make, O(n log n) memory, O(log^2 n) a question.
class RingSlabs {
 public:
  RingSlabs() = default;
  /// Requires: what the vertices refer to outlives this, no two consecutive ones are equal.
  explicit RingSlabs(std::span<const std::vector<NearSpot>> rings);

  Location locate(const NearSpot& z) const;

 private:
  struct Edge {
    NearSpot low, high;
    std::uint32_t from, to;  // their levels
  };
  struct Flat {  // a horizontal edge
    NearSpot left, right;
    std::uint32_t level;
  };

  std::uint32_t level_of(const NearSpot& v) const;
  void take_edges(std::span<const std::vector<NearSpot>> rings);
  template <class Visit>
  void for_each_node(const Edge& edge, Visit&& visit) const;
  void fill_nodes();
  static bool left_of(const Edge& a, const Edge& b);
  Location in_slab(std::uint32_t slab, const NearSpot& z) const;
  bool on_flat(std::uint32_t level, const NearSpot& z) const;

  std::vector<NearSpot> levels_;  // one vertex of each height, from below
  std::vector<Edge> edges_;
  std::vector<Flat> flats_;             // by level, then from left to right
  std::uint32_t leaves_ = 1;            // a power of two; slab s, between levels s and s + 1, is node leaves_ + s
  std::vector<std::uint32_t> starts_;   // of each node in members_; node 1 is the root, its children 2 and 3
  std::vector<std::uint32_t> members_;  // edges
};

}  // namespace dymsum::planar
