// The faces of a part of a sum's boundary in doubles, with their neighbours: what a projection walks on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::depth {

using spatial::Vec3;

inline constexpr std::uint32_t kNoEdge = 0xffffffff;

/// A directed edge of a face, whose inside is on the left seen from outside.
struct SurfaceEdge {
  std::uint32_t from = 0, to = 0, face = 0;
  std::uint32_t twin = kNoEdge;  ///< the same edge of the neighbour; none where a clip box cut the face
  Vec3 along, out;               ///< of length 1, in the face's plane; out of the face. Zero for an edge without length
  double length = 0;
};

struct SurfaceFace {
  Vec3 normal, low, high;             ///< outward; its box
  std::uint32_t first = 0, last = 0;  ///< its edges, all loops
  SolidContact contact;
};

/// A position on the surface and how far away it is.
struct SurfacePoint {
  Vec3 at;
  std::uint32_t face = kNoEdge;  ///< none: on a tight feature, or nothing found
  double distance = 0;
};

struct ContinuousSurface {
  std::vector<Vec3> at;
  std::vector<SurfaceFace> faces;
  std::vector<SurfaceEdge> edges;
  std::vector<SurfaceFace>
      tight;  ///< faces without neighbours, by edges of tight_edges; segments are faces of one edge
  std::vector<SurfaceEdge> tight_edges;
  std::vector<Vec3> tight_points;

  Vec3 start(const SurfaceEdge& e) const { return at[e.from]; }
};

/// Coordinates times `scale`, a power of two. O(n log n).
ContinuousSurface continuous_surface(const SpatialSum& sum, double scale);

/// The boundary of a solid.
ContinuousSurface continuous_surface(const Mesh& mesh, double scale);

/// Whether some face comes within `reach` of a position. O(n).
bool comes_within(const ContinuousSurface& surface, Vec3 from, double reach);

/// The same of one face.
bool face_comes_within(const ContinuousSurface& surface, std::uint32_t face, Vec3 from, double reach);

/// The nearest position, tight features included, and whether `from` is inside: beyond the faces that are nearest. By
/// the best aligned of the faces at the nearest position, as at an edge not all tell. O(n).
struct SurfaceDistance {
  SurfacePoint nearest;  ///< of all
  SurfacePoint face;     ///< of faces
  bool inside = false;
};
SurfaceDistance nearest_on(const ContinuousSurface& surface, Vec3 from);
/// The nearest position of the faces alone. O(n).
SurfacePoint nearest_face(const ContinuousSurface& surface, Vec3 from);

/// Positions of faces no further than `reach` where the distance from `from` has a local minimum, the nearest ones
/// first. O(n log n).
std::vector<SurfacePoint> local_minima(const ContinuousSurface& surface, Vec3 from, double reach);

// A position at which two solids touch.

/// A solid and a tree of its faces' boxes.
struct WitnessSolid {
  ContinuousSurface surface;
  spatial::BoxTree faces;
};
/// Coordinates are turned, then times `sense`, 1 or -1, in the boxes alone.
WitnessSolid witness_solid(ContinuousSurface surface, const spatial::Mat3& turn, double sense);

/// P, and Q as it is before it is turned, with the boxes of -Q turned.
struct WitnessSolids {
  std::shared_ptr<const WitnessSolid> p, q;
  spatial::Mat3 turn{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< of Q
  double size = 0;                                                  ///< of coordinates

  Vec3 turned(std::uint32_t q_vertex) const { return turn * q->surface.at[q_vertex]; }
};

/// A position of both boundaries, and features that hold it up to rounding.
struct Witness {
  Vec3 at;
  SolidContact contact;
};

/// A position where Q at x, a position of the sum's boundary, touches P: by the features that the sum's face names, if
/// they do touch there; else, as faces of several pairs may have been put together to one, by faces that come near each
/// other, named by the smallest features there. Nothing where rounding hides it. O(log n + k) for k pairs of faces that
/// come within rounding of each other.
std::optional<Witness> touching_position(const WitnessSolids& solids, const SolidContact& named, Vec3 x);

}  // namespace dymsum::depth
