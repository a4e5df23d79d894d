#include "spatial/mesh/shell_nesting.h"

#include <limits>
#include <map>

#include "exact/orient3.h"

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
  // In front of a face whose normal has the sign `facing` along x: behind p, along the ray, lies the face.
  return exact::orient3_sign(a, b, c, p) * facing > 0 ? facing : 0;
}

}  // namespace

std::vector<std::uint32_t> shell_depths(const MeshData& data, const Shells& shells, const Triangles& triangles,
                                        const BoxTree& boxes) {
  std::vector<std::uint32_t> depths(shells.count);
  if (shells.count < 2) return depths;
  std::vector<bool> seen(shells.count);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    const std::uint32_t shell = shells.of_face[f];
    if (seen[shell]) continue;
    seen[shell] = true;
    const Point3& p = data.vertices[data.faces[f][0]];
    Box ray;
    ray.low = {-std::numeric_limits<double>::infinity(), p.y, p.z};
    ray.high = {p.x, p.y, p.z};
    std::map<std::uint32_t, int> winding;
    boxes.for_each(ray, [&](std::uint32_t t) {
      const std::uint32_t other = shells.of_face[triangles.face[t]];
      const Triangle& v = triangles.triangles[t];
      if (other != shell) winding[other] += passage(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]], p);
    });
    for (const auto& [other, turns] : winding) depths[shell] += turns != 0;
  }
  return depths;
}

}  // namespace dymsum::spatial
