#include "spatial/mesh/face_plane.h"

#include <algorithm>
#include <tuple>

namespace dymsum::spatial {

namespace {

using exact::Axis;

bool lex_less(const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The plane through three points, or axis_sign 0 when they are on one line.
FacePlane plane_through(const std::vector<Point3>& vertices, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (const Axis axis : {Axis::z, Axis::x, Axis::y}) {
    const int sign = exact::normal_sign(vertices[a], vertices[b], vertices[c], axis);
    if (sign != 0) return {a, b, c, axis, sign};
  }
  return {a, b, c, Axis::z, 0};
}

Error at_vertex(ErrorCode code, std::string message, const std::vector<Point3>& vertices, std::uint32_t v) {
  Error error{code, std::move(message), {}};
  error.evidence.vertex = v;
  error.evidence.x = vertices[v].x;
  error.evidence.y = vertices[v].y;
  error.evidence.z = vertices[v].z;
  return error;
}

// The region of the projected face says whether it crosses itself; its evidence counts the face's vertices.
std::optional<Error> crossing_error(const std::vector<Point3>& vertices, const Face& face, const FacePlane& plane) {
  Ring ring = projected(vertices, face, plane);
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  const Result<Region> region = Region::create(std::move(data));
  if (region.ok() && region->touching_points().empty()) return std::nullopt;
  std::size_t corner = 0;
  if (!region) corner = static_cast<std::size_t>(region.error().evidence.vertex.value_or(0));
  return at_vertex(ErrorCode::self_crossing, "a face crosses or touches itself", vertices, face[corner]);
}

}  // namespace

FacePlane face_plane(const std::vector<Point3>& vertices, const Face& face) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < face.size(); ++i) {
    if (lex_less(vertices[face[i]], vertices[face[least]])) least = i;
  }
  const std::size_t n = face.size();
  return plane_through(vertices, face[(least + n - 1) % n], face[least], face[(least + 1) % n]);
}

Ring projected(const std::vector<Point3>& vertices, const Face& face, const FacePlane& plane) {
  Ring ring;
  ring.reserve(face.size());
  for (const std::uint32_t v : face) {
    Point p = exact::dropped(vertices[v], plane.axis);
    if (plane.axis_sign < 0) std::swap(p.x, p.y);
    ring.push_back(p);
  }
  return ring;
}

std::optional<Error> face_error(const std::vector<Point3>& vertices, const Face& face) {
  const std::size_t n = face.size();
  FacePlane plane;
  for (std::size_t i = 2; i < n && plane.axis_sign == 0; ++i) {
    plane = plane_through(vertices, face[0], face[1], face[i]);
  }
  if (plane.axis_sign == 0) {
    return at_vertex(ErrorCode::no_area, "all vertices of a face lie on one line", vertices, face[0]);
  }
  for (const std::uint32_t v : face) {
    if (height_sign(vertices, plane, vertices[v]) == 0) continue;
    return at_vertex(ErrorCode::not_planar, "the vertices of a face do not lie in one plane", vertices, v);
  }
  if (n == 3) return std::nullopt;
  // the corner at the smallest vertex is flat only where the face runs along itself
  plane = face_plane(vertices, face);
  if (plane.axis_sign == 0) {
    return at_vertex(ErrorCode::self_crossing, "a face crosses or touches itself", vertices, plane.b);
  }
  return crossing_error(vertices, face, plane);
}

}  // namespace dymsum::spatial
