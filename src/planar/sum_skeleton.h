// The vertices and edges of a sum's rings, segments and points in one flat list, with their exact positions, and the
// contacts between them: what has to survive rounding.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "planar/position_signs.h"

namespace dymsum::planar {

class SumSkeleton {
 public:
  /// A ring, a segment (two vertices) or a point (one): vertices[first .. first + count).
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

  explicit SumSkeleton(const PlanarSum& sum);

  std::vector<Spot> vertices;
  std::vector<Chain> chains;  ///< rings part by part, outer ring first; then segments; then points
  std::vector<Edge> edges;    ///< in the order of the chains
  std::vector<std::uint32_t> place;  ///< per vertex: the one that stands for all at its exact position
  std::vector<std::uint32_t> places;  ///< those that stand, sorted by their nearest doubles, x then y

  /// Two vertices with different exact positions and the same nearest doubles.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first_collision() const;

  /// All contacts, exactly, sorted by edge, then along the edge. O(n log n + m): m vertices in x ranges of edges.
  std::vector<VertexOnEdge> contacts() const;

  /// The places whose nearest doubles lie in the box of the nearest doubles of a and b.
  template <class Visit>
  void visit_places_in_box(Point a, Point b, Visit visit) const;

 private:
  void add_ring(const SumRing& ring, const ExactSource& source, std::int64_t part, std::int64_t number);
  void add_chain(Chain chain);
  void find_places();
};

template <class Visit>
void SumSkeleton::visit_places_in_box(Point a, Point b, Visit visit) const {
  const double min_x = a.x < b.x ? a.x : b.x, max_x = a.x < b.x ? b.x : a.x;
  const double min_y = a.y < b.y ? a.y : b.y, max_y = a.y < b.y ? b.y : a.y;
  std::size_t low = 0, high = places.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (vertices[places[middle]].nearest.x < min_x)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < places.size(); ++low) {
    const Point p = vertices[places[low]].nearest;
    if (p.x > max_x) return;
    if (p.y >= min_y && p.y <= max_y) visit(places[low]);
  }
}

}  // namespace dymsum::planar
