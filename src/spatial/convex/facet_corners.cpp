#include "spatial/convex/facet_corners.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "spatial/gauss/polytope.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {
namespace {

// The sum of two convex polygons, segments or points that lie in parallel planes: a facet of a sum where directions
// coincide.

/// A vertex, an edge or a face of a polytope: the half-edges round it, counter-clockwise seen from outside (none, both
/// of an edge, all of a face), and the vertex from which the first one leaves.
struct FlatFeature {
  std::uint32_t vertex = 0;
  std::span<const HalfEdge> edges;
};

/// The error of n . (u x M w) for unit vectors, times the norm of the map: three unit vectors (8 roundings each), an
/// entry (2), the products and the sums of a cross product (3) and of two vectors times a matrix (6); in all at most
/// sqrt(2) Frobenius norms, which are at most sqrt(3) norms each.
constexpr double kTurnError = exact::rounding_bound(3 * (3 * 8 + 2 + 3 + 6), 128);

/// How an edge of P and an edge of Q lie to each other in the plane: the sign of their cross product along the normal,
/// and, when that is zero, of their dot product.
struct Turn {
  int cross = 0, dot = 0;
};

class Edges {
 public:
  /// Seen from operand op, which the normal n of f belongs to: the map to it takes edges to edges, and turns none the
  /// other way.
  Edges(const Signs& signs, const FlatFeature& p, const FlatFeature& q, int op, std::uint32_t f)
      : s_(signs), p_(p.edges), q_(q.edges), op_(op), f_(f), error_(kTurnError * signs.map().norm(op)) {
    const Vec3 n = s_.poly(op).normal[f];
    const Mat3& m = s_.map().approx(op);
    seen_.reserve(p_.size() + q_.size());
    for (const HalfEdge h : p_) seen_.push_back(op == 0 ? cross(n, s_.poly(0).along(h)) : m * s_.poly(0).along(h));
    for (const HalfEdge h : q_) seen_.push_back(op == 0 ? m * s_.poly(1).along(h) : cross(n, s_.poly(1).along(h)));
  }

  Turn turn(std::size_t i, std::size_t j) const {
    const double product = dot(seen_[i], seen_[p_.size() + j]), cross = op_ == 0 ? product : -product;
    if (cross > error_) return {1, 0};
    if (cross < -error_) return {-1, 0};
    if (const int dot = plainly_parallel(p_[i], q_[j])) return {0, dot};
    return exact_turn(p_[i], q_[j]);
  }
  /// The edge of Q from which the angle of edge 0 of P is next.
  std::size_t first_of_q() const {
    Turn before = turn(0, q_.size() - 1);
    for (std::size_t j = 0; j < q_.size(); ++j) {
      const Turn here = turn(0, j);
      const bool after_the_one_before = before.cross < 0 || (before.cross == 0 && before.dot < 0);
      const bool not_after_this = here.cross > 0 || (here.cross == 0 && here.dot > 0);
      if (after_the_one_before && not_after_this) return j;
      before = here;
    }
    throw std::logic_error("plane_sum: not a convex polygon");
  }

 private:
  /// The sign of the dot product where doubles determine it and every term of the cross product has a factor zero, as
  /// for edges along an axis that both solids keep; 0 otherwise. Doubles that stand for numbers of the two narrow kinds
  /// are zero only where those are.
  int plainly_parallel(HalfEdge u, HalfEdge w) const {
    constexpr int kNarrow = 61, kNarrowMap = 126;
    if (std::max(s_.poly(0).bits, s_.poly(1).bits) > kNarrow || s_.map().bits() > kNarrowMap) return 0;
    const Vec3 a = s_.poly(0).along(u), b = s_.poly(1).along(w);
    const Mat3& m = s_.map().approx(0);
    const std::array<double, 3> x{a.x, a.y, a.z};
    std::array<bool, 3> zero;  // of M w
    for (std::size_t k = 0; k < 3; ++k)
      zero[k] = (m[k].x == 0 || b.x == 0) && (m[k].y == 0 || b.y == 0) && (m[k].z == 0 || b.z == 0);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (i != j && x[i] != 0 && !zero[j]) return 0;
    const double along = dot(a, m * b);
    return along > s_.error(0) ? 1 : along < -s_.error(0) ? -1 : 0;
  }
  Turn exact_turn(HalfEdge edge_of_p, HalfEdge edge_of_q) const {
    return s_.with_types([&](auto c, auto m) {
      using C = decltype(c);
      using M = decltype(m);
      const Polytope &a = s_.poly(0), &b = s_.poly(1);
      const auto u = a.template edge_vector<C>(edge_of_p);
      const auto w = exact::apply(s_.map().template matrix<M>(0), b.template edge_vector<C>(edge_of_q));
      const auto perpendicular = exact::cross(u, w);
      const int side =
          op_ == 0
              ? exact::sign(exact::dot(perpendicular, a.template normal_vector<C>(f_)))
              : exact::sign(exact::dot(perpendicular, exact::apply(exact::transposed(s_.map().template matrix<M>(1)),
                                                                   b.template normal_vector<C>(f_))));
      return Turn{side, exact::sign(exact::dot(u, w))};
    });
  }

  const Signs& s_;
  std::span<const HalfEdge> p_, q_;
  int op_;
  std::uint32_t f_;
  double error_;
  std::vector<Vec3>
      seen_;  // of all edges of P, then of Q: the product of two is their cross product along n, up to its sign
};

/// p and q: features of P and Q that are perpendicular to the outward normal of face f of operand op. Appends the true
/// vertices of their sum, counter-clockwise seen against that normal: edges of equal direction become one. O(edges),
/// exact where doubles do not decide.
void append_plane_sum(const Signs& signs, const FlatFeature& p, const FlatFeature& q, int op, std::uint32_t f,
                      std::vector<VertexPair>& sum) {
  const auto vertex_of_p = [&](std::size_t i) { return p.edges.empty() ? p.vertex : signs.poly(0).origin[p.edges[i]]; };
  const auto vertex_of_q = [&](std::size_t j) { return q.edges.empty() ? q.vertex : signs.poly(1).origin[q.edges[j]]; };
  if (p.edges.empty() || q.edges.empty()) {
    for (std::size_t k = 0; k < std::max(p.edges.size(), q.edges.size()); ++k)
      sum.push_back({vertex_of_p(k), vertex_of_q(k)});
    return;
  }
  // Both turn once; the smaller angle comes next, and gaps are at most a half turn.
  const Edges edges(signs, p, q, op, f);
  const std::size_t np = p.edges.size(), nq = q.edges.size(), start = edges.first_of_q();
  const auto around = [nq](std::size_t j) { return j < nq ? j : j - nq; };
  std::size_t i = 0, j = 0;
  while (i < np || j < nq) {
    sum.push_back({vertex_of_p(i < np ? i : 0), vertex_of_q(around(start + (j < nq ? j : 0)))});
    if (i == np) {
      ++j;
    } else if (j == nq) {
      ++i;
    } else {
      const Turn t = edges.turn(i, around(start + j));
      if (t.cross >= 0) ++i;
      if (t.cross < 0 || (t.cross == 0 && t.dot > 0)) ++j;
    }
  }
}

void append_edges(const Polytope& p, std::uint32_t f, std::vector<HalfEdge>& edges) {
  HalfEdge h = p.first[f];
  do {
    edges.push_back(h);
    h = p.next[h];
  } while (h != p.first[f]);
}

/// The edges at the extreme vertex of face f of operand op that are level, as positions in its ring: at most two, which
/// then are neighbours.
struct LevelEdges {
  std::uint32_t count = 0;
  std::array<std::size_t, 2> slot{};
};
LevelEdges level_edges(const Overlay& overlay, int op, std::uint32_t f) {
  const Polytope& other = overlay.poly(1 - op);
  const Signs& signs = overlay.signs();
  const std::uint32_t v = overlay.extreme(op, f);
  LevelEdges level;
  look_above(other, v, signs.row_now(op, f), -signs.error(op), [&](std::uint32_t k) {
    if (signs.true_sign(op, f, other.leaving(v)[k]) != 0) return;
    if (level.count == 2) throw std::logic_error("level_edges: three level edges at a vertex");
    level.slot[level.count++] = k;
  });
  return level;
}

// All edges at the extreme vertex fall or are level; level ones bound the extreme feature, and two level ones are
// neighbours in the ring: the face is on the left of the first of the two.
std::uint32_t level_face(const Overlay& overlay, int op, std::uint32_t f, const LevelEdges& level) {
  const Polytope& other = overlay.poly(1 - op);
  const std::size_t k = level.slot[1] == level.slot[0] + 1 ? level.slot[0] : level.slot[1];
  return other.face[other.leaving(overlay.extreme(op, f))[k]];
}

}  // namespace

SolidFeature vertex_feature(const Polytope& p, std::uint32_t v) {
  return {SolidFeature::Kind::vertex, p.source_vertex[v], 0};
}

SolidFeature edge_feature(const Polytope& p, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t from = p.source_vertex[a], to = p.source_vertex[b];
  return {SolidFeature::Kind::edge, std::min(from, to), std::max(from, to)};
}

SolidFeature face_feature(const Polytope& p, std::uint32_t f) {
  return {SolidFeature::Kind::face, p.source_face[f], 0};
}

FacetFeatures append_face_and_vertex(const Overlay& overlay, int op, std::uint32_t f,
                                     std::vector<VertexPair>& corners) {
  const Polytope &mine = overlay.poly(op), &other = overlay.poly(1 - op);
  const std::uint32_t v = overlay.extreme(op, f);
  HalfEdge h = mine.first[f];
  do {
    corners.push_back(op == 0 ? VertexPair{mine.origin[h], v} : VertexPair{v, mine.origin[h]});
    h = mine.next[h];
  } while (h != mine.first[f]);
  const SolidFeature face = face_feature(mine, f), vertex = vertex_feature(other, v);
  return op == 0 ? FacetFeatures{face, vertex, kNoFace} : FacetFeatures{vertex, face, kNoFace};
}

FacetFeatures append_face(const Overlay& overlay, int op, std::uint32_t f, std::vector<VertexPair>& corners) {
  const LevelEdges edges = level_edges(overlay, op, f);
  if (edges.count == 0) return append_face_and_vertex(overlay, op, f, corners);
  const Polytope &mine = overlay.poly(op), &other = overlay.poly(1 - op);
  const std::uint32_t v = overlay.extreme(op, f), g = edges.count == 2 ? level_face(overlay, op, f, edges) : kNoFace;
  const HalfEdge level = other.leaving(v)[edges.slot[0]];
  const SolidFeature face = face_feature(mine, f),
                     beyond = g == kNoFace ? edge_feature(other, v, other.target(level)) : face_feature(other, g);
  const FacetFeatures features = op == 0 ? FacetFeatures{face, beyond, g} : FacetFeatures{beyond, face, g};
  if (op == 1 && g != kNoFace) return features;
  std::vector<HalfEdge> round;
  round.reserve(16);  // enough for most
  append_edges(mine, f, round);
  const std::size_t n = round.size(), first = corners.size();
  if (g == kNoFace) round.insert(round.end(), {level, twin(level)});
  else append_edges(other, g, round);
  const FlatFeature a{0, std::span(round).first(n)}, b{v, std::span(round).subspan(n)};
  append_plane_sum(overlay.signs(), op == 0 ? a : b, op == 0 ? b : a, op, f, corners);
  const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(first);
  std::rotate(begin, std::min_element(begin, corners.end()), corners.end());
  return features;
}

FacetFeatures append_crossing(const Overlay& overlay, const Crossing& c, std::vector<VertexPair>& corners) {
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  // The arc of e has the cell of its second vertex on its left; h leaves the cell of its origin.
  const std::uint32_t a = p.origin[2 * c.p], b = p.target(2 * c.p), from = q.origin[c.q], to = q.target(c.q);
  corners.insert(corners.end(), {{a, to}, {b, to}, {b, from}, {a, from}});
  return {edge_feature(p, a, b), edge_feature(q, from, to), kNoFace};
}

bool crosses_properly(const Overlay& overlay, const Crossing& c) {
  const Signs& s = overlay.signs();
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  return s.true_sign(0, p.face[2 * c.p], c.q) != 0 && s.true_sign(0, p.face[2 * c.p + 1], c.q) != 0 &&
         s.true_sign(1, q.face[c.q], 2 * c.p) != 0 && s.true_sign(1, q.face[twin(c.q)], 2 * c.p) != 0;
}

/// A facet differs from what the overlay's words say only where something is truly zero. A face of the walker has a
/// level edge only where doubles cannot prove that all fall. A crossing is improper where the circle of the walker's
/// edge goes through a face at the other edge, which doubles cannot exclude then, or where its arc only begins or ends
/// there, at a face of the first kind. A face of the other operand has a level edge only where an arc of the walker
/// goes through its direction: then some arc from there is crossed by it, after the infinitesimal rotation, as its arcs
/// leave in directions that no half-plane holds, and that crossing is improper; or it faces the same way as a face of
/// the walker.
void CloseFacets::find(const Overlay& overlay) {
  for (int op = 0; op < 2; ++op) faces_[op].assign(overlay.poly(op).face_count(), 0);
  crossings_.assign(overlay.crossing_indices(), 0);
  const int w = overlay.walker();
  const Polytope &mine = overlay.poly(w), &other = overlay.poly(1 - w);
  for (std::uint32_t f = 0; f < mine.face_count(); ++f) {
    if (overlay.provably_extreme(f)) continue;
    faces_[w][f] = 1;
    HalfEdge h = mine.first[f];
    do {
      for (std::uint32_t id = overlay.first_crossing(w, h / 2); id != kNoCrossing; id = overlay.crossing(id).next[w])
        crossings_[id] = 1;
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
  for (std::uint32_t id = 0; id < overlay.crossing_indices(); ++id) {
    if (!overlay.is_crossing(id) || overlay.provably_crosses(id)) continue;
    const std::uint32_t e = edge_of(1 - w, overlay.crossing(id));
    crossings_[id] = faces_[1 - w][other.face[2 * e]] = faces_[1 - w][other.face[2 * e + 1]] = 1;
  }
  for (const FacePair& pair : overlay.pairs()) faces_[0][pair.p] = faces_[1][pair.q] = 1;
}

}  // namespace dymsum::spatial
