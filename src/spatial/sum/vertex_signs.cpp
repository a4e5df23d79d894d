#include "spatial/sum/vertex_signs.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

using exact::Big;
using exact::BigInteger;
using exact::FineInterval;

namespace {

int bits(const BigInteger& v) { return v.is_zero() ? INT_MIN / 4 : static_cast<int>(msb(abs(v))) + 1; }

const FineInterval& component(const exact::Vector3<FineInterval>& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// num / den 2^-shift, which is at most 1 in magnitude.
FineInterval fine_ratio(const BigInteger& num, const BigInteger& den, int shift) {
  if (num.is_zero()) return {};
  const int n = bits(num), d = bits(den);
  const FineInterval ratio = fine_coordinate(Big(num), -n) / fine_coordinate(Big(den), -d);
  return ratio * FineInterval(std::ldexp(1.0, std::max(n - d - shift, -1000)));
}

}  // namespace

void VertexSigns::make_positions() {
  const SpatialPositions& positions = SpatialSumInternals::positions(sum_);
  positions_.resize(sum_.vertices.size());
  int top[3] = {INT_MIN / 4, INT_MIN / 4, INT_MIN / 4};
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    std::array<BigInteger, 4>& h = positions_[v].h = positions.homogeneous(v);
    for (std::size_t axis = 0; axis < 3; ++axis) top[axis] = std::max(top[axis], bits(h[axis]) - bits(h[3]) + 1);
  }
  for (Position& p : positions_)
    p.fine = {fine_ratio(p.h[0], p.h[3], top[0]), fine_ratio(p.h[1], p.h[3], top[1]),
              fine_ratio(p.h[2], p.h[3], top[2])};
}

// Axes may be scaled, and rows of determinants, by any positive factors: weights are positive.
int VertexSigns::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) {
  const Position &p = position(a), &q = position(b), &r = position(c);
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto gap = [](const Position& to, const Position& from, std::size_t k) {
    return component(to.fine, k) - component(from.fine, k);
  };
  if (const auto s = sign_of(gap(q, p, i) * gap(r, p, j) - gap(q, p, j) * gap(r, p, i))) return *s;
  const auto minor = [&](std::size_t k, std::size_t l) { return BigInteger(q.h[k] * r.h[l] - q.h[l] * r.h[k]); };
  return BigInteger(p.h[i] * minor(j, 3) - p.h[j] * minor(i, 3) + p.h[3] * minor(i, j)).sign();
}

int VertexSigns::side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const Position &o = position(a), &p = position(b), &q = position(c), &r = position(d);
  if (const auto s = sign_of(dot(cross(p.fine - o.fine, q.fine - o.fine), r.fine - o.fine))) return *s;
  // det(b - a, c - a, d - a) is the negative of the determinant of the rows (a, 1), (b, 1), (c, 1), (d, 1), here by
  // pairs of rows.
  const auto minor = [](const Position& x, const Position& y, std::size_t k, std::size_t l) {
    return BigInteger(x.h[k] * y.h[l] - x.h[l] * y.h[k]);
  };
  const auto pair = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return BigInteger(minor(o, p, i, j) * minor(q, r, k, l) + minor(o, p, k, l) * minor(q, r, i, j));
  };
  return -BigInteger(pair(0, 1, 2, 3) - pair(0, 2, 1, 3) + pair(0, 3, 1, 2)).sign();
}

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

namespace dymsum::spatial {
namespace {

class TouchingVertices {
 public:
  explicit TouchingVertices(const SpatialSum& sum) : sum_(sum), signs_(sum) {}

  Triangles run(const Triangles& all) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> touched = find(all.triangles);
    Triangles result;
    for (std::uint32_t t = 0; t < all.triangles.size(); ++t) {
      const auto at = touched.find(t);
      if (at == touched.end()) add(result, all.triangles[t], all.face[t]);
      else split(result, all.triangles[t], all.face[t], at->second);
    }
    return result;
  }

 private:
  Vec3 at(std::uint32_t v) const { return {sum_.vertices[v].x, sum_.vertices[v].y, sum_.vertices[v].z}; }
  static void add(Triangles& result, const Triangle& t, std::uint32_t face) {
    result.triangles.push_back(t);
    result.face.push_back(face);
  }
  static bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

  std::map<std::uint32_t, std::vector<std::uint32_t>> find(const std::vector<Triangle>& triangles) {
    std::vector<Box> boxes(triangles.size());
    std::vector<bool> used(sum_.vertices.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const std::uint32_t v : triangles[t]) boxes[t].add(at(v)), used[v] = true;
      boxes[t].grow(2 * sum_.at_error);
    }
    const BoxTree tree(std::move(boxes));
    std::map<std::uint32_t, std::vector<std::uint32_t>> touched;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      Box box;
      box.add(at(v));
      tree.for_each(box, [&](std::uint32_t t) {
        if (!has(triangles[t], v) && may_hold(triangles[t], v) && contains(triangles[t], v)) touched[t].push_back(v);
      });
    }
    return touched;
  }

  /// False where doubles show that a vertex is off a triangle's plane, or beyond one of its sides.
  bool may_hold(const Triangle& t, std::uint32_t v) const {
    const Vec3 u = at(t[1]) - at(t[0]), w = at(t[2]) - at(t[0]), d = at(v) - at(t[0]), n = cross(u, w);
    const auto size = [&](Vec3 x) { return std::abs(x.x) + std::abs(x.y) + std::abs(x.z) + 4 * sum_.at_error; };
    const double error = 8 * sum_.at_error * (size(u) * size(w) + size(w) * size(d) + size(d) * size(u)) +
                         size(u) * size(w) * size(d) * 0x1p-48;
    if (std::abs(dot(n, d)) > error) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = at(t[(k + 1) % 3]) - at(t[k]), to = at(v) - at(t[k]);
      const double all = size(u) * size(w) * size(side) * size(to);
      // Each of the four vectors errs by 6 at_error at most and is no longer than 3/2 of its size.
      const double slack =
          32 * sum_.at_error * all * (1 / size(u) + 1 / size(w) + 1 / size(side) + 1 / size(to)) + all * 0x1p-46;
      if (dot(n, cross(side, to)) < -slack) return false;
    }
    return true;
  }

  /// Whether the closed triangle holds a vertex of its plane, seen along an axis across it.
  bool contains(const Triangle& t, std::uint32_t v) {
    return signs_.side(t[0], t[1], t[2], v) == 0 && sides(t, v).has_value();
  }
  /// The sides of the facet edges from corner k to k + 1 on which the vertex lies: 1 inside, 0 on them; none outside.
  std::optional<std::array<int, 3>> sides(const Triangle& t, std::uint32_t v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int facing = signs_.turn(t[0], t[1], t[2], axis);
      if (facing == 0) continue;
      std::array<int, 3> result{};
      for (std::size_t k = 0; k < 3; ++k) {
        result[k] = facing * signs_.turn(t[k], t[(k + 1) % 3], v, axis);
        if (result[k] < 0) return std::nullopt;
      }
      return result;
    }
    return std::nullopt;
  }

  /// The first vertex makes three triangles, or two where it is on a facet edge; the others go where they are.
  void split(Triangles& result, const Triangle& t, std::uint32_t face, const std::vector<std::uint32_t>& inside) {
    if (inside.empty()) return add(result, t, face);
    const std::uint32_t v = inside[0];
    const std::optional<std::array<int, 3>> side = sides(t, v);
    for (std::size_t k = 0; k < 3; ++k) {
      if ((*side)[k] == 0) continue;
      const Triangle part{t[k], t[(k + 1) % 3], v};
      std::vector<std::uint32_t> rest;
      for (std::size_t i = 1; i < inside.size(); ++i)
        if (sides(part, inside[i])) rest.push_back(inside[i]);
      split(result, part, face, rest);
    }
  }

  const SpatialSum& sum_;
  VertexSigns signs_;
};

}  // namespace

Triangles split_at_touching_vertices(const SpatialSum& sum, Triangles triangles) {
  return TouchingVertices(sum).run(triangles);
}

}  // namespace dymsum::spatial
