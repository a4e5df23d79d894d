// The rings that bound some faces of a graph of segments.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/arrangement/segment_graph.h"

namespace dymsum::planar {

/// An edge between two nodes with interior on its left, and a segment that bounds the set there.
struct BoundaryEdge {
  std::uint32_t from = 0, to = 0, segment = 0;
  bool along = true;  ///< the segment runs the same way
};
using BoundaryEdges = std::vector<BoundaryEdge>;

/// Whether the faces left and right of an edge, seen from its low end, lie inside.
struct GraphSides {
  bool left = false, right = false;
};

class GraphRings {
 public:
  /// `sides`: of the graph's edges. `segments`: what names those that bound the set.
  GraphRings(const Soup& soup, const SegmentGraph& graph, std::vector<GraphSides> sides,
             std::vector<std::uint32_t> segments)
      : soup_(soup), graph_(graph), sides_(std::move(sides)), segments_(std::move(segments)) {}

  /// Simple rings, edge by edge.
  std::vector<BoundaryEdges> rings() const;
  /// A ring with collinear edges merged; grows `error` to the largest error of a position.
  SumRing ring(const BoundaryEdges& edges, double& error) const;
  bool counter_clockwise(const BoundaryEdges& ring) const;

 private:
  using Ray = SegmentGraph::Ray;
  bool on_boundary(std::uint32_t edge) const { return sides_[edge].left != sides_[edge].right; }
  bool leaves(const Ray& r) const { return r.forward == sides_[r.edge].left; }
  void link(std::uint32_t node, std::vector<std::uint32_t>& next) const;
  BoundaryEdge oriented(std::uint32_t edge) const;

  const Soup& soup_;
  const SegmentGraph& graph_;
  std::vector<GraphSides> sides_;
  std::vector<std::uint32_t> segments_;
};

/// The smallest segment along an edge that runs from its low to its high end (`forward`), or back, and is requested; or
/// kNone.
template <class Queried>
std::uint32_t segment_along(const SegmentGraph& graph, std::uint32_t edge, bool forward, const Queried& queried) {
  const SegmentGraph::Edge& e = graph.edges()[edge];
  std::uint32_t smallest = kNone;
  for (std::uint32_t k = e.first; k < e.last; ++k) {
    const SegmentGraph::SubEdge& s = graph.sub_edges()[k];
    if (SegmentGraph::forward(e, s) == forward && s.segment < smallest && queried(s.segment)) smallest = s.segment;
  }
  return smallest;
}

/// A node as a vertex on a segment that passes through it.
SumVertex vertex_on(const Soup& soup, const SegmentGraph& graph, std::uint32_t node, std::uint32_t segment);

}  // namespace dymsum::planar
