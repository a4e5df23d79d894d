// The facets of P (+) Q while one operand scales. The reduced convolution is the same at every s > 0.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

// Corners and edges of the facets of a convolution, with the facets at each.

inline bool has_corner(const SumFacet& facet, SumPoint corner) {
  const auto end = facet.corner.begin() + facet.corners;
  return std::find(facet.corner.begin(), end, corner) != end;
}
inline bool share_corner(const SumFacet& a, const SumFacet& b) {
  return std::any_of(a.corner.begin(), a.corner.begin() + a.corners, [&](SumPoint c) { return has_corner(b, c); });
}
/// The facet edge from corner k to the next one.
inline SumEdge facet_edge_of(const SumFacet& facet, int k) {
  return {facet.corner[k], facet.corner[(k + 1) % facet.corners]};
}
/// `from` < `to`.
inline SumEdge ordered(const SumEdge& e) { return e.to < e.from ? SumEdge{e.to, e.from} : e; }
inline bool share_end(const SumEdge& a, const SumEdge& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}
inline bool is_of_p(const SumEdge& e) { return e.from.q == e.to.q; }
inline DirectionSource direction_of(const SumEdge& e) {
  return is_of_p(e) ? DirectionSource{DirectionSource::Of::p, e.from.p, e.to.p}
                    : DirectionSource{DirectionSource::Of::q, e.from.q, e.to.q};
}

/// Features of facets, ascending, each with the facets that have it.
template <class Feature>
class FeatureLists {
 public:
  FeatureLists() = default;
  /// feature(facet, k): of a facet's corner k.
  template <class F>
  FeatureLists(const std::vector<SumFacet>& facets, F feature) : of_(4 * facets.size(), kNoId) {
    std::vector<std::pair<Feature, std::uint32_t>> uses;
    for (std::uint32_t f = 0; f < facets.size(); ++f)
      for (int k = 0; k < facets[f].corners; ++k)
        uses.emplace_back(feature(facets[f], k), 4 * f + static_cast<std::uint32_t>(k));
    std::sort(uses.begin(), uses.end());
    for (const auto& [of, position] : uses) {
      if (all_.empty() || all_.back() != of) all_.push_back(of), first_.push_back(facets_.size());
      of_[position] = static_cast<std::uint32_t>(all_.size() - 1);
      facets_.push_back(position / 4);
    }
    first_.push_back(facets_.size());
  }

  const std::vector<Feature>& all() const { return all_; }
  const Feature& operator[](std::uint32_t i) const { return all_[i]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(all_.size()); }
  /// The index of corner k of a facet, or of its facet edge from there.
  std::uint32_t of(std::uint32_t facet, int k) const { return of_[4 * facet + static_cast<std::uint32_t>(k)]; }
  std::span<const std::uint32_t> around(std::uint32_t i) const {
    return std::span(facets_).subspan(first_[i], first_[i + 1] - first_[i]);
  }
  /// Requires a feature that is one of these.
  std::uint32_t index(const Feature& feature) const {
    return static_cast<std::uint32_t>(std::lower_bound(all_.begin(), all_.end(), feature) - all_.begin());
  }

 private:
  std::vector<Feature> all_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> facets_, of_;
};

struct FacetGraph {
  FeatureLists<SumPoint> corners;
  FeatureLists<SumEdge> edges;  ///< ordered

  FacetGraph() = default;
  explicit FacetGraph(const std::vector<SumFacet>& facets)
      : corners(facets, [](const SumFacet& f, int k) { return f.corner[k]; }),
        edges(facets, [](const SumFacet& f, int k) { return ordered(facet_edge_of(f, k)); }) {}
};

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
