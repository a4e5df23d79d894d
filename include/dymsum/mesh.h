// Solids bounded by polygons: the one mesh type. A mesh is the boundary of a closed solid; it may have several shells
// and may be empty. It may also hold thin parts, those without volume: points, segments, polylines, plane polygons and
// open surfaces (Mesh::with_thin_parts).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dymsum/result.h"

namespace dymsum {

namespace spatial {
struct MeshInternals;
}

struct Point3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Point3&, const Point3&) = default;
};

/// A plane polygon without holes, by its vertices' indices, counter-clockwise seen from outside; the last is joined to
/// the first. Of thin parts: with two vertices a segment, with one a point.
using Face = std::vector<std::uint32_t>;

/// The plain lists a mesh is made from, not yet validated.
struct MeshData {
  std::vector<Point3> vertices;
  std::vector<Face> faces;
  friend bool operator==(const MeshData&, const MeshData&) = default;
};

/// A valid mesh. Coordinates are doubles taken at face value: no snapping, no tolerance.
///
/// Valid means, exactly: all coordinates finite; every vertex used and no two at the same position; every face is a
/// polygon of at least three vertices in one plane that does not cross or touch itself; every edge has two faces, which
/// run through it in opposite directions, or, where the solid touches itself, more, which do so by turns around it; two
/// faces have nothing in common but common vertices and edges; every shell encloses volume and runs outward, or inward
/// around a cavity where an odd number of others lie around it. Solids that touch at an edge or a vertex are different
/// shells, unless the solid's inside connects them elsewhere.
class Mesh {
 public:
  Mesh() = default;  ///< the empty mesh

  /// Validates `data`. Errors: not_finite, bad_index (also for a vertex without a face), too_few_vertices,
  /// repeated_vertex, no_area (of a face, or a shell without volume), not_planar, self_crossing, not_closed,
  /// not_manifold (an edge with an odd number of faces, or with faces that do not bound inside and outside by turns),
  /// wrong_orientation (two faces run through an edge in the same direction, or a shell is inside out), faces_cross,
  /// each with face, vertex (and the other ones) and a position. Cost: O((n + k) log n) for k pairs of faces with
  /// overlapping boxes.
  static Result<Mesh> create(MeshData data);

  /// A set of any dimension, the union of a solid and thin parts. Points and segments are thin; so is a face with an
  /// edge that no other face has, then its neighbours that are left with such an edge, and so on: an open surface as a
  /// whole, not a solid to which a fin is attached. What is left has to be the boundary of a solid. Thin faces may lie
  /// anywhere, cross and overlap each other and the solid; it does not matter which way they run. A surface that is
  /// closed bounds a solid. Faces that part the inside of the solid are thin, too: membranes, at whose edges there are
  /// more faces than bound.
  /// Errors: as create. A solid from which one triangle is missing is an open surface here: that is why create refuses
  /// it.
  static Result<Mesh> with_thin_parts(MeshData data);

  const MeshData& data() const { return data_; }
  const std::vector<Point3>& vertices() const { return data_.vertices; }
  const std::vector<Face>& faces() const { return data_.faces; }
  bool empty() const { return data_.faces.empty(); }
  std::size_t shell_count() const { return shells_; }  ///< of the solid
  /// Whether each face is thin; empty where none is.
  const std::vector<bool>& thin_faces() const { return thin_; }
  bool has_thin_parts() const { return !thin_.empty(); }
  /// Pairs of vertices that an edge joins.
  std::size_t edge_count() const;
  /// How many triangles the faces split into.
  std::size_t triangle_count() const;

  /// The same solid written in one way: coplanar neighbours merged into faces (where the union has no hole and touches
  /// itself nowhere), vertices inside straight edges and of faces dropped, vertices sorted by x, y, z, every
  /// face starting at its smallest vertex, faces sorted. Convex solids that are equal have equal canonical forms. With
  /// thin parts nothing is merged.
  Mesh canonical() const;

  /// Equality of canonical forms.
  friend bool operator==(const Mesh& a, const Mesh& b);

 private:
  friend struct spatial::MeshInternals;
  MeshData data_;
  std::size_t shells_ = 0;
  std::vector<bool> thin_;
};

/// Nothing for a convex solid (flat edges between coplanar faces are allowed), else the error not_convex with the
/// reflex edge and its two faces, or why there is none: several shells, thin parts; no_area for the empty mesh. Exact.
/// O(n).
std::optional<Error> convexity_error(const Mesh& mesh);

/// What repair changed, as counts and in words.
struct MeshRepairReport {
  std::size_t duplicate_vertices = 0;  ///< vertices at the same position merged
  std::size_t unused_vertices = 0;     ///< vertices without a face dropped
  std::size_t degenerate_faces = 0;    ///< faces without area dropped
  std::size_t needles = 0;             ///< triangles dropped that are nearly a line, and lay on their neighbours
  std::size_t split_edges = 0;         ///< edges of faces split at vertices of their neighbours
  /// How far the furthest such vertex was from its edge; 0 where all lay on theirs exactly.
  double largest_gap = 0;
  std::size_t cracks = 0;           ///< vertices of open edges that became one that was next to them
  double largest_crack = 0;         ///< the largest distance between the two
  std::size_t holes = 0;            ///< small loops of open edges that got triangles
  std::size_t split_faces = 0;      ///< faces that are not plane, or have a vertex twice, split into triangles
  std::size_t reversed_shells = 0;  ///< shells turned inside out made right
  std::size_t cavities = 0;         ///< shells that ran the same way as the one around them, and bound cavities now
  std::size_t reversed_faces = 0;   ///< single faces turned over to agree with their neighbours
  std::size_t membranes = 0;        ///< faces with the solid on both sides dropped
  /// Whether faces crossed, touched or lay on each other, and what they bound was united (repair_with_union).
  bool united = false;
  std::size_t united_crossings = 0;  ///< vertices of the result that are none of the surface's
  /// Where rounding those made faces meet, and they were merged: no point moved further. 0: nothing but rounding.
  double united_distance = 0;
  bool changed() const {
    return united || duplicate_vertices + unused_vertices + degenerate_faces + needles + split_edges + cracks + holes +
                             split_faces + reversed_shells + reversed_faces + membranes >
                         0;
  }
  std::string to_string() const;
};

struct RepairedMesh {
  Mesh mesh;
  MeshRepairReport report;
};

/// The named repair: merges vertices at exactly the same position, drops unused vertices and faces without area, closes
/// T-junctions, splits faces that are not plane or that have a vertex twice (a bridge to a hole), orients faces and
/// shells, and reports what it changed.
///
/// A T-junction is an edge with one face along which vertices of other faces lie: it is split at them. They lie on it
/// exactly, or else the open edges between them lead from one end of it to the other, no further from it than 2^-13 of
/// its length, as rounding leaves them. Where faces cross, triangles as narrow as that are dropped, and their longest
/// edges split. A shell that runs the same way as the one around it bounds a cavity afterwards (`cavities`).
///
/// A crack is open edges whose vertices should be those of others: vertices of open edges become one where they are
/// nearer than 2^-20 of the surface's diagonal. A small hole is a loop of at most 64 open edges, all together no longer
/// than half of the diagonal: it is filled. Neither is done where parts without volume are kept.
///
/// Other open edges and edges with an odd number of faces are not repaired: they come back as the errors of
/// Mesh::create, with the indices of `data`.
Result<RepairedMesh> repair(MeshData data);

/// The same for Mesh::with_thin_parts: points, segments and open surfaces stay, which way they run too. Errors: as
/// with_thin_parts.
Result<RepairedMesh> repair_with_thin_parts(MeshData data);

/// The convex hull of points, exactly, in canonical form. Errors: not_finite; no_area when all points lie in one plane.
/// O(n^2) at worst, about O(n log n) for points in random order.
Result<Mesh> convex_hull(std::span<const Point3> points);

/// What taking the hull changed.
struct HullReport {
  std::size_t vertices = 0;         ///< that faces use, at different positions
  std::size_t inside_vertices = 0;  ///< of these, strictly inside the hull
  std::size_t unused_vertices = 0;  ///< that no face uses: left out
  /// No point of the old surface is further than this below the hull's, up to a relative error of 2^-48; 0 exactly
  /// where the surface is that of the hull. A bound that is reached where the deepest point is a vertex near the faces
  /// around it. Of points without faces the depth of the deepest one.
  double deviation = 0;
  std::string to_string() const;
};

struct HulledMesh {
  Mesh mesh;
  HullReport report;
};

/// The named way in for solids that are convex but for rounding: the exact convex hull of the vertices that faces use
/// (of all vertices where there are no faces), in canonical form, and how far the surface was from it. `data` need not
/// be valid. Errors: not_finite, bad_index, no_area when all vertices lie in one plane. Cost: that of convex_hull, and
/// vertices inside times faces of the hull.
Result<HulledMesh> hulled(const MeshData& data);

/// A convex solid moved by (dx, dy, dz): the hull of its vertices, each coordinate rounded to the nearest double once,
/// so it stays convex wherever it goes. The report's deviation is the largest distance of a vertex from its exact
/// position; no point of the two solids is further from the other one. Errors: as convexity_error; not_finite; no_area
/// when everything collapses into a plane.
Result<HulledMesh> translated_hull(const Mesh& mesh, double dx, double dy, double dz);

/// Faces split into triangles of their own vertices. Points and segments stay as they are.
struct TriangulatedMesh {
  Mesh mesh;
  std::vector<std::uint32_t> face;  ///< of every triangle: the index of the face that it is part of
};
TriangulatedMesh triangulated(const Mesh& mesh);

/// How exactly a file holds coordinates.
enum class Precision : std::uint8_t { doubles, singles };

/// Volume and surface for reports: the volume is the exact sum rounded once, the surface is rounded at every face (thin
/// faces count once).
double volume(const Mesh& mesh);
double surface_area(const Mesh& mesh);

/// Smallest and largest coordinates {min x, min y, min z, max x, max y, max z}; zeros for the empty mesh.
std::array<double, 6> bounds(const Mesh& mesh);

/// -mesh: the reflection through the origin. Exact.
Mesh negated(const Mesh& mesh);

/// mesh + (dx, dy, dz), each coordinate rounded to the nearest double. Errors as Mesh::create when rounding spoils
/// validity.
Result<Mesh> translated(const Mesh& mesh, double dx, double dy, double dz);

/// diag(sx, sy, sz) mesh, each coordinate rounded to the nearest double (exact for powers of two); a reflecting scale
/// keeps the outside outside. Errors: unsupported_operand for zero or non-finite factors, then as Mesh::create.
Result<Mesh> scaled(const Mesh& mesh, double sx, double sy, double sz);

}  // namespace dymsum
