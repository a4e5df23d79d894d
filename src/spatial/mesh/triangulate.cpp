#include "spatial/mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "spatial/mesh/sweep_triangles.h"

namespace dymsum::spatial {

namespace {

using exact::Axis;

/// The positions of a face as it is looked at, along one of the two axes that are seen and, of equal ones, the other.
class FaceOrder final : public PlaneOrder {
 public:
  FaceOrder(const std::vector<Point3>& vertices, View view) : vertices_(vertices), view_(view) {}

  bool before(std::uint32_t a, std::uint32_t b) override {
    const Point3 &p = vertices_[a], &q = vertices_[b];
    if (view_.axis == Axis::x) return std::tie(p.y, p.z) < std::tie(q.y, q.z);
    if (view_.axis == Axis::y) return std::tie(p.z, p.x) < std::tie(q.z, q.x);
    return std::tie(p.x, p.y) < std::tie(q.x, q.y);
  }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    return view_.sign * exact::normal_sign(vertices_[a], vertices_[b], vertices_[c], view_.axis);
  }

 private:
  const std::vector<Point3>& vertices_;
  View view_;
};

/// A polygon that loses its ears one by one; corners are positions in the face.
class Ears {
 public:
  Ears(const std::vector<Point3>& vertices, const Face& face, View view)
      : vertices_(vertices), face_(face), view_(view) {
    const std::size_t n = face.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (turn(i) <= 0) blunt_.push_back(i);
    }
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    std::size_t at = 0;
    bool simple = true;
    for (std::size_t left = face_.size(); left >= 3; --left) {
      const std::optional<std::size_t> clear = simple ? find_ear(at, left) : std::nullopt;
      simple = clear.has_value();
      const std::size_t ear = clear.value_or(at);
      triangles.push_back({face_[previous_[ear]], face_[ear], face_[next_[ear]]});
      next_[previous_[ear]] = next_[ear];
      previous_[next_[ear]] = previous_[ear];
      std::erase_if(blunt_, [&](std::size_t i) { return i == ear || turn(i) > 0; });
      at = next_[ear];
    }
    return triangles;
  }

 private:
  int side(std::size_t a, std::size_t b, std::size_t c) const {
    return view_.sign * exact::normal_sign(vertices_[face_[a]], vertices_[face_[b]], vertices_[face_[c]], view_.axis);
  }
  bool same(std::size_t a, std::size_t b) const { return vertices_[face_[a]] == vertices_[face_[b]]; }
  int turn(std::size_t i) const { return side(previous_[i], i, next_[i]); }

  /// A convex corner whose closed triangle holds no other corner; only blunt ones can be in its way. A simple polygon
  /// always has one. At a bridge to a hole two corners are at the same position: they are not in each other's way.
  std::optional<std::size_t> find_ear(std::size_t start, std::size_t left) const {
    for (std::size_t i = start; left > 0; --left, i = next_[i]) {
      if (turn(i) > 0 && is_clear(i)) return i;
    }
    return std::nullopt;
  }

  bool is_clear(std::size_t ear) const {
    const std::size_t a = previous_[ear], c = next_[ear];
    return std::none_of(blunt_.begin(), blunt_.end(), [&](std::size_t i) {
      return !same(i, a) && !same(i, ear) && !same(i, c) && side(a, ear, i) >= 0 && side(ear, c, i) >= 0 &&
             side(c, a, i) >= 0;
    });
  }

  const std::vector<Point3>& vertices_;
  const Face& face_;
  View view_;
  std::vector<std::size_t> next_, previous_;
  std::vector<std::size_t> blunt_;  ///< corners of at least 180 degrees that are left
};

}  // namespace

View view_of(const FacePlane& plane) { return {plane.axis, plane.axis_sign}; }

View average_view(const std::vector<Point3>& vertices, const Face& face) {
  const Point3& o = vertices[face[0]];
  double scale = 0;
  for (const std::uint32_t v : face) {
    const Point3& p = vertices[v];
    scale = std::max({scale, std::abs(p.x - o.x), std::abs(p.y - o.y), std::abs(p.z - o.z)});
  }
  Point3 sum;
  for (std::size_t i = 2; i < face.size(); ++i) {
    const auto unit = [&](std::uint32_t v) {
      const Point3& p = vertices[v];
      return Point3{(p.x - o.x) / scale, (p.y - o.y) / scale, (p.z - o.z) / scale};
    };
    const Point3 a = unit(face[i - 1]), b = unit(face[i]);
    sum = {sum.x + (a.y * b.z - a.z * b.y), sum.y + (a.z * b.x - a.x * b.z), sum.z + (a.x * b.y - a.y * b.x)};
  }
  const double x = std::abs(sum.x), y = std::abs(sum.y), z = std::abs(sum.z);
  if (x > y && x > z) return {Axis::x, sum.x < 0 ? -1 : 1};
  if (y > z) return {Axis::y, sum.y < 0 ? -1 : 1};
  return {Axis::z, sum.z < 0 ? -1 : 1};
}

std::vector<Triangle> triangulated(const std::vector<Point3>& vertices, const Face& face, View view) {
  if (face.size() == 3) return {{face[0], face[1], face[2]}};
  // Ears are for any face, and of operands their triangles meet fewer others than the long ones of a sweep.
  constexpr std::size_t kFewCorners = 400;
  if (face.size() > kFewCorners) {
    FaceOrder order(vertices, view);
    if (auto triangles = sweep_triangles(std::span(&face, 1), order)) return *std::move(triangles);
  }
  return Ears(vertices, face, view).cut();
}

Triangles triangulated(const MeshData& data) {
  Triangles all;
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    if (data.faces[f].size() < 3) continue;
    const View view = data.faces[f].size() == 3 ? View{} : view_of(face_plane(data.vertices, data.faces[f]));
    for (const Triangle& t : triangulated(data.vertices, data.faces[f], view)) {
      all.triangles.push_back(t);
      all.face.push_back(f);
    }
  }
  return all;
}

}  // namespace dymsum::spatial
