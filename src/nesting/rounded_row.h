// The exact set of a row as doubles.
#pragma once

#include "dymsum/nfp_table.h"
#include "dymsum/planar_sum.h"

namespace dymsum::nesting {

struct RoundedRow {
  TableAnswer answer;  ///< without its geometry
  RegionData data;     ///< the closed set with its tight features, in no particular order
};

/// Correctly rounded; repaired where that changes the topology; refused where that does not help either.
RoundedRow rounded_row(const PlanarSum& sum);

}  // namespace dymsum::nesting
