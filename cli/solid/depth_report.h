// What is told of penetration depths and gaps.
#pragma once

#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/penetration_depth.h"
#include "report.h"

namespace dymsum::cli {

/// meeting, inside, depth, distance, their exact squares, the first shortest move and all of them; where the time was
/// over how far it came.
Json depth_json(const SolidDistance& distance);
Json depth_json(const PlanarDistance& distance);
/// The same for a convex pair that turns.
Json depth_json(const ConvexDepth& depth);

/// All shortest moves, with their contacts.
Json moves_json(const std::vector<PlanarWay>& moves);
/// A line for each of them: its direction, and the features of `p` and `q`, two files, that touch then.
std::string moves_text(const std::vector<PlanarWay>& moves, const std::string& p, const std::string& q);

/// The distance in words; `q` is the file that moves.
std::string depth_text(const SolidDistance& distance, const std::string& p, const std::string& q);
std::string depth_text(const PlanarDistance& distance, const std::string& p, const std::string& q);

}  // namespace dymsum::cli
