// Whether the faces of a closed surface stay apart: two faces may share a vertex, or a whole edge of both, and nothing
// else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// Two faces with a common point that belongs to no common vertex or edge.
struct FaceMeeting {
  std::uint32_t face = 0, other_face = 0;  ///< face < other_face
  Point3 at;                               ///< near the common point: rounded
};

/// The boxes of triangles.
BoxTree boxes_of(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles);

/// The meeting of the smallest face with the smallest other one, or nothing. Requires faces that are valid by
/// themselves, vertices at different positions, and two faces at every edge; `triangles` are those of the faces,
/// `boxes` theirs. Exact: signs of orientations of three and four vertices. O((n + k) log n) for k pairs of triangles
/// with overlapping boxes.
std::optional<FaceMeeting> find_meeting(const MeshData& data, const Triangles& triangles, const BoxTree& boxes);

/// All meetings of two triangles, one of which is `queried` for, the smaller index first, sorted. The same
/// requirements, but edges may have any number of faces.
std::vector<std::array<std::uint32_t, 2>> find_meetings(const MeshData& data, const Triangles& triangles,
                                                        const BoxTree& boxes, const std::vector<bool>& queried);
/// Of a surface whose faces are the triangles.
std::vector<std::array<std::uint32_t, 2>> find_meetings(const std::vector<Point3>& vertices,
                                                        const std::vector<Triangle>& triangles, const BoxTree& boxes,
                                                        const std::vector<bool>& queried);

}  // namespace dymsum::spatial
