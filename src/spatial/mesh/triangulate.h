// Faces split into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "spatial/mesh/half_edges.h"

namespace dymsum::spatial {

// Polygons with holes split into triangles, by a sweep into monotone pieces.

/// What a sweep asks about places in a plane, by their indices: different indices are different positions.
class PlaneOrder {
 public:
  virtual ~PlaneOrder() = default;
  /// Whether a comes before b along a direction, the same for all, in which no two positions are equally far.
  virtual bool before(std::uint32_t a, std::uint32_t b) = 0;
  /// 1 where a, b, c turn left, -1 right, 0 on a line.
  virtual int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) = 0;
};

/// Triangles, counter-clockwise, each with area, whose union is what lies to the left of the rings: an outer one
/// counter-clockwise and its holes clockwise, perhaps several of these. Rings cross nowhere but may touch in vertices;
/// a way there and back may be part of a ring, to a hole, or a ring: a slit. Nothing, or triangles that use every edge
/// of the rings once and all others twice, in opposite directions, where the rings are not such. O(n log n) for n
/// vertices.
std::optional<std::vector<std::array<std::uint32_t, 3>>> sweep_triangles(
    std::span<const std::vector<std::uint32_t>> rings, PlaneOrder& order);

using Triangle = std::array<std::uint32_t, 3>;

/// The side from which a face is looked at: its projection along an axis, turned over where the sign is negative.
struct View {
  exact::Axis axis = exact::Axis::z;
  int sign = 1;
};

/// The view of a valid face. Exact.
View view_of(const FacePlane& plane);
/// A view of a face that is not plane, along the axis of its largest average normal, in doubles.
View average_view(const std::vector<Point3>& vertices, const Face& face);

/// The face as k - 2 triangles of its own k vertices. Where the projection is a simple polygon, as it
/// is for a valid face, they are counter-clockwise in it and each has area; where it is not, they still use every edge
/// of the face once and their other edges twice, in opposite directions. Exact. O(k log k) by a sweep; where that finds
/// no simple polygon, ears are cut: for r corners of at least 180 degrees O(k (r + 1)) where one is always near,
/// O(k^2 (r + 1)) at worst.
std::vector<Triangle> triangulated(const std::vector<Point3>& vertices, const Face& face, View view);

/// All faces of a valid mesh, with the face of every triangle; points and segments have none.
struct Triangles {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> face;
};
Triangles triangulated(const MeshData& data);

}  // namespace dymsum::spatial
