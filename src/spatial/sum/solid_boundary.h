// The stages of a solid sum in their order, from operands to the cells that bound it.
#pragma once

#include <memory>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/boundary/tight_features.h"
#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

struct SolidBoundary {
  std::shared_ptr<SumSpace> space;
  FacetTable table;
  std::unique_ptr<SolidArrangement> arrangement;
  std::vector<bool> boundary;        ///< per cell
  std::vector<std::uint32_t> patch;  ///< per cell of the boundary: connected by wedges of the outside
  TightFeatures tight;
  bool either_side = false;  ///< whether a cell of the boundary may have facets of either direction, or of one
};

/// Throws Cancelled and OverBudget.
SolidBoundary solid_boundary(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch);

/// What is known of a convolution beforehand.
struct ConvolutionHints {
  bool inner_dropped = false;  ///< facets deep inside the open sum are left out already
};
/// The same of a space and the facets in it, whatever positions of the operands' vertices the space has.
SolidBoundary solid_boundary(std::unique_ptr<SumSpace> space, ReducedConvolution convolution, const SolidOperand& p,
                             const SolidOperand& q, const ConvolutionHints& hints, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch);
/// The space of a sum: of doubles, or where vertices are exact, of these.
std::unique_ptr<SumSpace> space_of(const SolidOperand& p, const SolidOperand& q);
/// The cells of a boundary whose space and table of facets are there.
void find_cells(SolidBoundary& boundary, SpatialStats& stats, StageWatch& watch);
/// Bytes of facets in the table and on the way into it: their planes and edges, facet edges as segments with upright
/// planes.
std::uint64_t table_bytes(std::size_t facets);

/// The number of inner boxes across the sum, for so many facets: few boxes are many times faster than the facets that
/// they save.
int inner_boxes_across(std::size_t facets);

/// A position off the facets, infinitely near to a cell: in front of it for side 1 or -1 (of the plane's normal),
/// inside it for 0.
Flag flag_at(const SolidArrangement& arrangement, const PlaneGroup& group, const Cell& cell, int side);

}  // namespace dymsum::spatial
