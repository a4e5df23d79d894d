// The features of the operands that touch on the faces, along the edges and at the points of a sum.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/arrangement/plane_lines.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

// Tight segments in line with each other put together.

/// Several pieces end to end on one line; `first` and `last` are the indices of those at its ends.
struct TightLine {
  PointId from = 0, to = 0;
  std::uint32_t first = 0, last = 0;
};

/// Pieces that share an end and lie on one line become one. Requires: pieces overlap in ends only. Exact. O(n log n)
/// for bounded numbers of pieces at a point.
std::vector<TightLine> joined_lines(const SumSpace& space, const PointTable& points,
                                    std::span<const std::array<PointId, 2>> pieces);

/// The features whose sum a facet is.
SolidContact features_of(const SumFacet& facet, const SolidOperand& p, const SolidOperand& q);

class FeaturePairs {
 public:
  FeaturePairs(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, StageWatch& watch);

  /// A position in a plane: near `from`, to the left of the way to `to` as seen from this side (1 or -1: of the plane's
  /// normal).
  struct Position {
    const PlaneGroup& group;
    PointId from, to;
    int seen_from;
  };
  /// The smallest pair of the facets with this side that cover the position.
  SolidContact of_face(const Position& position, int side) const;
  /// An edge and a vertex whose sum runs along ab at one of its ends; none where two faces cross.
  std::optional<SolidContact> of_edge(PointId a, PointId b) const;
  /// Two vertices with that sum, or an edge and a vertex; none where three faces cross.
  std::optional<SolidContact> of_point(PointId at) const;
  /// The contacts of all facets that hold a point, and of what is near it on the way to another one, sorted. O(log n +
  /// k) for k facets near the point.
  std::vector<SolidContact> of_facets_at(PointId at) const { return of_facets_along(at, at); }
  std::vector<SolidContact> of_facets_along(PointId at, PointId to) const;

 private:
  bool covers(const TableFacet& facet, const Position& position) const;
  bool holds_start(const TableFacet& facet, PointId at, PointId to) const;
  bool is_on(const TableFacet& facet, PointId at) const;
  int side_of_facet_edge(const TableFacet& facet, int facet_edge, PointId at) const;
  int exact_side_of_facet_edge(const TableFacet& facet, SumPoint a, SumPoint b, PointId at) const;
  bool runs_with(SumPoint a, SumPoint b, PointId from, PointId to) const;
  bool is_named_by(PointId at, EdgeId edge) const;
  bool runs_along(const SumEdge& edge, PointId from, PointId to) const;
  SolidContact features(const SumFacet& facet) const { return features_of(facet, p_, q_); }
  SolidContact features(const SumEdge& edge) const;
  template <class F>
  void for_each_edge_at(PointId at, F f) const;

  const SolidBoundary& boundary_;
  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const SolidOperand &p_, &q_;
  /// An end of an edge of sums, by its vertex of P: that of Q.
  struct EdgeEnd {
    std::uint32_t q;
    EdgeId edge;
  };
  std::vector<std::uint32_t> first_end_;  // per vertex of P
  std::vector<EdgeEnd> ends_;
  std::unordered_map<std::uint64_t, std::uint32_t> diagonal_[2];  // edges inside faces, and these faces
  BoxTree facets_;                                                // only where something is tight
};

// The edges of a sum's faces.

// The vertex at which a loop of a face begins.

/// Rotates the loop to its smallest rotation: it begins at its smallest vertex; where it comes by that several times,
/// at the visit after which it goes on smallest.
void start_at_smallest(std::vector<std::uint32_t>& loop);

/// All edges, sorted, with the faces that they bound, each once and ascending: those of edge k are
/// faces[edges[k].first] to faces[edges[k + 1].first]. One more edge stands at the end. O(n log n).
struct EdgeList {
  struct Edge {
    std::uint32_t from = 0, to = 0, first = 0;
  };
  std::vector<Edge> edges;
  std::vector<std::uint32_t> faces;

  std::size_t size() const { return edges.size() - 1; }
  std::span<const std::uint32_t> faces_of(std::size_t k) const {
    return {faces.data() + edges[k].first, faces.data() + edges[k + 1].first};
  }
};
EdgeList edge_list(const std::vector<SpatialFace>& faces);
/// The same as edges without contacts.
std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces);

}  // namespace dymsum::spatial
