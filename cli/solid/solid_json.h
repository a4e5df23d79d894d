// Sums of solids in reports and .json files: one form for all of them.
#pragma once

#include <string>

#include "dymsum/spatial_sum.h"
#include "report.h"

namespace dymsum::cli {

/// The summary of a report. volume_exact is null where it is long, unless it is wanted `exact`.
Json solid_sum_json(const SpatialSum& sum, bool exact);

Json feature_json(const SolidFeature& feature);
/// face_vertex, vertex_face, edge_edge, or merged where several facets are one face.
std::string face_kind(const SpatialFace& face);

}  // namespace dymsum::cli
