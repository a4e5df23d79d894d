// What the convolution needs of a solid: triangles, the wedges of material along its edges, and the cones of material
// at its vertices that can support a plane. Thin parts, those without volume, have the same: see thin_parts.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh.h"
#include "spatial/convolution/operand_signs.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// What becomes of edges between coplanar faces and of vertices inside edges and faces.
enum class FlatFeatures : std::uint8_t {
  merged,  ///< they belong to the face or edge around them
  kept,    ///< features of their own
};

/// The material at an edge, between two triangles: `left` runs through the edge from `from` to `to`, `right` the other
/// way. An edge where more than two triangles meet has several wedges.
struct Wedge {
  static constexpr std::uint32_t kNone = 0xffffffff;
  enum class Bend : std::uint8_t { convex, flat, reflex };
  std::uint32_t from = 0, to = 0;
  std::uint32_t left = 0, right = 0;            ///< triangles
  std::uint32_t left_apex = 0, right_apex = 0;  ///< their third vertices
  Bend bend = Bend::flat;
  bool is_segment() const { return left == kNone; }  ///< a thin part by itself
};

/// The material at a vertex, where it is contained in a pointed cone: the neighbours along its extreme rays, in order
/// around it.
struct SupportCone {
  std::uint32_t vertex = 0;
  std::uint32_t first = 0, last = 0;  ///< of SolidOperand::rays
  bool flat = false;                  ///< of a thin part: all rays lie in one plane or on one line, in no order
};

struct SolidOperand {
  std::vector<Point3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> face;  ///< of the mesh, per triangle
  std::vector<Wedge> wedges;
  std::vector<std::uint32_t> wedge_of;      ///< at triangle t's side from corner k to k + 1: wedge_of[3 t + k]
  std::vector<std::uint32_t> corner_begin;  ///< of `corners`, per vertex; one more at the end
  std::vector<std::uint32_t> corners;       ///< 3 t + k for every triangle t with the vertex at corner k
  std::vector<SupportCone> cones;
  std::vector<std::uint32_t> rays;          ///< neighbours of the cones' vertices
  std::vector<std::uint32_t> shell;         ///< per triangle: the connected piece of the surface that it belongs to
  std::vector<std::uint32_t> shell_vertex;  ///< one vertex of every such piece
  std::uint32_t first_plate = 0;            ///< triangles from here on are thin: a front, then its back, and so on
  std::vector<std::uint32_t> segments;      ///< wedges that are thin parts by themselves
  std::vector<std::uint32_t> segment_face;  ///< of the mesh, per segment
  std::vector<std::uint32_t> points;        ///< vertices that are thin parts by themselves
  std::vector<std::uint32_t> thin_shell;    ///< per vertex: the shell of thin parts there, or Wedge::kNone
  /// Where no doubles hold the vertices: in units of 2^exponent, which both operands of a sum have then; `vertices` are
  /// near them. Integers, or fractions.
  std::vector<ExactVertex> exact;
  int exponent = 0;

  bool has_solid() const { return first_plate > 0; }
  bool has_thin() const { return !thin_shell.empty(); }

  std::span<const std::uint32_t> rays_of(const SupportCone& cone) const {
    return {rays.data() + cone.first, rays.data() + cone.last};
  }
};

/// Requires triangles whose edges pair up into wedges all around: a closed, oriented surface that does not cross
/// itself, but for the faces that `thin` marks (none where it is empty). `flat` tells of solid parts whether vertices
/// inside faces and straight edges are left out; faces in one plane then are named by the smallest of them.
/// Exact. O(n log n) for bounded degrees, O(k^2) at a vertex with k edges, some of them reflex.
SolidOperand solid_operand(const MeshData& data, const std::vector<bool>& thin = {},
                           FlatFeatures flat = FlatFeatures::merged);
/// The same of vertices that are `exact`, one for each of the data's, which are near them. Flat features are kept.
/// Requires faces with more than three vertices, and none of these else, to have exact doubles.
SolidOperand solid_operand(const MeshData& data, const std::vector<bool>& thin, std::vector<ExactVertex> exact,
                           int exponent);

/// The extreme rays of the cone that the directions from a vertex to its neighbours span, as positions among these, in
/// order around it, the first of those to one neighbour; none where the cone is not pointed, or flat. Requires
/// different directions of different neighbours. O(k^2).
std::vector<std::uint32_t> extreme_rays(const OperandSigns& signs, std::uint32_t vertex,
                                        std::span<const std::uint32_t> neighbours);

}  // namespace dymsum::spatial
