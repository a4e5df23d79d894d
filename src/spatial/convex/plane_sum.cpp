#include "spatial/convex/plane_sum.h"

#include <stdexcept>

namespace dymsum::spatial {
namespace {

/// How an edge of P and an edge of Q lie to each other in the plane: the sign of their cross product along the normal,
/// and, when that is zero, of their dot product.
struct Turn {
  int cross = 0, dot = 0;
};

/// Edge vectors of both polygons, compared exactly.
class Edges {
 public:
  Edges(const Signs& signs, const std::vector<std::uint32_t>& p, const std::vector<std::uint32_t>& q, int op,
        std::uint32_t f)
      : s_(signs), p_(p), q_(q), op_(op), f_(f) {}

  Turn turn(std::size_t i, std::size_t j) const {
    return s_.with_types([&](auto c, auto m) {
      using C = decltype(c);
      using M = decltype(m);
      const Polytope &a = s_.poly(0), &b = s_.poly(1);
      const auto u = a.template place<C>(p_[(i + 1) % p_.size()]) - a.template place<C>(p_[i]);
      const auto w = exact::apply(s_.map().template matrix<M>(0),
                                  b.template place<C>(q_[(j + 1) % q_.size()]) - b.template place<C>(q_[j]));
      const auto perpendicular = exact::cross(u, w);
      const int side =
          op_ == 0
              ? exact::sign(exact::dot(perpendicular, a.template normal_vector<C>(f_)))
              : exact::sign(exact::dot(perpendicular, exact::apply(exact::transposed(s_.map().template matrix<M>(1)),
                                                                   b.template normal_vector<C>(f_))));
      return Turn{side, exact::sign(exact::dot(u, w))};
    });
  }
  /// The edge of Q from which the angle of edge 0 of P is next.
  std::size_t first_of_q() const {
    for (std::size_t j = 0; j < q_.size(); ++j) {
      const Turn before = turn(0, (j + q_.size() - 1) % q_.size()), here = turn(0, j);
      const bool after_the_one_before = before.cross < 0 || (before.cross == 0 && before.dot < 0);
      const bool not_after_this = here.cross > 0 || (here.cross == 0 && here.dot > 0);
      if (after_the_one_before && not_after_this) return j;
    }
    throw std::logic_error("plane_sum: not a convex polygon");
  }

 private:
  const Signs& s_;
  const std::vector<std::uint32_t>&p_, &q_;
  int op_;
  std::uint32_t f_;
};

}  // namespace

std::vector<VertexPair> plane_sum(const Signs& signs, const std::vector<std::uint32_t>& p,
                                  const std::vector<std::uint32_t>& q, int op, std::uint32_t f) {
  std::vector<VertexPair> sum;
  if (q.size() == 1) {
    for (const std::uint32_t v : p) sum.push_back({v, q[0]});
    return sum;
  }
  if (p.size() == 1) {
    for (const std::uint32_t v : q) sum.push_back({p[0], v});
    return sum;
  }
  // Both turn once; the smaller angle comes next, and gaps are at most a half turn.
  const Edges edges(signs, p, q, op, f);
  const std::size_t start = edges.first_of_q();
  std::size_t i = 0, j = 0;
  while (i < p.size() || j < q.size()) {
    sum.push_back({p[i % p.size()], q[(start + j) % q.size()]});
    if (i == p.size()) {
      ++j;
    } else if (j == q.size()) {
      ++i;
    } else {
      const Turn t = edges.turn(i, (start + j) % q.size());
      if (t.cross >= 0) ++i;
      if (t.cross < 0 || (t.cross == 0 && t.dot > 0)) ++j;
    }
  }
  return sum;
}

}  // namespace dymsum::spatial
