#include "spatial/sum/touching_vertices.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "spatial/mesh/box_tree.h"
#include "spatial/sum/vertex_signs.h"

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
