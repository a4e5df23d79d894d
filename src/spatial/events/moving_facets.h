// The facets of P (+) Q while one operand scales. The reduced convolution is the same at every s > 0.
#pragma once

#include "spatial/events/facet_graph.h"
#include "spatial/motion/scaling_pair.h"

namespace dymsum::spatial {

class MovingFacets : public ScalingPair {
 public:
  /// Requires operands without thin parts that are not empty.
  MovingFacets(ScalingPair of, StageWatch& watch);

  const ReducedConvolution& convolution() const { return convolution_; }
  const std::vector<SumFacet>& facets() const { return convolution_.facets; }
  /// Their corners and facet edges.
  const FeatureLists<SumPoint>& corners() const { return graph_.corners; }
  const FeatureLists<SumEdge>& facet_edges() const { return graph_.edges; }
  /// Whether a facet edge is between two triangles of one face.
  bool is_inner(std::uint32_t facet_edge) const { return inner_[facet_edge] != 0; }
  /// The same for parallel facet edges.
  std::uint32_t direction(std::uint32_t facet_edge) const { return directions_[facet_edge]; }

  // Planes have indices: those of facets their facet's, and behind them two along every facet edge, whose directions
  // differ: its 2-flat of (x, s) is where they cross.
  std::array<std::uint32_t, 2> planes_of(std::uint32_t facet_edge) const {
    const auto first = static_cast<std::uint32_t>(facets().size()) + 2 * facet_edge;
    return {first, first + 1};
  }
  using ScalingPair::plane;
  const MovingPlane& plane(std::uint32_t index) const { return planes_[index]; }
  const PlaneRow& row(std::uint32_t index) const { return rows_[index]; }
  /// The same for planes that are one at every scale.
  std::uint32_t name(std::uint32_t index) const { return names_[index]; }

 private:
  void add_planes_along(const SumEdge& facet_edge);

  ReducedConvolution convolution_;
  FacetGraph graph_;
  std::vector<std::uint8_t> inner_;
  std::vector<std::uint32_t> directions_, names_;
  std::vector<MovingPlane> planes_;
  std::vector<PlaneRow> rows_;
};

}  // namespace dymsum::spatial
