// The boundary of a sum where the winding number of a convolution changes between positive and not.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory_budget.h"
#include "dymsum/planar_sum.h"
#include "planar/arrangement/crossings.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/collision.h"

namespace dymsum::planar {

// Winding numbers of closed walks, left and right of every edge of the graph they form.

/// Segments of which segment s counts signs[s] times. Together they must start as often as they end at every position.
struct Tracing {
  Tracing(const Lattice& lattice, const Operand& p, const Operand& q, Scratch* scratch = nullptr)
      : soup(lattice, p, q, scratch) {}

  void add(const WalkSegment& w, int sign) {
    soup.add(w, soup.box(w));
    signs.push_back(sign);
  }

  Soup soup;
  base::CountedArray<int> signs;
};

/// Winding numbers left and right of an edge, seen from its low end.
struct Sides {
  int left = 0, right = 0;
  friend bool operator==(const Sides&, const Sides&) = default;
};

/// The winding numbers beside all edges of the tracing's graph: one ray for every connected piece, then around the
/// nodes. Throws std::logic_error when the tracing is not closed.
std::vector<Sides> find_windings(const Tracing& tracing, const SegmentGraph& graph);

// The rings that bound some faces of a graph of segments.

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

/// The rings around what has a positive winding number, the inside. Edges are named by segments that bound the sum
/// there: those that are counted positively and run the same way. `sides`: the winding numbers beside the edges of the
/// graph.
GraphRings winding_rings(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides);

/// Appends cracks and punctures: candidates inside the boundary that a collision test does not find in the open sum.
/// Grows `error` to the largest error of a position.
void find_tight_features(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides,
                         Collision& collision, RawBoundary& out, double& error);

}  // namespace dymsum::planar
