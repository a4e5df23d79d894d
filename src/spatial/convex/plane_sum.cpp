#include "spatial/convex/plane_sum.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dymsum::spatial {
namespace {

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

}  // namespace

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

}  // namespace dymsum::spatial
