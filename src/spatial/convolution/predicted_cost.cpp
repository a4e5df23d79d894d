#include "spatial/convolution/predicted_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

// How many facets of a convolution will lie near one another, from a sample of them.

/// How many of either operand's faces, and of its edges, are drawn; and how many facets are kept in all.
constexpr std::size_t kDrawn = 96, kMostFacets = 3000;

/// A prime, so that every drawn one is queried once.
constexpr std::size_t kStride = 1009;

static_assert(kStride > kDrawn);

/// A rotation by a thousandth about an axis in no plane of symmetry, nearly.
Vec3 slightly_turned(Vec3 v) {
  constexpr Vec3 kAxis{0.00031, 0.00053, 0.00079};
  return v + cross(kAxis, v);
}

/// An operand's vertices, and the directions of its features.
struct Drawing {
  const SolidOperand& solid;
  bool turns;

  Vec3 at(std::uint32_t v) const {
    const Point3& p = solid.vertices[v];
    return {p.x, p.y, p.z};
  }
  Vec3 direction(std::uint32_t from, std::uint32_t to) const {
    const Vec3 d = at(to) - at(from);
    return turns ? slightly_turned(d) : d;
  }
  Vec3 normal(std::uint32_t t) const {
    const Triangle& v = solid.triangles[t];
    return cross(direction(v[0], v[1]), direction(v[0], v[2]));
  }
  bool supports(const SupportCone& cone, Vec3 n) const {
    const auto rays = solid.rays_of(cone);
    return !cone.flat && std::all_of(rays.begin(), rays.end(),
                                     [&](std::uint32_t r) { return dot(n, direction(cone.vertex, r)) <= 0; });
  }
};

struct Drawn {
  Box box;
  double weight;          ///< of how many facets it is one
  std::uint32_t feature;  ///< of which it is drawn
};

class Sample {
 public:
  double pairs(const Drawing& p, const Drawing& q) {
    draw_faces(p, q);
    draw_faces(q, p);
    draw_edges(p, q);
    double sum = 0;
    for (std::size_t i = 0; i < drawn_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (overlap(drawn_[i].box, drawn_[j].box))
          sum += drawn_[i].feature == drawn_[j].feature ? drawn_[i].weight : drawn_[i].weight * drawn_[j].weight;
    return sum;
  }

 private:
  /// Calls f(k) for kDrawn of `count` numbers, evenly, while there is room.
  template <class F>
  void draw(std::size_t count, F f) {
    const std::size_t first = drawn_.size(), drawn = std::min(count, kDrawn);
    std::size_t queried = 0;
    for (; queried < drawn && drawn_.size() < first + kMostFacets / 3; ++queried) {
      ++feature_;
      // Neighbours are alike: not one after the other.
      f(count * ((queried * kStride) % drawn) / drawn);
    }
    for (std::size_t k = first; k < drawn_.size(); ++k)
      drawn_[k].weight = static_cast<double>(count) / static_cast<double>(queried);
  }

  void draw_faces(const Drawing& faces, const Drawing& vertices) {
    draw(faces.solid.first_plate, [&](std::size_t k) {
      const auto t = static_cast<std::uint32_t>(k);
      const Vec3 n = faces.normal(t);
      for (const SupportCone& cone : vertices.solid.cones) {
        if (!vertices.supports(cone, n)) continue;
        Drawn facet{{}, 1, feature_};
        for (const std::uint32_t v : faces.solid.triangles[t]) facet.box.add(faces.at(v) + vertices.at(cone.vertex));
        add(facet);
      }
    });
  }

  static std::vector<std::uint32_t> convex_edges(const SolidOperand& solid) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t k = 0; k < solid.wedges.size(); ++k) {
      const Wedge& w = solid.wedges[k];
      if (!w.is_segment() && w.bend == Wedge::Bend::convex && w.left < solid.first_plate) all.push_back(k);
    }
    return all;
  }

  void draw_edges(const Drawing& p, const Drawing& q) {
    const std::vector<std::uint32_t> own = convex_edges(p.solid), others = convex_edges(q.solid);
    struct Arc {
      Vec3 direction, from, to;  ///< of the edge; normals
    };
    const auto arc = [](const Drawing& side, const Wedge& w) {
      return Arc{side.direction(w.from, w.to), side.normal(w.left), side.normal(w.right)};
    };
    std::vector<Arc> arcs;
    for (const std::uint32_t k : others) arcs.push_back(arc(q, q.solid.wedges[k]));
    draw(own.size(), [&](std::size_t k) {
      const Wedge& e = p.solid.wedges[own[k]];
      const Arc a = arc(p, e);
      for (std::size_t j = 0; j < arcs.size(); ++j) {
        const Arc& b = arcs[j];
        if (dot(a.from, b.direction) * dot(a.to, b.direction) > 0 ||
            dot(b.from, a.direction) * dot(b.to, a.direction) > 0)
          continue;
        const Vec3 n = cross(a.direction, b.direction);
        if (dot(n, a.from + a.to) * dot(n, b.from + b.to) <= 0) continue;
        const Wedge& g = q.solid.wedges[others[j]];
        Drawn facet{{}, 1, feature_};
        for (const std::uint32_t v : {e.from, e.to})
          for (const std::uint32_t w : {g.from, g.to}) facet.box.add(p.at(v) + q.at(w));
        add(facet);
      }
    });
  }

  /// Rounded sums that would touch do.
  void add(Drawn facet) {
    facet.box.grow(1e-9 * facet.box.size());
    drawn_.push_back(facet);
  }

  std::vector<Drawn> drawn_;
  std::uint32_t feature_ = 0;
};

/// The expected number of pairs of facets whose boxes overlap: of the facets of some hundred triangles and edges, drawn
/// evenly, the pairs that do, times what each stands for. In doubles, P being turned by a thousandth so that parallel
/// faces and edges are in general position. Parts without volume are left out. O(s (m + n) + f^2) for s drawn features
/// with f facets.
double sampled_pairs(const SolidOperand& p, const SolidOperand& q) { return Sample().pairs({p, true}, {q, false}); }

}  // namespace

// Expected sizes of a reduced convolution, from angles of either operand by itself.

namespace {

Vec3 between(const SolidOperand& solid, std::uint32_t from, std::uint32_t to) {
  const Point3 &a = solid.vertices[from], &b = solid.vertices[to];
  return {b.x - a.x, b.y - a.y, b.z - a.z};
}
Vec3 normal(const SolidOperand& solid, std::uint32_t t) {
  const Triangle& v = solid.triangles[t];
  return cross(between(solid, v[0], v[1]), between(solid, v[0], v[2]));
}
double angle(Vec3 u, Vec3 v) { return std::atan2(length(cross(u, v)), dot(u, v)); }

/// The sum, over convex edges, of the lengths of the arcs of their normals.
double convex_angles(const SolidOperand& solid) {
  double sum = 0;
  for (const Wedge& w : solid.wedges) {
    if (w.is_segment()) sum += 2 * std::numbers::pi;
    else if (w.bend == Wedge::Bend::convex) sum += angle(normal(solid, w.left), normal(solid, w.right));
  }
  return sum;
}

/// The normals that a cone supports are a polygon on the sphere whose outer angles are those between the cone's rays:
/// its area is what they lack of a full turn.
double cover(const SolidOperand& solid) {
  double area = 0;
  for (const SupportCone& cone : solid.cones) {
    const std::span<const std::uint32_t> rays = solid.rays_of(cone);
    double turns = 0;
    for (std::size_t k = 0; k < rays.size(); ++k)
      turns += angle(between(solid, cone.vertex, rays[k]), between(solid, cone.vertex, rays[(k + 1) % rays.size()]));
    area += std::max(0.0, 2 * std::numbers::pi - turns);
  }
  return area / (4 * std::numbers::pi);
}

}  // namespace

SpatialCost predicted_cost(const SolidOperand& p, const SolidOperand& q) {
  SpatialCost cost;
  cost.edge_edge = convex_angles(p) * convex_angles(q) / (2 * std::numbers::pi * std::numbers::pi);
  const auto m = static_cast<double>(p.triangles.size()), n = static_cast<double>(q.triangles.size());
  cost.face_vertex = cover(p) * n + cover(q) * m;
  cost.full_face_vertex = p.triangles.size() * q.vertices.size() + q.triangles.size() * p.vertices.size();
  cost.full_edge_edge = p.wedges.size() * q.wedges.size();
  const double facets = cost.edge_edge + cost.face_vertex, more = sampled_pairs(p, q) - kPairsPerFacet * facets;
  cost.bytes = static_cast<std::uint64_t>(kBytesPerFacet * facets + kBytesPerPair * std::max(0.0, more));
  return cost;
}

}  // namespace dymsum::spatial

namespace dymsum {

SpatialCost predict_cost(const Mesh& p, const Mesh& q) {
  return spatial::predicted_cost(spatial::solid_operand(p.data(), p.thin_faces()),
                                 spatial::solid_operand(q.data(), q.thin_faces()));
}

}  // namespace dymsum
