// The driver of planar sums: the stages of docs/design/planar-sum.md in their order.
#pragma once

#include <memory>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/arrangement/live_pieces.h"
#include "planar/boundary/boundary.h"
#include "planar/result/sum_source.h"

namespace dymsum::planar {

/// What the boundary engines find, before canonical output.
struct RawBoundary {
  std::vector<SumRing> rings;        ///< interior on the left
  std::vector<std::uint8_t> outer;   ///< per ring: counter-clockwise
  std::vector<SumSegment> cracks;    ///< closed sub-edges of tight segments, not merged
  std::vector<SumVertex> punctures;  ///< candidates that are not on cracks are tight points
  double at_error = 0;               ///< |at - exact| in input coordinates
};

struct SumState {
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
  RawBoundary boundary;
  SumStats stats;
  std::unique_ptr<PlanarTrace> trace;
};

/// Operands (P as operand 0, Q as 1) on their lattice, then the boundary by the chosen engine. Refine::always is for
/// tests: a mask refined in all live cells, whatever that costs. Errors: as minkowski_sum; unsupported_operand, with
/// stage and counts, where memory or 32-bit indices do not suffice.
Result<SumState> compute_boundary(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                                  const SumOptions& options, Refine refine = Refine::where_it_pays);

/// The same for operands that are already on a lattice: state.lattice, state.p, state.q.
Result<SumState> compute_boundary(SumState state, const SumOptions& options);

/// Appends the cracks and punctures of an arrangement; `kept` are its true loops. Grows `grid_error` to the largest
/// error of a position.
void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error);

/// Canonical order, parts, tight features, lower-dimensional pieces.
PlanarSum finish_sum(SumState&& state, const SumOptions& options);

/// Lower-dimensional pieces of the closed sum: segments and points from pairs of components without area. Appends
/// candidates.
void lower_dimensional_candidates(const Lattice& lattice, const Operand& p, const Operand& q,
                                  std::vector<SumSegment>& segments, std::vector<SumVertex>& points);

/// Positions of candidates -> maximal pieces with provenance.
void merge_pieces(const SumSource& source, const std::vector<SumPart>& parts, const std::vector<SumSegment>& candidates,
                  const std::vector<SumVertex>& candidate_points, std::vector<SumSegment>& segments,
                  std::vector<SumVertex>& points);

}  // namespace dymsum::planar
