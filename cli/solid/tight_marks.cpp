#include "solid/tight_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dymsum::cli {
namespace {

class Marks {
 public:
  explicit Marks(double radius) : radius_(radius) {}

  MeshData take() { return std::move(mesh_); }

  void add_triangle(const Point3& a, const Point3& b, const Point3& c) {
    const std::uint32_t i = add(a.x, a.y, a.z), j = add(b.x, b.y, b.z), k = add(c.x, c.y, c.z);
    mesh_.faces.push_back({i, j, k});
  }

  std::uint32_t add(double x, double y, double z) {
    mesh_.vertices.push_back({x, y, z});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  void add_point(const Point3& p, double r) {
    const std::uint32_t east = add(p.x + r, p.y, p.z), west = add(p.x - r, p.y, p.z);
    const std::uint32_t north = add(p.x, p.y + r, p.z), south = add(p.x, p.y - r, p.z);
    const std::uint32_t top = add(p.x, p.y, p.z + r), bottom = add(p.x, p.y, p.z - r);
    for (const auto& [a, b] :
         std::array<std::array<std::uint32_t, 2>, 4>{{{east, north}, {north, west}, {west, south}, {south, east}}}) {
      mesh_.faces.push_back({a, b, top});
      mesh_.faces.push_back({b, a, bottom});
    }
  }

  void add_bar(const Point3& a, const Point3& b) {
    const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0)) return;
    // Two directions across: along the axis that the bar runs along least, made perpendicular, and their product.
    std::array<double, 3> d{x / length, y / length, z / length}, u{}, v{};
    const std::size_t least = static_cast<std::size_t>(
        std::min_element(d.begin(), d.end(), [](double s, double t) { return std::abs(s) < std::abs(t); }) - d.begin());
    u[least] = 1;
    for (std::size_t k = 0; k < 3; ++k) u[k] -= d[least] * d[k];
    const double size = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (double& c : u) c *= radius_ / size;
    for (std::size_t k = 0; k < 3; ++k) v[k] = d[(k + 1) % 3] * u[(k + 2) % 3] - d[(k + 2) % 3] * u[(k + 1) % 3];
    std::array<std::uint32_t, 6> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = std::cos(2.0943951023931953 * static_cast<double>(k)),
                   s = std::sin(2.0943951023931953 * static_cast<double>(k));
      const std::array<double, 3> off{c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]};
      corners[k] = add(a.x + off[0], a.y + off[1], a.z + off[2]);
      corners[3 + k] = add(b.x + off[0], b.y + off[1], b.z + off[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      mesh_.faces.push_back({corners[k], corners[next], corners[3 + next]});
      mesh_.faces.push_back({corners[k], corners[3 + next], corners[3 + k]});
    }
    mesh_.faces.push_back({corners[2], corners[1], corners[0]});
    mesh_.faces.push_back({corners[3], corners[4], corners[5]});
  }

 private:
  double radius_;
  MeshData mesh_;
};

double radius_beside(const std::vector<Point3>& vertices) {
  Point3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (const Point3& v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return 0.004 * std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0.0});
}

}  // namespace

MeshData position_marks(const MeshData& mesh, const std::vector<Point3>& positions) {
  const double radius = radius_beside(mesh.vertices);
  Marks marks(radius);
  constexpr double kTimes = 3;
  for (const Point3& p : positions) marks.add_point(p, kTimes * radius);
  return marks.take();
}

MeshData tight_marks(const SpatialSum& sum) {
  const double radius = radius_beside(sum.vertices);
  Marks marks(radius);
  const auto at = [&](std::uint32_t v) -> const Point3& { return sum.vertices[v]; };
  for (const std::uint32_t v : sum.tight_points) marks.add_point(at(v), 2 * radius);
  for (const auto& [from, to] : sum.tight_segments) marks.add_bar(at(from), at(to));
  for (const auto& [a, b, c] : sum.tight_triangles()) marks.add_triangle(at(a), at(b), at(c));
  for (const auto& face : sum.tight_faces)
    for (const std::vector<std::uint32_t>& loop : face)
      for (std::size_t k = 0; k < loop.size(); ++k) marks.add_bar(at(loop[k]), at(loop[(k + 1) % loop.size()]));
  return marks.take();
}

MeshData bars(const std::vector<std::array<Point3, 2>>& segments, double radius) {
  Marks marks(radius);
  for (const auto& [from, to] : segments) marks.add_bar(from, to);
  return marks.take();
}

}  // namespace dymsum::cli
