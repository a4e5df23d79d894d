// Pictures of bridges, pocket minima and bars, and of a region cut into pieces.
#pragma once

#include <string>
#include <vector>

#include "dymsum/decomposition.h"
#include "dymsum/shape_features.h"

namespace dymsum::cli {

/// The vertices in the order in which bars and bridges number them.
std::vector<Point> vertices_of(const Region& region);

/// The region, its sum with the disc (if any), bridges with their pocket minima, and the bars beside it; those of
/// `kept` are strong.
std::string features_picture(const ShapeFeatures& features, const Region& sum, const std::vector<AlphaBridge>& bridges,
                             double alpha, const std::vector<std::uint32_t>& kept);

/// The pieces in colours, and the cuts.
std::string decomposition_picture(const Region& region, const Decomposition& decomposition);

}  // namespace dymsum::cli
