// The boundary of a configuration-space obstacle as triangles: closed, oriented, and within a stated distance of the
// exact surface. For pictures and for programs that want meshes; the obstacle itself stays exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"

namespace dymsum {

struct ObstacleMeshOptions {
  double tolerance = 1e-3;  ///< largest distance, as a fraction of the extent; from 1e-6 to 1
  Progress progress;
};

struct ObstacleTriangle {
  std::array<std::uint32_t, 3> vertices{};  ///< counter-clockwise seen from the free side
  std::uint32_t patch = 0;
  bool closing = false;  ///< in the plane of an event angle: joins the patches that end there to those that begin
  friend bool operator==(const ObstacleTriangle&, const ObstacleTriangle&) = default;
};

/// Triangles from theta = -pi to theta = pi. Both planes show the same slice: `seam` says which vertex of the one is
/// which of the other.
struct ObstacleMesh {
  std::vector<Configuration> vertices;
  std::vector<ObstacleTriangle> triangles;
  std::vector<std::array<std::uint32_t, 2>> seam;  ///< (at -pi, at pi), the same position bit by bit
  double extent = 0;                               ///< the larger of width and height of all slices together
  double tolerance = 0;                            ///< of the options, times the extent
};

/// A closed mesh of the obstacle's boundary. Patches are strips between their two curves of ends; neighbours share the
/// vertices of a curve by their indices, so that no gap can open, whatever is rounded. At every angle a triangle of a
/// patch is within the tolerance of the line of the patch's contact: with a turning radius R, an edge of length L that
/// turns (0 for fixed ones) and steps D of the angle the distance is at most L D / 4 + R D^2 / 8. Curves are halved
/// where they are further from their chord than the tolerance. At event angles the boundaries before and after the
/// event are joined by triangles without area (up to roundings), found by walking contacts and not by comparing
/// positions.
/// Errors: out_of_range for the tolerance; cancelled. Cost: O(T + e log e) for T triangles
/// and e changes of patches.
Result<ObstacleMesh> obstacle_mesh(const CspaceObstacle& obstacle, const ObstacleMeshOptions& options = {});

/// How far a mesh is closed, the two end planes taken as one.
struct MeshClosure {
  std::uint64_t edges = 0;
  std::uint64_t open = 0;     ///< not used once in each direction: a gap
  std::uint64_t crowded = 0;  ///< used several times in each direction: closed, and not a surface there
  double closing_area = 0;    ///< of all closing triangles, in the units of the operands: 0 up to roundings
  bool watertight() const { return open == 0 && crowded == 0; }
};
MeshClosure closure(const ObstacleMesh& mesh);

/// The integral over theta of the area of the slices. Requires: no open edges.
double enclosed_volume(const ObstacleMesh& mesh);

/// The mesh for files: z is theta times extent / (2 pi), so that the full turn is as high as the obstacle is wide. Face
/// k is triangle k.
MeshData mesh_data(const ObstacleMesh& mesh);

/// The same as a closed surface in space: behind the triangles stand the faces of the slice at -pi and of that at pi,
/// as polygons that reach their holes along bridges. Every edge of a mesh that is watertight is then an edge of two
/// faces.
MeshData capped_mesh_data(const ObstacleMesh& mesh);

}  // namespace dymsum
