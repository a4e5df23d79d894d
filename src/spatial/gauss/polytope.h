// A convex solid as the engine sees it: integers on its own grid, half-edges, unit normals and directions.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "spatial/gauss/ring_bounds.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// Half-edge 2e runs along edge e from its first vertex to its second, 2e + 1 back. The face on the left of a
/// half-edge, seen from outside, is its face.
using HalfEdge = std::uint32_t;
constexpr HalfEdge twin(HalfEdge h) { return h ^ 1; }

/// A convex solid with only true vertices, edges and faces, unless it was made without merging: then flat edges and
/// vertices stay.
struct Polytope : GridPositions {
  // Vertices.
  std::vector<Vec3>
      from_first;  // place less that of vertex 0, in units of 2^size: components at most 1, relative error below 2^-52
  std::vector<std::uint32_t> source_vertex;  // index in the mesh it was made from
  std::vector<std::uint32_t> ring_start;     // of each vertex, into ring; one more at the end
  std::vector<HalfEdge> ring;                // half-edges that leave a vertex, counter-clockwise seen from outside
  std::vector<Vec3> ring_direction;          // unit vector along each of ring
  std::vector<std::uint32_t> ring_face;      // face on the left of each of ring
  std::vector<Vec3> ring_normal;             // and its outward unit normal
  std::vector<RingOfEight> eight;            // the ring of each vertex once more, for floats
  // Bounds of ring_direction and ring_normal of vertices of many edges; empty where there are no such vertices.
  std::vector<RingBounds> direction_bounds, normal_bounds;
  // Half-edges.
  std::vector<std::uint32_t> origin, face;
  std::vector<HalfEdge> next;  // in the face
  // Edges and faces.
  std::vector<std::array<double, 6>>
      sides;                    // of each edge, the normals of its left and its right face: x, x, y, y, z, z
  std::vector<Vec3> direction;  // unit vector of each edge, error below 2^-50
  std::vector<Vec3> normal;     // outward unit vector of each face, error below 2^-50
  std::vector<Vec3>
      area;  // outward area vector of each face, in units of 4^size; relative error of every component below 2^-50
  std::vector<HalfEdge> first;             // a half-edge of each face at a strictly convex corner
  std::vector<std::uint32_t> source_face;  // the smallest index of the mesh's faces that it was merged from
  double volume = 0;                       // in units of 8^size, relative error below 2^-50
  exact::Big six_volume;                   // six times the volume, in cubed grid units
  double total_area = 0;                   // at least the lengths of all of area together, by at most 2^-40 more
  bool has_flat_edges = false;             // made without merging: faces may lie in one plane
  int size = 0;                            // no vertex is further than 2^size from vertex 0 along an axis

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(source_vertex.size()); }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(direction.size()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(normal.size()); }
  std::uint32_t target(HalfEdge h) const { return origin[twin(h)]; }
  std::span<const HalfEdge> leaving(std::uint32_t v) const {
    return {ring.data() + ring_start[v], ring.data() + ring_start[v + 1]};
  }
  /// The bounds of a vertex of many edges, or nothing.
  const RingBounds* bounds(const std::vector<RingBounds>& of, std::uint32_t v) const {
    return of.empty() || of[v].empty() ? nullptr : &of[v];
  }
  /// The unit vector along a half-edge.
  Vec3 along(HalfEdge h) const { return (h & 1) ? -direction[h / 2] : direction[h / 2]; }

  /// Memory held, without what lies behind arbitrary precision.
  std::size_t bytes() const;

  template <class C>
  auto edge_vector(HalfEdge h) const {
    return position<C>(target(h)) - position<C>(origin[h]);
  }
  /// An outward normal of a face: the cross product of two consecutive edges.
  template <class C>
  auto normal_vector(std::uint32_t f) const {
    const HalfEdge h = first[f];
    return exact::cross(edge_vector<C>(h), edge_vector<C>(next[h]));
  }
};

/// A convex solid with exact vertices, multiples of 2^exponent. Its faces are whole and strictly convex.
struct ExactSolid {
  std::vector<exact::Vector3<exact::Big>> vertices;
  int exponent = 0;
  std::vector<Face> faces;
};

/// The polytope of a convex mesh: coplanar faces merged, flat vertices dropped, or (merge = false) everything as it
/// stands, which must then have triangles only. Errors: not_convex, no_area for the empty mesh, unsupported_operand.
Result<Polytope> make_polytope(const Mesh& mesh, bool merge = true);
Polytope make_polytope(const ExactSolid& solid);

// How far a solid's edges at a vertex rise at most.

/// Calls look(slot) for slots of the ring of v: at least for all whose product of `row` and the unit vector along the
/// edge is at least `least`. O(those) and a few more at vertices of many edges, else O(edges).
template <class Look>
void look_above(const Polytope& p, std::uint32_t v, Vec3 row, double least, const Look& look) {
  const std::uint32_t begin = p.ring_start[v], end = p.ring_start[v + 1];
  const auto all = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t k = first; k < last; ++k)
      if (dot(row, p.ring_direction[begin + k]) >= least) look(k);
  };
  if (const RingBounds* bounds = p.bounds(p.direction_bounds, v)) bounds->look_above(row, least, all);
  else all(0, end - begin);
}

/// The largest product of `row` and a unit vector along an edge that leaves v, which has three or more. At vertices of
/// many edges, where all fall, perhaps something larger: at most a quarter of the largest one, and negative.
inline double most_rise(const Polytope& p, std::uint32_t v, Vec3 row) {
  const auto rise = [&](std::uint32_t k) { return dot(row, p.ring_direction[k]); };
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const std::uint32_t end = p.ring_start[v + 1];
  std::uint32_t k = p.ring_start[v];
  if (const RingBounds* bounds = p.bounds(p.direction_bounds, v))
    return bounds->above_all(row, [&](std::uint32_t slot) { return rise(k + slot); });
  double most = -std::numeric_limits<double>::infinity(),
         also = most;  // two, so that comparisons need not wait for each other
  for (; k + 1 < end; k += 2) {
    most = larger(rise(k), most);
    also = larger(rise(k + 1), also);
  }
  return larger(also, larger(rise(end - 1), most));  // an odd last one, or one once more
}

}  // namespace dymsum::spatial
