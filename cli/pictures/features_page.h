// A page of what a growing disc sees: bridges and pocket minima at the diameter of a slider, bars with a cursor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/shape_features.h"
#include "progress_bar.h"

namespace dymsum::cli {

/// Diameters from 0 to `last`; to a little beyond the last death where it is 0. Bars of `kept` are strong; their
/// bridges are shown first, of each diameter the longest 150, and the caption tells how many there are.
std::string features_page(const ShapeFeatures& features, double last, const std::vector<std::uint32_t>& kept,
                          const std::string& title, const Progress& progress);

}  // namespace dymsum::cli
