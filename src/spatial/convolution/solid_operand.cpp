#include "spatial/convolution/solid_operand.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "spatial/convolution/flat_vertices.h"
#include "spatial/convolution/thin_parts.h"

namespace dymsum::spatial {

namespace {

using Bend = Wedge::Bend;

/// One side of an edge: a triangle's corner index k, running from vertex k to vertex k + 1.
struct Side {
  std::uint32_t low, high, triangle, corner;
  bool forward;  ///< from low to high
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  });
  return sides;
}

std::uint32_t apex(const std::vector<Triangle>& triangles, const Side& s) {
  return triangles[s.triangle][(s.corner + 2) % 3];
}

/// The sides at one edge, counter-clockwise around it seen against the direction from low to high.
void sort_around(const SolidOperand& solid, const OperandSigns& signs, std::span<Side> sides) {
  const std::uint32_t low = sides[0].low, high = sides[0].high, reference = apex(solid.triangles, sides[0]);
  // 0 along the reference, 1 before half a turn, 2 opposite, 3 beyond.
  const auto sector = [&](std::uint32_t p) {
    const int s = signs.orient(low, high, reference, p);
    if (s != 0) return s > 0 ? 1 : 3;
    // In the reference's plane: on its side of the edge, or on the other one.
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x, exact::Axis::y}) {
      const int a = signs.normal(low, high, reference, axis);
      if (a != 0) return signs.normal(low, high, p, axis) == a ? 0 : 2;
    }
    return 0;
  };
  std::stable_sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    const std::uint32_t pa = apex(solid.triangles, a), pb = apex(solid.triangles, b);
    const int sa = sector(pa), sb = sector(pb);
    if (sa != sb) return sa < sb;
    return signs.orient(low, high, pa, pb) > 0;
  });
}

Bend bend_of(const SolidOperand& solid, const OperandSigns& signs, const Wedge& w) {
  const Triangle& t = solid.triangles[w.left];
  const int s = signs.orient(t[0], t[1], t[2], w.right_apex);
  return s < 0 ? Bend::convex : s > 0 ? Bend::reflex : Bend::flat;
}

void add_wedges(SolidOperand& solid, const OperandSigns& signs) {
  std::vector<Side> sides = sorted_sides(solid.triangles);
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    const std::span<Side> edge(&sides[first], last - first);
    if (edge.size() > 2) sort_around(solid, signs, edge);
    // Counter-clockwise from a triangle that runs backward comes material, up to one that runs forward.
    const std::size_t n = edge.size();
    std::size_t paired = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Side &back = edge[k], &ahead = edge[(k + 1) % n];
      if (back.forward || !ahead.forward) continue;
      Wedge w{back.low,
              back.high,
              ahead.triangle,
              back.triangle,
              apex(solid.triangles, ahead),
              apex(solid.triangles, back),
              Bend::flat};
      w.bend = bend_of(solid, signs, w);
      solid.wedges.push_back(w);
      paired += 2;
    }
    if (paired != n) throw std::invalid_argument("a surface that is not closed and oriented");
  }
}

/// The wedge at each corner's side (from its vertex to the next one): 3 per triangle.
std::vector<std::uint32_t> wedge_of_side(const SolidOperand& solid) {
  std::vector<std::uint32_t> of(3 * solid.triangles.size(), 0xffffffff);
  const auto set = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t wedge) {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (solid.triangles[triangle][k] == from) of[3 * triangle + k] = wedge;
  };
  for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
    set(solid.wedges[w].left, solid.wedges[w].from, w);
    set(solid.wedges[w].right, solid.wedges[w].to, w);
  }
  return of;
}

/// The triangles around a vertex that wedges connect: neighbours, and the wedges towards them, counter-clockwise seen
/// from outside.
struct Fan {
  std::uint32_t vertex;
  std::vector<std::uint32_t> neighbours, wedges;
};

template <class F>
void for_each_fan(const SolidOperand& solid, const std::vector<std::uint32_t>& wedge_of, F f) {
  std::vector<bool> seen(3 * solid.triangles.size());
  Fan fan;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    fan.vertex = solid.triangles[start / 3][start % 3];
    fan.neighbours.clear(), fan.wedges.clear();
    std::uint32_t corner = start;
    do {
      seen[corner] = true;
      const std::uint32_t t = corner / 3, k = corner % 3;
      // The side that comes in at the vertex: over it lies the next triangle counter-clockwise.
      const std::uint32_t in = (k + 2) % 3;
      const std::uint32_t w = wedge_of[3 * t + in];
      fan.neighbours.push_back(solid.triangles[t][in]);
      fan.wedges.push_back(w);
      const std::uint32_t next =
          solid.wedges[w].left == t && solid.wedges[w].to == fan.vertex ? solid.wedges[w].right : solid.wedges[w].left;
      std::uint32_t j = 0;
      while (solid.triangles[next][j] != fan.vertex) ++j;
      corner = 3 * next + j;
    } while (corner != start);
    f(fan);
  }
}

void add_cone(SolidOperand& solid, const OperandSigns& signs, const Fan& fan) {
  const std::vector<std::uint32_t> rays = extreme_rays(signs, fan.vertex, fan.neighbours);
  if (rays.size() < 3) return;
  // The material is on the cone's side where an extreme ray is a convex edge, and on the other side of a pit. A fan may
  // go by an edge of four faces twice: then all of its wedges count, as a pit has a convex one inside its cone too.
  for (std::size_t k = 0; k < fan.neighbours.size(); ++k)
    if (fan.neighbours[k] == fan.neighbours[rays[0]] && solid.wedges[fan.wedges[k]].bend != Bend::convex) return;
  SupportCone cone{fan.vertex, static_cast<std::uint32_t>(solid.rays.size()), 0};
  for (const std::uint32_t k : rays) solid.rays.push_back(fan.neighbours[k]);
  cone.last = static_cast<std::uint32_t>(solid.rays.size());
  solid.cones.push_back(cone);
}

void add_shells(SolidOperand& solid) {
  std::vector<std::uint32_t> parent(solid.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const Wedge& w : solid.wedges) parent[root(w.left)] = root(w.right);
  std::vector<std::uint32_t> index(parent.size());
  for (std::uint32_t t = 0; t < parent.size(); ++t) {
    if (root(t) != t) continue;
    index[t] = static_cast<std::uint32_t>(solid.shell_vertex.size());
    solid.shell_vertex.push_back(solid.triangles[t][0]);
  }
  for (std::uint32_t t = 0; t < parent.size(); ++t) solid.shell.push_back(index[root(t)]);
}

void add_surface(SolidOperand& solid, const OperandSigns& signs, Triangles surface) {
  solid.triangles = std::move(surface.triangles);
  solid.face = std::move(surface.face);
  solid.wedges.clear();
  add_wedges(solid, signs);
  solid.wedge_of = wedge_of_side(solid);
}

bool has_flat_edges(const SolidOperand& solid) {
  return std::any_of(solid.wedges.begin(), solid.wedges.end(), [](const Wedge& w) { return w.bend == Bend::flat; });
}

std::vector<bool> vertices_of_thin_faces(const MeshData& data, const std::vector<bool>& thin) {
  std::vector<bool> marked;
  if (!thin.empty()) marked.resize(data.vertices.size());
  for (std::size_t f = 0; f < thin.size(); ++f)
    for (std::size_t k = 0; thin[f] && k < data.faces[f].size(); ++k) marked[data.faces[f][k]] = true;
  return marked;
}

void add_corners(SolidOperand& solid) {
  solid.corner_begin.assign(solid.vertices.size() + 1, 0);
  for (const Triangle& t : solid.triangles)
    for (const std::uint32_t v : t) ++solid.corner_begin[v + 1];
  std::partial_sum(solid.corner_begin.begin(), solid.corner_begin.end(), solid.corner_begin.begin());
  solid.corners.resize(3 * solid.triangles.size());
  std::vector<std::uint32_t> at(solid.corner_begin.begin(), solid.corner_begin.end() - 1);
  for (std::uint32_t c = 0; c < solid.corners.size(); ++c) solid.corners[at[solid.triangles[c / 3][c % 3]]++] = c;
}

/// The triangles of the faces that are not thin.
Triangles solid_triangles(const MeshData& data, const std::vector<bool>& thin) {
  Triangles all = triangulated(data), solid;
  if (thin.empty()) return all;
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    if (thin[all.face[t]]) continue;
    solid.triangles.push_back(all.triangles[t]);
    solid.face.push_back(all.face[t]);
  }
  return solid;
}

constexpr std::uint32_t kNoRay = 0xffffffff;

/// Wraps a cone like a gift: from ray to ray, all others to the left. Rays are indices of neighbours.
class ConeWrap {
 public:
  ConeWrap(const OperandSigns& signs, std::uint32_t vertex, std::span<const std::uint32_t> neighbours)
      : signs_(signs), o_(vertex), neighbours_(neighbours), distinct_(distinct(neighbours)) {}

  /// The extreme rays in their order; none where the cone is not pointed.
  std::vector<std::uint32_t> run() const {
    for (const std::uint32_t start : distinct_) {
      std::vector<std::uint32_t> rays{start};
      for (std::uint32_t at = next(start); at != kNoRay && rays.size() <= distinct_.size(); at = next(at)) {
        if (at == start) return rays;
        rays.push_back(at);
      }
    }
    return {};
  }

 private:
  // A fan that goes by an edge of four faces twice has its ray twice.
  static std::vector<std::uint32_t> distinct(std::span<const std::uint32_t> neighbours) {
    std::vector<std::uint32_t> rays(neighbours.size());
    std::iota(rays.begin(), rays.end(), 0u);
    std::sort(rays.begin(), rays.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(neighbours[a], a) < std::pair(neighbours[b], b);
    });
    rays.erase(std::unique(rays.begin(), rays.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return neighbours[a] == neighbours[b]; }),
               rays.end());
    std::sort(rays.begin(), rays.end());
    return rays;
  }

  std::uint32_t end(std::uint32_t ray) const { return neighbours_[ray]; }
  int det(std::uint32_t i, std::uint32_t j, std::uint32_t k) const { return signs_.orient(o_, end(i), end(j), end(k)); }
  int normal(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
    return signs_.normal(o_, end(a), end(b), axis);
  }
  /// The sign of a x b, along the first axis where it is not zero; 0 for parallel rays.
  int turns(std::uint32_t a, std::uint32_t b) const {
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x, exact::Axis::y})
      if (const int s = normal(a, b, axis)) return s;
    return 0;
  }
  /// Whether, of rays in one plane, a turns to b as c to d.
  bool same_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x, exact::Axis::y})
      if (const int s = normal(a, b, axis)) return s == normal(c, d, axis);
    return false;
  }

  /// The ray, next to ray i, with all others on or to the left of the plane through both; among several in that plane
  /// the last one. None where an opposite ray, or one on the other side, shows that the cone is not pointed.
  std::uint32_t next(std::uint32_t i) const {
    std::uint32_t best = kNoRay;
    for (const std::uint32_t k : distinct_) {
      if (k == i || turns(i, k) == 0) continue;
      const int s = best == kNoRay ? -1 : det(i, best, k);
      if (s < 0 || (s == 0 && same_turn(i, best, best, k))) best = k;
    }
    if (best == kNoRay) return best;
    for (const std::uint32_t k : distinct_) {
      if (k == i || k == best) continue;
      if (turns(i, k) == 0) return kNoRay;
      const int s = det(i, best, k);
      if (s < 0 || (s == 0 && !same_turn(i, best, i, k))) return kNoRay;
    }
    return best;
  }

  const OperandSigns& signs_;
  std::uint32_t o_;
  std::span<const std::uint32_t> neighbours_;
  std::vector<std::uint32_t> distinct_;
};

}  // namespace

std::vector<std::uint32_t> extreme_rays(const OperandSigns& signs, std::uint32_t vertex,
                                        std::span<const std::uint32_t> neighbours) {
  return ConeWrap(signs, vertex, neighbours).run();
}

namespace {

SolidOperand operand_of(const MeshData& data, const std::vector<bool>& thin, FlatFeatures flat,
                        const OperandSigns& signs) {
  SolidOperand solid;
  solid.vertices = data.vertices;
  add_surface(solid, signs, solid_triangles(data, thin));
  if (flat == FlatFeatures::merged && has_flat_edges(solid)) {
    Triangles surface{std::move(solid.triangles), std::move(solid.face)};
    surface = without_flat_vertices(solid.vertices, std::move(surface), solid.wedges, solid.wedge_of,
                                    vertices_of_thin_faces(data, thin));
    add_surface(solid, signs, std::move(surface));
  }
  solid.first_plate = static_cast<std::uint32_t>(solid.triangles.size());
  for_each_fan(solid, solid.wedge_of, [&](const Fan& fan) { add_cone(solid, signs, fan); });
  add_shells(solid);
  if (!thin.empty()) add_thin_parts(solid, signs, data, thin);
  add_corners(solid);
  return solid;
}

}  // namespace

SolidOperand solid_operand(const MeshData& data, const std::vector<bool>& thin, FlatFeatures flat) {
  return operand_of(data, thin, flat, SignsOfDoubles(data.vertices));
}

SolidOperand solid_operand(const MeshData& data, const std::vector<bool>& thin, std::vector<ExactVertex> exact,
                           int exponent) {
  // Flat vertices are left out by doubles.
  SolidOperand solid = operand_of(data, thin, FlatFeatures::kept, SignsOfFractions(exact));
  solid.exact = std::move(exact), solid.exponent = exponent;
  return solid;
}

}  // namespace dymsum::spatial
