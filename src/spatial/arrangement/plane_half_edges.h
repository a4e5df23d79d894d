// The half-edges of one plane, around the points that they leave and along the faces to their left.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/arrangement/plane_cells.h"
#include "spatial/arrangement/plane_points.h"

namespace dymsum::spatial {

/// Edge e has the half-edge 2 e from a to b, and 2 e + 1 back. Points have indices from 0 on, in the order of their
/// first half-edges.
class PlaneHalfEdges {
 public:
  explicit PlaneHalfEdges(const PlanePoints& points) : points_(points) {}

  /// Sorts the half-edges of these edges, which have to live as long as they are queried. Exact. O(n log n).
  void run(const std::vector<CellEdge>& edges);

  std::uint32_t count() const { return static_cast<std::uint32_t>(2 * edges_->size()); }
  const CellEdge& edge(std::uint32_t h) const { return (*edges_)[h / 2]; }
  PointId from(std::uint32_t h) const { return h & 1 ? edge(h).b : edge(h).a; }
  PointId to(std::uint32_t h) const { return from(h ^ 1); }
  /// 1 where half-edge h runs along n x n_cut.
  int direction(std::uint32_t h) const { return (edge(h).along ? 1 : -1) * (h & 1 ? -1 : 1); }
  /// The half-edge that follows h along the face to its left.
  std::uint32_t next(std::uint32_t h) const { return next_[h]; }

  /// The ends of edges, each once.
  const std::vector<PointId>& points() const { return point_; }
  /// The first half-edge out of a point.
  std::uint32_t first_out(std::uint32_t point) const { return out_[begin_[point]]; }
  /// The first half-edge out of the point that h leaves.
  std::uint32_t first_beside(std::uint32_t h) const { return first_out(vertex_[h]); }
  /// The last half-edge counter-clockwise at the lowest point of a component, where all leave into half a turn. To its
  /// left is the outside.
  std::uint32_t last_around(std::uint32_t point) const;

 private:
  struct Sector {
    int sector;
    std::uint32_t half_edge;
  };

  /// The sign of the turn from half-edge g to h, both out of one point.
  int turn(std::uint32_t g, std::uint32_t h) const;
  void index_points();
  void sort_around(std::uint32_t first, std::uint32_t last);

  const PlanePoints& points_;
  const std::vector<CellEdge>* edges_ = nullptr;
  std::vector<PointId> point_;
  std::vector<std::uint32_t> vertex_, next_;    // per half-edge: the point that it leaves; what follows it
  std::vector<std::uint32_t> begin_, out_;      // half-edges by points, counter-clockwise
  std::vector<std::uint32_t> slot_, position_;  // scratch of index_points() and run()
  std::vector<Sector> sectors_;                 // scratch of sort_around()
};

}  // namespace dymsum::spatial
