// Files, pictures and summaries of solid sums.
#pragma once

#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh_io.h"
#include "report.h"
#include "solid_operands.h"

namespace dymsum::cli {

/// Usage errors for outputs that cannot be written, before any long work.
void check_solid_outputs(const std::vector<std::string>& files);
/// .json the exact sum with provenance, otherwise a mesh in which facets are coloured by kind, or red where they changed.
std::string solid_output(const SolidSum& sum, const std::string& file);

/// face + vertex, vertex + face, edge + edge, merged.
std::string facet_kind(const SolidFacet& facet);
std::vector<FaceColour> facet_colours(const SolidSum& sum);

Json solid_sum_json(const SolidSum& sum);
Json feature_json(const SolidFeature& feature);

}  // namespace dymsum::cli
