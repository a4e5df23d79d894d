// Positions outside the open sum that nothing outside the closed sum comes near: passages exactly as wide as the part.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/boundary/collision.h"

namespace dymsum::spatial {

struct TightFeatures {
  std::vector<std::uint32_t> cells;              ///< of the arrangement
  std::vector<std::array<PointId, 2>> segments;  ///< edges of the arrangement that bound no tight cell
  std::vector<PointId> points;                   ///< that end no tight segment
  std::uint64_t tests = 0;
};

/// `boundary` tells of every cell whether it bounds the regular part of the sum's complement. `every_position` leaves
/// out no test, for reference. Statement and what is left out without a test: docs/design/solid-sum.md, "Tight
/// features". With a scope only what is in it is looked at; around its points everything has to be. Exact.
TightFeatures tight_features(const SumSpace& space, const FacetTable& table, const SolidArrangement& arrangement,
                             const std::vector<bool>& boundary, const Collision& collision, bool every_position,
                             StageWatch& watch, const ArrangementScope* scope = nullptr);

}  // namespace dymsum::spatial
