#include "depth/continuous_witness.h"

#include <algorithm>
#include <cmath>

namespace dymsum::depth {
namespace {

using spatial::cross;
using spatial::dot;
using spatial::length;

/// Where two segments come nearest, seen from the first one.
Vec3 between_edges(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, r = c - a;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), det = uu * vv - uv * uv;
  if (!(det > 1e-20 * uu * vv)) return a;
  return a + std::clamp((dot(u, r) * vv - dot(v, r) * uv) / det, 0.0, 1.0) * u;
}

std::optional<Vec3> by_features(const WitnessSolids& s, const SolidContact& c, Vec3 x) {
  using Kind = SolidFeature::Kind;
  if (c.q.kind == Kind::vertex) return x + s.turned(c.q.a);
  if (c.p.kind == Kind::vertex) return s.p->at[c.p.a];
  if (c.p.kind == Kind::edge && c.q.kind == Kind::edge)
    return between_edges(s.p->at[c.p.a], s.p->at[c.p.b], x + s.turned(c.q.a), x + s.turned(c.q.b));
  return std::nullopt;
}

std::optional<Vec3> by_all_edges(const WitnessSolids& s, Vec3 x, double slack) {
  for (const SurfaceEdge& q : s.q->edges) {
    if (q.from > q.to) continue;
    const Vec3 c = x + s.turned(q.from), d = x + s.turned(q.to);
    const Vec3 low{std::min(c.x, d.x) - slack, std::min(c.y, d.y) - slack, std::min(c.z, d.z) - slack};
    const Vec3 high{std::max(c.x, d.x) + slack, std::max(c.y, d.y) + slack, std::max(c.z, d.z) + slack};
    for (const SurfaceEdge& p : s.p->edges) {
      const Vec3 a = s.p->at[p.from], b = s.p->at[p.to];
      if (p.from > p.to || std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x || std::max(a.y, b.y) < low.y ||
          std::min(a.y, b.y) > high.y || std::max(a.z, b.z) < low.z || std::min(a.z, b.z) > high.z)
        continue;
      const Vec3 w = between_edges(a, b, c, d);
      if (length(cross(w - c, d - c)) <= slack * length(d - c) && s.touches(w, x, slack)) return w;
    }
  }
  return std::nullopt;
}

}  // namespace

bool WitnessSolids::touches(Vec3 w, Vec3 x, double slack) const {
  return comes_within(*p, w, slack) && comes_within(*q, spatial::row_times(w - x, turn), slack);
}

std::optional<Vec3> touching_position(const WitnessSolids& s, const SolidContact& contact, Vec3 x) {
  double size = length(x);
  for (const Vec3& v : s.p->at) size = std::max(size, std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  const double slack = 1e-11 * size;
  if (const std::optional<Vec3> w = by_features(s, contact, x); w && s.touches(*w, x, slack)) return w;
  for (const Vec3& w : s.p->at)
    if (comes_within(*s.q, spatial::row_times(w - x, s.turn), slack)) return w;
  for (std::uint32_t v = 0; v < s.q->at.size(); ++v)
    if (const Vec3 w = x + s.turned(v); comes_within(*s.p, w, slack)) return w;
  return by_all_edges(s, x, slack);
}

}  // namespace dymsum::depth
