#include "spatial/sum/face_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "spatial/mesh/sweep_triangles.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::spatial {

namespace {

using Ring = std::vector<std::uint32_t>;

/// Signs of turns of a sum's vertices, seen along an axis: doubles, and exact positions where these leave it open.
class Turns final : public PlaneOrder {
 public:
  explicit Turns(const SpatialSum& sum) : sum_(sum), signs_(sum) {}

  void look_along(int axis, int sign) { axis_ = axis, sign_ = sign; }

  /// The order of indices is that along any line.
  bool before(std::uint32_t a, std::uint32_t b) override { return a < b; }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    if (a == b || b == c || a == c) return 0;
    const auto [ax, ay] = flat(a);
    const auto [bx, by] = flat(b);
    const auto [cx, cy] = flat(c);
    const double ux = bx - ax, uy = by - ay, vx = cx - ax, vy = cy - ay;
    const double value = ux * vy - uy * vx;
    const double sizes = std::abs(ux) + std::abs(uy) + std::abs(vx) + std::abs(vy);
    const double error =
        4 * sum_.at_error * (sizes + 4 * sum_.at_error) + 0x1p-50 * (std::abs(ux * vy) + std::abs(uy * vx)) + 0x1p-1000;
    if (value > error) return sign_;
    if (value < -error) return -sign_;
    return sign_ * signs_.turn(a, b, c, static_cast<std::size_t>(axis_));
  }

 private:
  std::array<double, 2> flat(std::uint32_t v) const {
    const Point3& p = sum_.vertices[v];
    return axis_ == 0 ? std::array{p.y, p.z} : axis_ == 1 ? std::array{p.z, p.x} : std::array{p.x, p.y};
  }

  const SpatialSum& sum_;
  VertexSigns signs_;
  int axis_ = 2, sign_ = 1;
};

class FaceSplitter {
 public:
  explicit FaceSplitter(const SpatialSum& sum) : sum_(sum), turn_(sum) {}

  std::vector<Triangle> run(const std::vector<Ring>& loops) {
    auto triangles = split(loops);
    if (!triangles) throw std::logic_error("solid sum: a face without area, or one whose loops cross");
    return *std::move(triangles);
  }

  /// Nothing where the loops cross or have no area.
  std::optional<std::vector<Triangle>> split(const std::vector<Ring>& loops) {
    if (loops.size() == 1 && loops[0].size() == 3) return std::vector{Triangle{loops[0][0], loops[0][1], loops[0][2]}};
    if (!look_at(loops[0])) return std::nullopt;
    return sweep_triangles(loops, turn_);
  }

 private:
  /// Sees the face counter-clockwise: along the axis of its largest area, from the side that the outer loop's turn at
  /// its smallest vertex decides, which is a left one. False where there is none.
  bool look_at(const Ring& outer) {
    Vec3 n;
    const auto at = [&](std::uint32_t v) { return Vec3{sum_.vertices[v].x, sum_.vertices[v].y, sum_.vertices[v].z}; };
    for (std::size_t k = 1; k + 1 < outer.size(); ++k)
      n = n + cross(at(outer[k]) - at(outer[0]), at(outer[k + 1]) - at(outer[0]));
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
    for (const int axis : axes) {
      turn_.look_along(axis, 1);
      const int s = turn_.turn(outer.back(), outer[0], outer[1]);
      if (s == 0) continue;
      turn_.look_along(axis, s);
      return true;
    }
    return false;
  }

  const SpatialSum& sum_;
  Turns turn_;
};

}  // namespace

Triangles triangulated(const SpatialSum& sum) {
  Triangles result;
  FaceSplitter splitter(sum);
  for (std::uint32_t f = 0; f < sum.faces.size(); ++f) {
    for (const Triangle& t : splitter.run(sum.faces[f].loops)) {
      result.triangles.push_back(t);
      result.face.push_back(f);
    }
  }
  return result;
}

std::optional<std::size_t> first_without_triangles(const SpatialSum& sum) {
  FaceSplitter splitter(sum);
  std::size_t face = 0;
  for (const SpatialFace& f : sum.faces)
    if (!splitter.split(f.loops)) return face;
    else ++face;
  for (const std::vector<Ring>& loops : sum.tight_faces)
    if (!splitter.split(loops)) return face;
    else ++face;
  return std::nullopt;
}

}  // namespace dymsum::spatial

namespace dymsum {

std::vector<std::array<std::uint32_t, 3>> SpatialSum::tight_triangles() const {
  std::vector<std::array<std::uint32_t, 3>> result;
  spatial::FaceSplitter splitter(*this);
  for (const auto& loops : tight_faces)
    for (const spatial::Triangle& t : splitter.run(loops)) result.push_back(t);
  return result;
}

}  // namespace dymsum
