// A result as an operand of the next operation: its exact positions, and its rings as the engine wants them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/position/exact_source.h"
#include "planar/region/region.h"

namespace dymsum::planar {

// The vertices and edges of a sum's rings, segments and points in one flat list, with their exact positions, and the
// contacts between them: what has to survive rounding.

/// Calls f(vertex) for all vertices of a sum: of its rings, part by part, the outer ring first; then the ends of its
/// segments; then its points.
template <class F>
void for_each_vertex(const PlanarSum& sum, F f) {
  const auto of_ring = [&](const SumRing& ring) {
    for (const SumVertex& v : ring.vertices) f(v);
  };
  for (const SumPart& part : sum.parts) {
    of_ring(part.outer);
    for (const SumRing& hole : part.holes) of_ring(hole);
  }
  for (const SumSegment& s : sum.segments) {
    f(s.from);
    f(s.to);
  }
  for (const SumVertex& v : sum.points) f(v);
}

class SumSkeleton {
 public:
  /// A ring, a segment (two vertices) or a point (one): vertices first .. first + count - 1.
  struct Chain {
    std::uint32_t first = 0, count = 0;
    bool closed = false;
    std::optional<std::int64_t> part, ring;  ///< of a ring
  };
  struct Edge {
    std::uint32_t from = 0, to = 0, chain = 0;
  };
  /// A vertex inside an edge that it does not belong to. `vertex` stands for all vertices at its exact position.
  struct VertexOnEdge {
    std::uint32_t edge = 0, vertex = 0;
    friend bool operator==(const VertexOnEdge&, const VertexOnEdge&) = default;
  };

  /// Requires that the sum outlives this.
  explicit SumSkeleton(const PlanarSum& sum);

  std::vector<Point> nearest;            ///< of all vertices, their nearest doubles
  std::vector<Chain> chains;             ///< rings part by part, outer ring first; then segments; then points
  std::vector<Edge> edges;               ///< in the order of the chains
  std::vector<std::uint32_t> position;   ///< per vertex: the one that stands for all at its exact position
  std::vector<std::uint32_t> positions;  ///< those that stand, sorted by their nearest doubles, x then y

  /// A vertex with its exact position, which is made when first requested.
  const Spot& spot(std::uint32_t vertex) const;

  /// Two vertices with different exact positions and the same nearest doubles.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first_collision() const;

  /// All contacts, exactly, sorted by edge, then along the edge. O(n log n + m): m vertices in x ranges of edges.
  std::vector<VertexOnEdge> contacts() const;

  /// The positions whose nearest doubles lie in the box of the nearest doubles of a and b.
  template <class Visit>
  void visit_positions_in_box(Point a, Point b, Visit visit) const;

 private:
  void add_vertex(const SumVertex& vertex, const NearestPoint& nearest_point);
  void add_ring(const SumRing& ring, const NearestPoint& nearest_point, std::int64_t part, std::int64_t index);
  void add_chain(Chain chain);
  void find_positions();
  /// Lexicographic order of the exact positions.
  int compare(std::uint32_t a, std::uint32_t b) const;

  std::shared_ptr<const ExactSource> source_;
  std::vector<const SumVertex*> named_;  ///< of all vertices: they name the positions
  mutable std::vector<std::unique_ptr<const Spot>> spots_;
};

template <class Visit>
void SumSkeleton::visit_positions_in_box(Point a, Point b, Visit visit) const {
  const double min_x = a.x < b.x ? a.x : b.x, max_x = a.x < b.x ? b.x : a.x;
  const double min_y = a.y < b.y ? a.y : b.y, max_y = a.y < b.y ? b.y : a.y;
  std::size_t low = 0, high = positions.size();
  while (low < high) {
    const std::size_t midpoint = (low + high) / 2;
    if (nearest[positions[midpoint]].x < min_x) low = midpoint + 1;
    else high = midpoint;
  }
  for (; low < positions.size(); ++low) {
    const Point p = nearest[positions[low]];
    if (p.x > max_x) return;
    if (p.y >= min_y && p.y <= max_y) visit(positions[low]);
  }
}

// Parts of rings that are the rings of what a set leaves out, reversed.

/// Joins the rings of a result anew where they touch, so that every part has a connected interior, and brings the parts
/// into canonical form. Rings of a complement, reversed, bound the right set; but where they touch, they go
/// on across what it leaves out: a hole that touches its outline in several points is no hole, the interior falls apart
/// there. Requires: rings do not cross. Nothing changes where no hole touches another ring in two points.
/// Cost: O(n log n) for n vertices of a result with holes, with a sign for each vertex in the box of an edge.
void separate_parts(PlanarSum& sum);

/// The closed set of a result: its parts, segments (as polylines) and points; tight features are no part of it. Where
/// all positions are doubles the data are these. Rings that touch are cut and joined anew, as separate_touching does.
/// Vertices have the indices of the result's lists: part by part, outer ring then holes, then the ends of segments,
/// then points.
EngineRegion region_of_result(const PlanarSum& sum);

/// The positions of all vertices in that order, in lowest terms.
std::vector<exact::HomogeneousPoint> positions_of(const PlanarSum& sum);
/// Whether a position is this pair of doubles.
bool is_double(const exact::HomogeneousPoint& position, Point nearest);

}  // namespace dymsum::planar
