#include "spatial/sum/face_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "exact/big.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

using exact::BigRational;
using Ring = std::vector<std::uint32_t>;

/// Signs of turns of a sum's vertices, seen along an axis: doubles, and exact positions where these leave it open.
class Turns {
 public:
  explicit Turns(const SpatialSum& sum) : sum_(sum), exact_(sum.vertices.size()) {}

  void look_along(int axis, int sign) { axis_ = axis, sign_ = sign; }

  /// 1 where a, b, c turn left.
  int operator()(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
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
    return sign_ * exact_turn(a, b, c);
  }

 private:
  std::array<double, 2> flat(std::uint32_t v) const {
    const Point3& p = sum_.vertices[v];
    return axis_ == 0 ? std::array{p.y, p.z} : axis_ == 1 ? std::array{p.z, p.x} : std::array{p.x, p.y};
  }
  const std::array<BigRational, 3>& exact(std::uint32_t v) {
    if (!exact_[v]) exact_[v] = SpatialSumInternals::positions(sum_).at(v);
    return *exact_[v];
  }
  int exact_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto i = static_cast<std::size_t>((axis_ + 1) % 3), j = static_cast<std::size_t>((axis_ + 2) % 3);
    const auto &p = exact(a), &q = exact(b), &r = exact(c);
    return BigRational((q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i])).sign();
  }

  const SpatialSum& sum_;
  std::vector<std::optional<std::array<BigRational, 3>>> exact_;
  int axis_ = 2, sign_ = 1;
};

class FaceSplitter {
 public:
  FaceSplitter(const SpatialSum& sum, Turns& turn) : sum_(sum), turn_(turn) {}

  std::vector<Triangle> run(const SpatialFace& face) {
    look_at(face);
    Ring ring = face.loops[0];
    std::vector<Ring> holes(face.loops.begin() + 1, face.loops.end());
    // From the smallest vertex on: to its left lies only what is joined already.
    std::sort(holes.begin(), holes.end());
    for (std::size_t k = 0; k < holes.size(); ++k) join(ring, holes, k);
    return cut(std::move(ring));
  }

 private:
  /// Sees the face counter-clockwise: along the axis of its largest area, from the side that the outer loop's turn at
  /// its smallest vertex tells, which is a left one.
  void look_at(const SpatialFace& face) {
    Vec3 n;
    const auto at = [&](std::uint32_t v) { return Vec3{sum_.vertices[v].x, sum_.vertices[v].y, sum_.vertices[v].z}; };
    const Ring& outer = face.loops[0];
    for (std::size_t k = 1; k + 1 < outer.size(); ++k)
      n = n + cross(at(outer[k]) - at(outer[0]), at(outer[k + 1]) - at(outer[0]));
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] > size[b]; });
    for (const int axis : axes) {
      turn_.look_along(axis, 1);
      const int s = turn_(outer.back(), outer[0], outer[1]);
      if (s == 0) continue;
      turn_.look_along(axis, s);
      return;
    }
    throw std::logic_error("solid sum: a face without area");
  }

  /// Adds hole k to the ring by a bridge from its smallest vertex to the largest smaller one that sees it.
  void join(Ring& ring, const std::vector<Ring>& holes, std::size_t k) {
    const Ring& hole = holes[k];
    const std::uint32_t h = hole[0];
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (ring[i] <= h) places.push_back(i);
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return ring[a] > ring[b]; });
    for (const std::size_t i : places) {
      if (ring[i] != h && (!opens_to(ring, i, h) || crosses(ring, ring[i], h) || crosses_any(holes, k, ring[i], h)))
        continue;
      if (ring[i] == h && !opens_to(ring, i, hole[1])) continue;
      Ring joined(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      if (ring[i] == h) joined.pop_back();
      joined.insert(joined.end(), hole.begin(), hole.end());
      joined.push_back(h);
      joined.insert(joined.end(), ring.begin() + static_cast<std::ptrdiff_t>(i) + (ring[i] == h ? 1 : 0), ring.end());
      ring = std::move(joined);
      return;
    }
    throw std::logic_error("solid sum: a hole that no vertex sees");
  }
  bool crosses_any(const std::vector<Ring>& holes, std::size_t first, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = first; k < holes.size(); ++k)
      if (crosses(holes[k], a, b)) return true;
    return false;
  }
  /// Whether the way from ring[i] to v leaves into the inside there.
  bool opens_to(const Ring& ring, std::size_t i, std::uint32_t v) {
    const std::size_t n = ring.size();
    const std::uint32_t before = ring[(i + n - 1) % n], at = ring[i], behind = ring[(i + 1) % n];
    const bool left = turn_(at, behind, v) > 0, right = turn_(before, at, v) > 0;
    return turn_(before, at, behind) > 0 ? left && right : left || right;
  }
  /// Whether the segment ab meets an edge of the ring elsewhere than at its own ends.
  bool crosses(const Ring& ring, std::uint32_t a, std::uint32_t b) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t c = ring[i], d = ring[(i + 1) % n];
      if (c != a && c != b && turn_(a, b, c) == 0 && (a < c) == (c < b))
        return true;  // the order of indices is that along any line
      if (c == a || c == b || d == a || d == b) continue;
      if (turn_(a, b, c) * turn_(a, b, d) < 0 && turn_(c, d, a) * turn_(c, d, b) < 0) return true;
    }
    return false;
  }

  std::vector<Triangle> cut(Ring ring) {
    std::vector<Triangle> triangles;
    std::size_t at = 0, failed = 0;
    while (ring.size() > 3) {
      if (failed > ring.size()) throw std::logic_error("solid sum: a face without an ear");
      const std::size_t n = ring.size(), i = at % n;
      if (!is_ear(ring, i)) {
        ++at, ++failed;
        continue;
      }
      triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      at = i == 0 ? ring.size() - 1 : i - 1;
      failed = 0;
    }
    if (turn_(ring[0], ring[1], ring[2]) <= 0) throw std::logic_error("solid sum: a last triangle without area");
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
  }
  bool is_ear(const Ring& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const std::uint32_t a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
    if (turn_(a, b, c) <= 0) return false;
    for (const std::uint32_t v : ring) {
      if (v == a || v == b || v == c) continue;
      if (turn_(a, b, v) >= 0 && turn_(b, c, v) >= 0 && turn_(c, a, v) >= 0) return false;
    }
    // Where a bridge comes by, the diagonal has to leave into the inside of both of its ends.
    return opens_to_or_along(ring, (i + n - 1) % n, c) && opens_to_or_along(ring, (i + 1) % n, a);
  }
  bool opens_to_or_along(const Ring& ring, std::size_t i, std::uint32_t v) {
    const std::size_t n = ring.size();
    if (ring[(i + 1) % n] == v || ring[(i + n - 1) % n] == v) return true;
    return opens_to(ring, i, v);
  }

  const SpatialSum& sum_;
  Turns& turn_;
};

}  // namespace

Triangles triangulated(const SpatialSum& sum) {
  Triangles result;
  Turns turn(sum);
  FaceSplitter splitter(sum, turn);
  for (std::uint32_t f = 0; f < sum.faces.size(); ++f) {
    for (const Triangle& t : splitter.run(sum.faces[f])) {
      result.triangles.push_back(t);
      result.face.push_back(f);
    }
  }
  return result;
}

}  // namespace dymsum::spatial

namespace dymsum {

std::vector<std::array<std::uint32_t, 3>> SpatialSum::tight_triangles() const {
  std::vector<std::array<std::uint32_t, 3>> result;
  spatial::Turns turn(*this);
  spatial::FaceSplitter splitter(*this, turn);
  for (const auto& loops : tight_faces)
    for (const spatial::Triangle& t : splitter.run({loops, {}, {}, 0})) result.push_back(t);
  return result;
}

}  // namespace dymsum
