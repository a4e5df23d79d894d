#include "spatial/mesh/shell_nesting.h"

#include <limits>
#include <map>
#include <optional>

#include "exact/orient.h"
#include "spatial/mesh/grid_points.h"

namespace dymsum::spatial {
namespace {

/// The side of the directed line ab on which p + (e, e^2) lies, for all small e > 0: never 0, so that a ray through p
/// passes no vertex and no edge. Requires: a and b differ.
int perturbed_side(const Point& a, const Point& b, const Point& p) {
  if (const int side = exact::orient_sign(a, b, p)) return side;
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return a.x < b.x ? 1 : -1;
}

/// How the ray from p towards smaller x passes a triangle, p's y and z being perturbed: 1 where it leaves through its
/// front, -1 where it enters, 0 where it passes by. Requires: p is not in the triangle.
int passage(const Point3& a, const Point3& b, const Point3& c, const Point3& p) {
  const exact::Axis axis = exact::Axis::x;
  const int facing = exact::normal_sign(a, b, c, axis);
  if (facing == 0) return 0;  // seen from its edge
  const Point a2 = dropped(a, axis), b2 = dropped(b, axis), c2 = dropped(c, axis), p2 = dropped(p, axis);
  if (perturbed_side(a2, b2, p2) != facing || perturbed_side(b2, c2, p2) != facing ||
      perturbed_side(c2, a2, p2) != facing) {
    return 0;
  }
  // The face, whose normal has the sign `facing` along x, counts if p is in front of it: then it lies after p along the
  // ray.
  return exact::orient3_sign(a, b, c, p) * facing > 0 ? facing : 0;
}

/// The same for the centre of a triangle, on the grid with all coordinates times three.
class PassageOfCentres {
 public:
  explicit PassageOfCentres(const MeshData& data)
      : points_(grid_points<exact::Big>(data.vertices, space_grid(data.vertices))) {}

  int passage(const Triangle& t, const Triangle& from) const {
    const Point3Big p = plus(plus(points_[from[0]], points_[from[1]]), points_[from[2]]);
    const Point3Big a = tripled(points_[t[0]]) - p, b = tripled(points_[t[1]]) - p, c = tripled(points_[t[2]]) - p;
    const int facing = sign((b - a).y * (c - a).z - (b - a).z * (c - a).y);
    if (facing == 0 || side(a, b) != facing || side(b, c) != facing || side(c, a) != facing) return 0;
    // The sign is that of det(b - a, c - a, p - a), p being the origin.
    return -sign(exact::determinant(a, b, c)) * facing > 0 ? facing : 0;
  }

 private:
  using Point3Big = GridPoint<exact::Big>;

  static Point3Big plus(const Point3Big& a, const Point3Big& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  static Point3Big tripled(const Point3Big& a) { return plus(plus(a, a), a); }
  /// The value of perturbed_side for the origin.
  static int side(const Point3Big& a, const Point3Big& b) {
    if (const int s = sign(a.y * b.z - a.z * b.y)) return s;
    if (a.z != b.z) return a.z < b.z ? -1 : 1;
    return a.y < b.y ? 1 : -1;
  }

  std::vector<Point3Big> points_;
};

/// The position from which the ray of a shell starts: a vertex of its own, or, where it shares all of them, the centre
/// of a triangle.
struct RayStart {
  std::optional<std::uint32_t> vertex;
  std::uint32_t triangle = 0;
};

std::vector<RayStart> ray_starts(const MeshData& data, const Shells& shells, const Triangles& triangles) {
  constexpr std::uint32_t kShared = HalfEdges::kNone - 1;
  std::vector<std::uint32_t> owner(data.vertices.size(), HalfEdges::kNone);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    for (const std::uint32_t v : data.faces[f]) {
      if (owner[v] == HalfEdges::kNone) owner[v] = shells.of_face[f];
      else if (owner[v] != shells.of_face[f]) owner[v] = kShared;
    }
  }
  std::vector<RayStart> starts(shells.count);
  for (std::uint32_t t = 0; t < triangles.triangles.size(); ++t) {
    RayStart& start = starts[shells.of_face[triangles.face[t]]];
    start.triangle = t;
    for (const std::uint32_t v : triangles.triangles[t])
      if (!start.vertex && owner[v] != kShared) start.vertex = v;
  }
  return starts;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells,
                                                      const Triangles& triangles, const BoxTree& boxes) {
  std::vector<std::vector<std::uint32_t>> around(shells.count);
  if (shells.count < 2) return around;
  std::optional<PassageOfCentres> centres;
  const std::vector<RayStart> starts = ray_starts(data, shells, triangles);
  for (std::uint32_t shell = 0; shell < shells.count; ++shell) {
    const RayStart& start = starts[shell];
    if (!start.vertex && !centres) centres.emplace(data);
    Box ray;
    if (start.vertex) {
      const Point3& p = data.vertices[*start.vertex];
      ray.add(Vec3{p.x, p.y, p.z});
    } else {
      ray = boxes.box(start.triangle);
    }
    ray.low.x = -std::numeric_limits<double>::infinity();
    std::map<std::uint32_t, int> winding;
    boxes.for_each(ray, [&](std::uint32_t t) {
      const std::uint32_t other = shells.of_face[triangles.face[t]];
      if (other == shell) return;
      const Triangle& v = triangles.triangles[t];
      winding[other] += start.vertex ? passage(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]],
                                               data.vertices[*start.vertex])
                                     : centres->passage(v, triangles.triangles[start.triangle]);
    });
    for (const auto& [other, turns] : winding)
      if (turns != 0) around[shell].push_back(other);
  }
  return around;
}

std::vector<std::uint32_t> shell_depths(const MeshData& data, const Shells& shells, const Triangles& triangles,
                                        const BoxTree& boxes) {
  std::vector<std::uint32_t> depths;
  for (const std::vector<std::uint32_t>& others : shells_around(data, shells, triangles, boxes))
    depths.push_back(static_cast<std::uint32_t>(others.size()));
  return depths;
}

}  // namespace dymsum::spatial
