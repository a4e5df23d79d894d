// The cells of a scaling family: the events of its interval, the structure of the sum between each two, and the sum at
// a scale.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/family.h"
#include "dymsum/scale.h"
#include "planar/family/scaled_positions.h"
#include "planar/family/sum_structures.h"
#include "planar/frame/event_walk.h"

namespace dymsum::planar {

struct ScalingCells {
  ScalingPath path;
  exact::BigRational unit;  ///< the scale of `path` over that of the family
  bool unit_is_one = true;
  std::vector<ScaleEvent> events;  ///< of the family, in order
  SumStructures structures;        ///< of cell k, between events k - 1 and k
  std::vector<double> named_at;    ///< of cell k: the scale of `path` at which its new names stand on the boundary
  std::unique_ptr<ScaledPositions> positions;

  struct Location {
    std::uint32_t index = 0;
    bool event = false;
  };
  /// The event that a scale is, or its cell. O(log n).
  Location locate(const Scale& s) const;
  /// The scales along both axes at a scale t of `path`. Errors: bad_scale.
  Result<std::array<Scale, 2>> scales(const exact::BigRational& t) const;
  /// Takes over the structure of the next cell: that of a sum in it, at a scale of `path`.
  void add_cell(const PlanarSum& sum, std::span<const std::uint64_t> rings, double at);
  /// The next cell, whose structure is not kept.
  void add_dropped_cell();
  /// The sum at a scale. Requires: it lies in the interval. Errors: as sums from scratch.
  Result<PlanarSum> at(const Scale& s, Semantics semantics) const;

 private:
  /// The scale of the path. Requires: s lies in the interval.
  Scale of_path(const Scale& s) const;
  Result<PlanarSum> from_scratch(const Scale& s, Semantics semantics) const;
  PlanarSum in_cell(std::uint32_t cell, const Scale& s) const;
};

/// A family without events and cells yet. Errors: those of ScalingFamily::create for operands and ratio.
Result<ScalingCells> empty_cells(const Region& p, const Region& q, const Scale& ratio, const FamilyOptions& options);

/// Errors: those of ScalingFamily::create.
Result<ScalingCells> scaling_cells(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                   const Scale& ratio, const FamilyOptions& options);

}  // namespace dymsum::planar
