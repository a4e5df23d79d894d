#include "depth/continuous_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace dymsum::depth {
namespace {

using spatial::cross;
using spatial::dot;
using spatial::length;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Vec3 unit_or_zero(Vec3 v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Vec3{};
}

Vec3 loops_normal(const std::vector<Vec3>& at, const std::vector<std::vector<std::uint32_t>>& loops) {
  Vec3 sum;
  const Vec3 origin = at[loops.front().front()];
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      sum = sum + cross(at[loop[k]] - origin, at[loop[(k + 1) % loop.size()]] - origin);
  return unit_or_zero(sum);
}

SurfaceEdge edge_between(const std::vector<Vec3>& at, std::uint32_t from, std::uint32_t to, Vec3 normal,
                         std::uint32_t face) {
  SurfaceEdge e;
  e.from = from, e.to = to, e.face = face;
  const Vec3 d = at[to] - at[from];
  e.length = length(d), e.along = unit_or_zero(d), e.out = cross(e.along, normal);
  return e;
}

SurfaceFace add_face(const std::vector<Vec3>& at, const std::vector<std::vector<std::uint32_t>>& loops,
                     std::uint32_t index, std::vector<SurfaceEdge>& edges) {
  SurfaceFace face;
  face.normal = loops_normal(at, loops);
  face.first = static_cast<std::uint32_t>(edges.size());
  face.low = {kInfinite, kInfinite, kInfinite}, face.high = -face.low;
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec3 v = at[loop[k]];
      face.low = {std::min(face.low.x, v.x), std::min(face.low.y, v.y), std::min(face.low.z, v.z)};
      face.high = {std::max(face.high.x, v.x), std::max(face.high.y, v.y), std::max(face.high.z, v.z)};
      edges.push_back(edge_between(at, loop[k], loop[(k + 1) % loop.size()], face.normal, index));
    }
  face.last = static_cast<std::uint32_t>(edges.size());
  return face;
}

/// The neighbour where a solid touches itself along an edge: the one across the solid.
std::uint32_t neighbour(const ContinuousSurface& s, const SurfaceEdge& e, const std::vector<std::uint32_t>& others) {
  std::uint32_t best = kNoEdge;
  double least = kInfinite;
  const Vec3 n = s.faces[e.face].normal;
  for (const std::uint32_t k : others) {
    const Vec3 into = -s.edges[k].out;
    double angle = std::atan2(-dot(into, n), -dot(into, e.out));
    if (angle <= 0) angle += 2 * std::numbers::pi;
    if (angle < least) least = angle, best = k;
  }
  return best;
}

void link(ContinuousSurface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> by_ends;
  for (std::uint32_t k = 0; k < s.edges.size(); ++k) by_ends[{s.edges[k].from, s.edges[k].to}].push_back(k);
  for (SurfaceEdge& e : s.edges) {
    const auto others = by_ends.find({e.to, e.from});
    if (others != by_ends.end()) e.twin = neighbour(s, e, others->second);
  }
}

double box_distance(const SurfaceFace& f, Vec3 from) {
  const auto gap = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  const Vec3 d{gap(f.low.x, f.high.x, from.x), gap(f.low.y, f.high.y, from.y), gap(f.low.z, f.high.z, from.z)};
  return length(d);
}

/// Whether a position in its plane lies inside of a face: an odd number of edges to one side of it.
bool holds(const std::vector<Vec3>& at, const SurfaceFace& f, const std::vector<SurfaceEdge>& edges, Vec3 x) {
  const Vec3 n = f.normal;
  const bool drop_x = std::abs(n.x) >= std::abs(n.y) && std::abs(n.x) >= std::abs(n.z);
  const bool drop_y = !drop_x && std::abs(n.y) >= std::abs(n.z);
  const auto flat = [&](Vec3 v) {
    return drop_x ? std::pair(v.y, v.z) : drop_y ? std::pair(v.z, v.x) : std::pair(v.x, v.y);
  };
  const auto [px, py] = flat(x);
  bool inside = false;
  for (std::uint32_t k = f.first; k < f.last; ++k) {
    const auto [ax, ay] = flat(at[edges[k].from]);
    const auto [bx, by] = flat(at[edges[k].to]);
    if ((ay > py) != (by > py) && px < ax + (py - ay) / (by - ay) * (bx - ax)) inside = !inside;
  }
  return inside;
}

Vec3 nearest_of_edge(const std::vector<Vec3>& at, const SurfaceEdge& e, Vec3 from) {
  const double s = std::clamp(dot(e.along, from - at[e.from]), 0.0, e.length);
  return at[e.from] + s * e.along;
}

/// Offers the nearest point of one face, where it is nearer than `best`.
void offer_face(const std::vector<Vec3>& at, const SurfaceFace& f, const std::vector<SurfaceEdge>& edges, Vec3 from,
                std::uint32_t index, SurfacePoint& best) {
  if (box_distance(f, from) >= best.distance) return;
  const double height = dot(f.normal, from - at[edges[f.first].from]);
  if (std::abs(height) >= best.distance) return;
  const Vec3 foot = from - height * f.normal;
  if (holds(at, f, edges, foot)) {
    best = {foot, index, std::abs(height)};
    return;
  }
  for (std::uint32_t k = f.first; k < f.last; ++k) {
    const Vec3 x = nearest_of_edge(at, edges[k], from);
    const double d = length(x - from);
    if (d < best.distance) best = {x, index, d};
  }
}

/// Whether the surface is seen from inside: of all faces at the nearest position the one counts that faces it most.
bool seen_from_behind(const ContinuousSurface& s, Vec3 from, const SurfacePoint& nearest) {
  const double near = nearest.distance * (1 + 0x1p-30);
  double most = 0;
  for (std::uint32_t k = 0; k < s.faces.size(); ++k) {
    SurfacePoint x;
    x.distance = near;
    offer_face(s.at, s.faces[k], s.edges, from, k, x);
    if (x.face == kNoEdge) continue;
    const double towards = dot(s.faces[k].normal, x.at - from);
    if (std::abs(towards) > std::abs(most)) most = towards;
  }
  return most > 0;
}

void offer_feet(const ContinuousSurface& s, Vec3 from, double reach, std::vector<SurfacePoint>& all) {
  for (std::uint32_t k = 0; k < s.faces.size(); ++k) {
    const SurfaceFace& f = s.faces[k];
    const double height = dot(f.normal, from - s.start(s.edges[f.first]));
    if (height > 0 || -height > reach || box_distance(f, from) > reach) continue;
    const Vec3 foot = from - height * f.normal;
    if (holds(s.at, f, s.edges, foot)) all.push_back({foot, k, -height});
  }
}

void offer_edges(const ContinuousSurface& s, Vec3 from, double reach, std::vector<SurfacePoint>& all) {
  for (const SurfaceEdge& e : s.edges) {
    if (e.twin == kNoEdge) continue;
    const Vec3 x = nearest_of_edge(s.at, e, from), back = from - x;
    const double d = length(back);
    if (d > reach || dot(back, e.out) < 0 || dot(back, s.edges[e.twin].out) < 0) continue;
    all.push_back({x, e.face, d});
  }
}

}  // namespace

ContinuousSurface continuous_surface(const SpatialSum& sum, double scale) {
  ContinuousSurface s;
  for (const Point3& v : sum.vertices) s.at.push_back({scale * v.x, scale * v.y, scale * v.z});
  for (const SpatialFace& face : sum.faces) {
    s.faces.push_back(add_face(s.at, face.loops, static_cast<std::uint32_t>(s.faces.size()), s.edges));
    s.faces.back().contact = {face.p, face.q};
  }
  link(s);
  for (const auto& loops : sum.tight_faces) s.tight.push_back(add_face(s.at, loops, kNoEdge, s.tight_edges));
  for (const auto& [a, b] : sum.tight_segments) s.tight.push_back(add_face(s.at, {{a, b}}, kNoEdge, s.tight_edges));
  for (const std::uint32_t v : sum.tight_points) s.tight_points.push_back(s.at[v]);
  return s;
}

ContinuousSurface continuous_surface(const Mesh& mesh, double scale) {
  ContinuousSurface s;
  for (const Point3& v : mesh.vertices()) s.at.push_back({scale * v.x, scale * v.y, scale * v.z});
  for (const Face& face : mesh.faces())
    s.faces.push_back(add_face(s.at, {face}, static_cast<std::uint32_t>(s.faces.size()), s.edges));
  return s;
}

bool comes_within(const ContinuousSurface& s, Vec3 from, double reach) {
  SurfacePoint best;
  best.distance = reach;
  for (std::uint32_t k = 0; k < s.faces.size() && best.face == kNoEdge; ++k)
    offer_face(s.at, s.faces[k], s.edges, from, k, best);
  return best.face != kNoEdge;
}

bool face_comes_within(const ContinuousSurface& s, std::uint32_t face, Vec3 from, double reach) {
  SurfacePoint best;
  best.distance = reach;
  offer_face(s.at, s.faces[face], s.edges, from, face, best);
  return best.face != kNoEdge;
}

SurfacePoint nearest_face(const ContinuousSurface& s, Vec3 from) {
  SurfacePoint best;
  best.distance = kInfinite;
  for (std::uint32_t k = 0; k < s.faces.size(); ++k) offer_face(s.at, s.faces[k], s.edges, from, k, best);
  return best;
}

SurfaceDistance nearest_on(const ContinuousSurface& s, Vec3 from) {
  SurfaceDistance result;
  result.face = nearest_face(s, from);
  result.inside = result.face.face != kNoEdge && seen_from_behind(s, from, result.face);
  result.nearest = result.face;
  for (const SurfaceFace& f : s.tight) offer_face(s.at, f, s.tight_edges, from, kNoEdge, result.nearest);
  for (const Vec3& v : s.tight_points)
    if (const double d = length(v - from); d < result.nearest.distance) result.nearest = {v, kNoEdge, d};
  return result;
}

std::vector<SurfacePoint> local_minima(const ContinuousSurface& s, Vec3 from, double reach) {
  std::vector<SurfacePoint> all;
  offer_feet(s, from, reach, all);
  offer_edges(s, from, reach, all);
  std::sort(all.begin(), all.end(), [](const SurfacePoint& a, const SurfacePoint& b) {
    return std::pair(a.distance, a.face) < std::pair(b.distance, b.face);
  });
  // An edge offers its point twice, and a vertex as often as it has edges.
  const auto same = [](const SurfacePoint& a, const SurfacePoint& b) { return length(a.at - b.at) == 0; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

namespace {

using spatial::Box;

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
