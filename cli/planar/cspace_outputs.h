// Files of a configuration-space obstacle: its patches as JSON, its boundary as GLB, slices as a film strip.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/obstacle_mesh.h"
#include "report.h"

namespace dymsum::cli {

/// The shells: outer or cavity, sizes, component of free space.
Json shells_json(const CspaceObstacle& obstacle);

/// Patches, event angles, events, shells and cells of free space, everything that CspaceObstacle lists.
Json obstacle_json(const CspaceObstacle& obstacle);

/// Fixed and rotating contacts in two hues, shades by shell; scale, error and the meeting of top and bottom are noted
/// in the file. The slice at -pi and pi closes the surface, or is left open.
enum class Ends { capped, open };
std::string obstacle_glb(const CspaceObstacle& obstacle, const ObstacleMesh& mesh, Ends ends);

/// Exact slices at the simplest orientations within a thousandth of a step of equal steps of the turn, up to pi.
std::string slice_strip(const CspaceObstacle& obstacle, std::size_t slices, const Progress& progress);

/// The sizes of the mesh of a GLB file, and whether it is closed.
Json mesh_json(const ObstacleMesh& mesh);

}  // namespace dymsum::cli
