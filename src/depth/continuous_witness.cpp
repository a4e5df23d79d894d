#include "depth/continuous_witness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dymsum::depth {
namespace {

using spatial::Box;
using spatial::cross;
using spatial::dot;
using spatial::length;

/// One solid as it stands: positions in the world are turned back for Q.
class Standing {
 public:
  Standing(const WitnessSolids& s, bool of_p, Vec3 x) : surface_((of_p ? s.p : s.q)->surface), s_(s), p_(of_p), x_(x) {}

  const ContinuousSurface& surface() const { return surface_; }
  Vec3 vertex(std::uint32_t v) const { return p_ ? surface_.at[v] : x_ + s_.turned(v); }
  bool face_holds(std::uint32_t f, Vec3 w, double slack) const {
    return face_comes_within(surface_, f, p_ ? w : spatial::row_times(w - x_, s_.turn), slack);
  }
  bool edge_holds(std::uint32_t a, std::uint32_t b, Vec3 w, double slack) const {
    const Vec3 from = vertex(a), d = vertex(b) - from;
    const double size = dot(d, d), s = size > 0 ? std::clamp(dot(w - from, d) / size, 0.0, 1.0) : 0;
    return length(from + s * d - w) <= slack;
  }
  bool holds(const SolidFeature& f, Vec3 w, double slack) const {
    if (f.kind == SolidFeature::Kind::vertex) return length(vertex(f.a) - w) <= slack;
    return f.kind == SolidFeature::Kind::edge ? edge_holds(f.a, f.b, w, slack) : face_holds(f.a, w, slack);
  }
  /// The smallest feature of a face that holds a position: a vertex before an edge before the face.
  SolidFeature feature_at(std::uint32_t f, Vec3 w, double slack) const {
    using Kind = SolidFeature::Kind;
    const SurfaceFace& face = surface_.faces[f];
    for (std::uint32_t k = face.first; k < face.last; ++k)
      if (const std::uint32_t v = surface_.edges[k].from; length(vertex(v) - w) <= slack) return {Kind::vertex, v, 0};
    for (std::uint32_t k = face.first; k < face.last; ++k) {
      const auto [a, b] = std::minmax(surface_.edges[k].from, surface_.edges[k].to);
      if (edge_holds(a, b, w, slack)) return {Kind::edge, a, b};
    }
    return {Kind::face, f, 0};
  }

 private:
  const ContinuousSurface& surface_;
  const WitnessSolids& s_;
  bool p_;
  Vec3 x_;
};

/// The position at which two segments come nearest, seen from the first one; nothing where they are parallel, as ends
/// tell then.
std::optional<Vec3> between_edges(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, r = c - a;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), det = uu * vv - uv * uv;
  if (!(det > 1e-20 * uu * vv)) return std::nullopt;
  return a + std::clamp((dot(u, r) * vv - dot(v, r) * uv) / det, 0.0, 1.0) * u;
}

std::optional<Vec3> by_features(const Standing& p, const Standing& q, const SolidContact& c) {
  using Kind = SolidFeature::Kind;
  if (c.q.kind == Kind::vertex) return q.vertex(c.q.a);
  if (c.p.kind == Kind::vertex) return p.vertex(c.p.a);
  if (c.p.kind == Kind::edge && c.q.kind == Kind::edge)
    return between_edges(p.vertex(c.p.a), p.vertex(c.p.b), q.vertex(c.q.a), q.vertex(c.q.b));
  return std::nullopt;
}

/// A position of both faces.
std::optional<Vec3> of_faces(const Standing& p, const Standing& q, std::uint32_t i, std::uint32_t j, double slack) {
  const SurfaceFace &f = p.surface().faces[i], &g = q.surface().faces[j];
  for (std::uint32_t k = f.first; k < f.last; ++k)
    if (const Vec3 w = p.vertex(p.surface().edges[k].from); q.face_holds(j, w, slack)) return w;
  for (std::uint32_t k = g.first; k < g.last; ++k)
    if (const Vec3 w = q.vertex(q.surface().edges[k].from); p.face_holds(i, w, slack)) return w;
  for (std::uint32_t k = f.first; k < f.last; ++k)
    for (std::uint32_t l = g.first; l < g.last; ++l) {
      const SurfaceEdge &e = p.surface().edges[k], &o = q.surface().edges[l];
      const std::optional<Vec3> w = between_edges(p.vertex(e.from), p.vertex(e.to), q.vertex(o.from), q.vertex(o.to));
      if (w && q.edge_holds(o.from, o.to, *w, slack)) return w;
    }
  return std::nullopt;
}

}  // namespace

WitnessSolid witness_solid(ContinuousSurface surface, const spatial::Mat3& turn, double sense) {
  std::vector<Box> boxes;
  for (const SurfaceFace& f : surface.faces) {
    Box& box = boxes.emplace_back();
    for (std::uint32_t k = f.first; k < f.last; ++k) box.add(sense * (turn * surface.at[surface.edges[k].from]));
  }
  return {std::move(surface), spatial::BoxTree(std::move(boxes))};
}

std::optional<Witness> touching_position(const WitnessSolids& s, const SolidContact& named, Vec3 x) {
  const Standing p(s, true, x), q(s, false, x);
  const double slack = 1e-11 * (s.size + length(x));
  const std::optional<Vec3> first = by_features(p, q, named);
  if (first && p.holds(named.p, *first, slack) && q.holds(named.q, *first, slack)) return Witness{*first, named};
  Box at;
  at.add(x);
  at.grow(slack);
  std::optional<Witness> found;
  s.p->faces.any_reflected_pair(s.q->faces, at, [&](std::uint32_t i, std::uint32_t j) {
    if (const std::optional<Vec3> w = of_faces(p, q, i, j, slack))
      found = Witness{*w, {p.feature_at(i, *w, slack), q.feature_at(j, *w, slack)}};
    return found.has_value();
  });
  return found;
}

}  // namespace dymsum::depth
