// The facets of a sum cut by a horizontal plane, and the cells into which they divide it.
#pragma once

#include <memory>
#include <vector>

#include "dymsum/result.h"
#include "spatial/arrangement/contacts.h"
#include "spatial/arrangement/plane_cells.h"
#include "spatial/boundary/collision.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/stage_watch.h"

namespace dymsum::spatial {

/// An interval of the plane's arrangement: where a facet meets it, the facet edge of one that lies in it, or of the
/// frame.
struct SliceSegment {
  static constexpr std::uint32_t kFrame = 0xffffffff;
  PlaneSegment segment;
  std::uint32_t facet = kFrame;  ///< of the table
  bool crossing = false;         ///< the facet has points above and below the plane
};

/// The plane z = height in the space of a sum, within a frame wider than the sum: cells without facets are cells of the
/// frame.
struct SlicePlane {
  std::unique_ptr<SumSpace> space;
  FacetTable table;  ///< of facets that meet the plane
  PlaneId plane = 0;
  std::unique_ptr<PointTable> points;
  std::vector<SliceSegment> segments;
  PlaneCells cells;
  std::vector<PointId> names;  ///< of the points found in the cells: their ids in `points`
  std::uint64_t facets = 0;    ///< of the whole convolution

  PointId point(PointId id) const { return id < cells.known ? id : names[id - cells.known]; }
};

/// Thrown where no space holds the operands with the plane and its frame.
struct NoGridForSlice {
  Error error;
};

/// A height by the operands' own numbers: in doubles, or in their units where no doubles hold them.
struct SliceHeight {
  double z = 0;
  exact::Fraction in_units;
  double by = 1;  ///< the operands' doubles, times this, are multiples of 2^exponent
};

/// Requires operands that are not empty. Throws NoGridForSlice, and what reduced_convolution throws.
SlicePlane slice_plane(const SolidOperand& p, const SolidOperand& q, const SliceHeight& height, StageWatch& watch);

// The cells, edges and points of a slice that lie in the sum.

enum class SliceState : std::uint8_t {
  outside,   ///< not in the sum
  touching,  ///< in the sum: the solids touch and do not overlap
  open,      ///< in the open sum
};

struct SliceStates {
  std::vector<SliceState> cells;
  std::vector<std::uint32_t> cracks, threads;  ///< edges: touching between open cells; in the sum between outer ones
  std::vector<PointId> punctures, dots;        ///< points of PlaneCells: likewise
};

/// Statement: docs/design/solid-sum.md, "Slices". Exact.
SliceStates slice_states(const SlicePlane& plane, const Collision& collision);

}  // namespace dymsum::spatial
