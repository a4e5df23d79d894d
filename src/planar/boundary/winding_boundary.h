// The boundary of a sum where the winding number of a convolution changes between positive and not.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/collision.h"
#include "planar/boundary/raw_boundary.h"
#include "planar/boundary/winding_numbers.h"

namespace dymsum::planar {

/// An edge between two nodes with interior on its left, and a segment that bounds the sum there.
struct BoundaryEdge {
  std::uint32_t from = 0, to = 0, segment = 0;
};
using BoundaryEdges = std::vector<BoundaryEdge>;

class WindingBoundary {
 public:
  /// `sides`: the winding numbers beside the edges of the graph.
  WindingBoundary(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides)
      : tracing_(tracing), graph_(graph), sides_(sides) {}

  /// Simple rings, edge by edge.
  std::vector<BoundaryEdges> rings() const;
  /// A ring with collinear edges merged; grows `error` to the largest error of a position.
  SumRing ring(const BoundaryEdges& edges, double& error) const;
  bool counter_clockwise(const BoundaryEdges& ring) const;
  /// Appends cracks and punctures: candidates inside the boundary that a collision test does not find in the open sum.
  void find_tight_features(Collision& collision, RawBoundary& out, double& error) const;

 private:
  using Ray = SegmentGraph::Ray;
  bool on_boundary(std::uint32_t edge) const { return (sides_[edge].left > 0) != (sides_[edge].right > 0); }
  bool inside(std::uint32_t edge) const { return sides_[edge].left > 0 && sides_[edge].right > 0; }
  bool leaves(const Ray& r) const { return r.forward == (sides_[r.edge].left > 0); }
  void link(std::uint32_t node, std::vector<std::uint32_t>& next) const;
  BoundaryEdge oriented(std::uint32_t edge) const;
  bool may_be_crack(std::uint32_t edge) const;
  bool may_be_puncture(std::uint32_t node) const;
  SumVertex vertex(std::uint32_t node, std::uint32_t segment) const;

  const Tracing& tracing_;
  const SegmentGraph& graph_;
  const std::vector<Sides>& sides_;
};

}  // namespace dymsum::planar
