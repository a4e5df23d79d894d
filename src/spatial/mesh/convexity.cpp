// Whether a mesh bounds a convex solid.
//
// A connected closed surface bounds a convex solid exactly when (1) at no edge the solid's angle exceeds 180 degrees,
// (2) the barycentre o of four of its vertices is strictly below the planes of all faces, and (3) the projection from o
// to directions covers a direction once (after Mehlhorn, Naeher, Seel, Seidel, Schilz, Schirra, Uhrig: Checking
// geometric programs or verification of geometric structures, 1999). By (2) the projection turns no face over, so that
// its degree is the number of faces over a direction, and by (3) the surface is seen from o without overlaps; then
// convex edges make it the boundary of a convex solid. A convex solid has o in its interior.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "exact/orient3.h"
#include "spatial/mesh/edge_bend.h"
#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/grid_points.h"
#include "spatial/mesh/half_edges.h"

namespace dymsum {

namespace spatial {

namespace {

using exact::Big;
using exact::Int;

Error not_convex(std::string message, std::uint32_t face) {
  Error error{ErrorCode::not_convex, std::move(message), {}};
  error.evidence.face = face;
  return error;
}

Error bad_edge(const MeshData& data, const HalfEdges& edges, std::uint32_t h, Bend bend) {
  Error error =
      not_convex(bend == Bend::reflex ? "an edge is reflex" : "two faces lie on top of each other", edges.face[h]);
  const std::uint32_t v = edges.origin[h];
  error.evidence.other_face = edges.face[edges.twin[h]];
  error.evidence.vertex = v;
  error.evidence.other_vertex = edges.target(h);
  error.evidence.x = data.vertices[v].x;
  error.evidence.y = data.vertices[v].y;
  error.evidence.z = data.vertices[v].z;
  return error;
}

/// Four vertices that are not in one plane: the three of a face's plane and one off it. A shell with volume has them.
std::array<std::uint32_t, 4> tetrahedron(const MeshData& data, const FacePlane& plane) {
  std::uint32_t top = 0;
  while (height_sign(data.vertices, plane, data.vertices[top]) == 0) ++top;
  return {plane.a, plane.b, plane.c, top};
}

// Seen from o = (p + q + r + s) / 4, scaled by four: |4 v - (p + q + r + s)| <= 2^(B+3), determinants 3B + 12 bits.
template <class C>
struct FromCentre {
  using Coordinate = Big;
};
template <int B>
struct FromCentre<Int<B>> {
  using Coordinate = Int<B + 3>;
  using Vector = GridPoint<Coordinate>;
  static_assert(decltype(exact::determinant(Vector{}, Vector{}, Vector{}))::kBits == 3 * B + 12);
};

template <class C>
using Vector = GridPoint<typename FromCentre<C>::Coordinate>;

/// All points seen from the barycentre of four of them, times four.
template <class C>
std::vector<Vector<C>> from_barycentre(const std::vector<GridPoint<C>>& points, const std::array<std::uint32_t, 4>& o) {
  const auto line = [&](auto coordinate) {
    const auto at = [&](std::size_t k) { return coordinate(points[o[k]]); };
    return (at(0) + at(1)) + (at(2) + at(3));
  };
  const auto x = line([](const auto&p) { return p.x; }), y = line([](const auto&p) { return p.y; }),
             z = line([](const auto&p) { return p.z; });
  std::vector<Vector<C>> seen;
  seen.reserve(points.size());
  using exact::shift_left;
  for (const GridPoint<C>& p : points)
    seen.push_back({shift_left<2>(p.x) - x, shift_left<2>(p.y) - y, shift_left<2>(p.z) - z});
  return seen;
}

/// Directions from o as vectors, and how often faces cover one.
template <class V>
class Coverage {
 public:
  /// The direction is that of vertex `first`, moved by an arbitrarily small amount towards `second`, and by an
  /// arbitrarily smaller one towards `third`: it lies in the plane of no two vertices. Requires the three independent.
  Coverage(const std::vector<V>& seen, std::array<std::uint32_t, 3> direction) : seen_(seen), direction_(direction) {}

  /// How often the face covers the direction: the signed count over the triangles of its fan.
  int of(const Face& face) const {
    int count = 0;
    for (std::size_t k = 2; k < face.size(); ++k) count += of_triangle(face[0], face[k - 1], face[k]);
    return count;
  }

 private:
  int of_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    // all sides disagree with the triangle's own turn where it covers the opposite direction
    const int turn = sign(exact::determinant(seen_[a], seen_[b], seen_[c]));
    return side(a, b) == turn && side(b, c) == turn && side(c, a) == turn ? turn : 0;
  }
  /// The side of the plane through o, u and v on which the direction lies.
  int side(std::uint32_t u, std::uint32_t v) const {
    for (const std::uint32_t d : direction_) {
      const int s = sign(exact::determinant(seen_[u], seen_[v], seen_[d]));
      if (s != 0) return s;
    }
    return 0;  // u and v in one direction: a diagonal of a face seen from its own plane, which (2) excludes
  }

  const std::vector<V>& seen_;
  std::array<std::uint32_t, 3> direction_;
};

/// Conditions (2) and (3).
template <class C>
std::optional<Error> winding_error(const MeshData& data, const std::vector<FacePlane>& planes,
                                   const std::vector<GridPoint<C>>& points) {
  const std::vector<Vector<C>> seen = from_barycentre(points, tetrahedron(data, planes[0]));
  for (std::uint32_t f = 0; f < planes.size(); ++f) {
    const FacePlane& p = planes[f];
    if (sign(exact::determinant(seen[p.a], seen[p.b], seen[p.c])) > 0) continue;
    return not_convex("a face turns away from the middle of the solid", f);
  }
  const Coverage<Vector<C>> coverage(seen, {planes[0].a, planes[0].b, planes[0].c});
  int count = 0;
  for (std::uint32_t f = 0; f < planes.size(); ++f) {
    count += coverage.of(data.faces[f]);
    if (count > 1) return not_convex("the surface winds around itself", f);
  }
  return std::nullopt;
}

}  // namespace

}  // namespace spatial

std::optional<Error> convexity_error(const Mesh& mesh) {
  using namespace spatial;
  if (mesh.empty()) return Error{ErrorCode::no_area, "the mesh is empty", {}};
  if (mesh.has_thin_parts()) {
    const std::vector<bool>& thin = mesh.thin_faces();
    const auto first = std::find(thin.begin(), thin.end(), true) - thin.begin();
    return not_convex("the mesh has parts without volume", static_cast<std::uint32_t>(first));
  }
  const MeshData& data = mesh.data();
  const HalfEdges edges = half_edges(data);
  if (mesh.shell_count() > 1) {
    const Shells shells = find_shells(edges);
    const auto second = std::find(shells.of_face.begin(), shells.of_face.end(), 1u);
    return not_convex("the mesh has several shells", static_cast<std::uint32_t>(second - shells.of_face.begin()));
  }
  const std::vector<FacePlane> planes = face_planes(data);
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (h > edges.twin[h]) continue;
    const Bend bend = edge_bend(data, edges, planes, h);
    if (bend == Bend::reflex || bend == Bend::folded) return bad_edge(data, edges, h, bend);
  }
  return with_grid_points(data.vertices, space_grid(data.vertices),
                          [&](const auto& points) { return winding_error(data, planes, points); });
}

}  // namespace dymsum
