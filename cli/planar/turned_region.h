// Regions turned for pictures.
#pragma once

#include <optional>

#include "dymsum/orientation.h"
#include "dymsum/region.h"

namespace dymsum::cli {

/// The region turned about the origin of its coordinates and rounded to doubles: exact at multiples of a quarter turn.
/// Nothing where the rounded rings are no region.
std::optional<Region> turned(const Region& region, const Orientation& theta);

}  // namespace dymsum::cli
