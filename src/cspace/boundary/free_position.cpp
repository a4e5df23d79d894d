// Proof. Let the interiors meet, and let no edges cross properly. If some boundary ring of one enters the interior of
// the other and does not lie in it as a whole, it leaves it at a common point of the boundaries: at a vertex of one on
// an edge or a vertex of the other, as edges do not cross, and there the sectors that the two fill have directions in
// common. Otherwise a whole ring of one lies in the interior of the other, or no boundary enters the other's interior.
// Then two parts whose interiors meet are equal and have a common vertex with equal sectors. So three tests tell:
// proper crossings; sectors at vertices on edges and vertices; a vertex of every ring that touches nothing. Pieces
// without area have no sectors: if a polyline enters the interior of a part and is not inside as a whole, it leaves it
// at a common point too, and there one of its rays lies in the open sector. A point that touches is free. Two pieces
// without area never overlap, so what touches one of them may still lie inside a part.
#include "cspace/boundary/free_position.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dymsum::planar {
namespace {

/// A ray along an edge of the obstacle, or of the reflected robot.
struct Ray {
  WalkSegment of;
  int sign = 1;
};
/// The directions from one ray to another, counter-clockwise, that a region fills.
struct Sector {
  Ray from, to;
};

class FreePosition {
 public:
  FreePosition(const SignsAt& signs, const ExactPosition& z)
      : signs_(signs), forms_(signs.forms()), z_(z), near_(signs.near(z).value()) {
    for (std::uint32_t op = 0; op < 2; ++op) {
      const auto& loops = forms_.operand(op).loops;
      touches_[op].assign(loops.size(), 0);
      loop_of_[op].resize(forms_.size(op));
      for (std::uint32_t l = 0; l < loops.size(); ++l)
        for (std::uint32_t v = loops[l].first; v < loops[l].last; ++v) loop_of_[op][v] = l;
    }
    const Heading h = signs.heading();
    for (const Point& q : forms_.points(1))
      robot_.push_back({near_.x - (h.c * q.x - h.s * q.y), near_.y - (h.s * q.x + h.c * q.y)});
  }

  bool run() {
    for (std::uint32_t i = 0; i < forms_.size(0); ++i)
      for (std::uint32_t j = 0; j < forms_.size(1); ++j)
        if (!boxes_apart(i, j) && overlap_at(i, j)) return false;
    return !a_ring_is_inside();
  }

 private:
  bool boxes_apart(std::uint32_t i, std::uint32_t j) const {
    const double margin = SignsAt::kNear * forms_.span();
    const Point a = forms_.points(0)[i], b = forms_.points(0)[forms_.operand(0).next[i]];
    const Point c = robot_[j], d = robot_[forms_.operand(1).next[j]];
    return std::max(a.x, b.x) + margin < std::min(c.x, d.x) || std::max(c.x, d.x) + margin < std::min(a.x, b.x) ||
           std::max(a.y, b.y) + margin < std::min(c.y, d.y) || std::max(c.y, d.y) + margin < std::min(a.y, b.y);
  }

  // Side 0: vertex v of the robot is on the left of edge e of the obstacle. Side 1: vertex v of the obstacle is on the
  // left of edge e of the robot, which is the reflected operand's, turned round.
  int side(std::uint32_t op, std::uint32_t e, std::uint32_t v) const { return signs_.side_sign({op, e, v}, z_, near_); }

  // The edge at the robot's own direction.
  static Ray along(std::uint32_t op, std::uint32_t e) { return {{op, e, 0}, op == 0 ? 1 : -1}; }
  static Ray back(std::uint32_t op, std::uint32_t e) { return {{op, e, 0}, op == 0 ? -1 : 1}; }
  Sector at_edge(std::uint32_t op, std::uint32_t e) const { return {along(op, e), back(op, e)}; }
  Sector at_vertex(std::uint32_t op, std::uint32_t v) const {
    return {along(op, v), back(op, forms_.operand(op).prev[v])};
  }

  bool overlap_at(std::uint32_t i, std::uint32_t j) {
    if (!has_area(0, i) && !has_area(1, j)) return false;
    for (const std::uint32_t op : {0u, 1u})
      if (forms_.is_point(op, op == 0 ? i : j)) return point_at(op, op == 0 ? i : j, op == 0 ? j : i);
    const std::uint32_t i1 = forms_.operand(0).next[i], j1 = forms_.operand(1).next[j];
    const int s0 = side(0, i, j), s1 = side(0, i, j1);
    if (s0 * s1 > 0) return false;
    const int r0 = side(1, j, i), r1 = side(1, j, i1);
    if (s0 * s1 < 0 && r0 * r1 < 0) return true;
    return (s0 == 0 && overlap_at_vertex(0, i, j)) || (r0 == 0 && overlap_at_vertex(1, j, i));
  }

  // Vertex v of the other operand is on the line of edge e: sectors, where it lies on the edge. At the edge's end
  // another edge starts.
  bool overlap_at_vertex(std::uint32_t op, std::uint32_t e, std::uint32_t v) {
    const WalkSegment s{op, e, v};
    const Fraction at = signs_.along(s, z_);
    const int from = signs_.sign(at), to = signs_.compare(at, signs_.length(s));
    if (from < 0 || to > 0) return false;
    if (has_area(1 - op, v)) touches_[op][loop_of_[op][e]] = 1;
    if (has_area(op, e)) touches_[1 - op][loop_of_[1 - op][v]] = 1;
    if (to == 0) return false;
    const Sector here = from > 0 ? at_edge(op, e) : at_vertex(op, e), there = at_vertex(1 - op, v);
    if (has_area(op, e) && has_area(1 - op, v)) return meet(here, there);
    return has_area(op, e) ? enters(there, here) : enters(here, there);
  }

  // Point v on edge e of the other operand touches it.
  bool point_at(std::uint32_t op, std::uint32_t v, std::uint32_t e) {
    if (side(1 - op, e, v) != 0) return false;
    const WalkSegment s{1 - op, e, v};
    const Fraction at = signs_.along(s, z_);
    if (signs_.sign(at) >= 0 && signs_.compare(at, signs_.length(s)) <= 0) touches_[op][loop_of_[op][v]] = 1;
    return false;
  }

  int cross(const Ray& u, const Ray& v) const { return u.sign * v.sign * signs_.cross(u.of, v.of); }
  bool same(const Ray& u, const Ray& v) const {
    return cross(u, v) == 0 && u.sign * v.sign * signs_.dot(u.of, v.of) > 0;
  }
  // Counter-clockwise from `first`: 0 before a half turn, 1 at it, 2 beyond. Of another direction.
  int half(const Ray& first, const Ray& u) const { return 1 - cross(first, u); }
  bool starts_in(const Ray& u, const Sector& s) const {
    if (same(u, s.from)) return true;
    if (same(u, s.to)) return false;
    const int a = half(s.from, u), b = half(s.from, s.to);
    return a != b ? a < b : a != 1 && cross(u, s.to) > 0;
  }
  bool meet(const Sector& s, const Sector& t) const { return starts_in(s.from, t) || starts_in(t.from, s); }
  // Of a polyline only the two rays count, each in the open sector of what has area.
  bool enters(const Sector& rays, const Sector& s) const { return is_in(rays.from, s) || is_in(rays.to, s); }
  bool is_in(const Ray& u, const Sector& s) const { return starts_in(u, s) && !same(u, s.from); }
  bool has_area(std::uint32_t op, std::uint32_t v) const {
    return forms_.operand(op).components[forms_.operand(op).component_of[v]].dimension == 2;
  }

  bool a_ring_is_inside() const {
    for (std::uint32_t op = 0; op < 2; ++op)
      for (std::uint32_t l = 0; l < touches_[op].size(); ++l) {
        if (touches_[op][l]) continue;
        for (const Component& c : forms_.operand(1 - op).components)
          if (c.dimension == 2 && inside(op, forms_.operand(op).loops[l].first, c)) return true;
      }
    return false;
  }

  // Vertex v in a component of the other operand: edges that cross the line of the edge at v ahead of v.
  bool inside(std::uint32_t op, std::uint32_t v, const Component& c) const {
    const Operand& other = forms_.operand(1 - op);
    const bool is_point = forms_.is_point(op, v);
    const auto left = [&](std::uint32_t k) { return is_point ? left_of(op, v, c.first, k) : side(op, v, k) > 0; };
    bool in = false;
    for (std::uint32_t k = c.first; k < c.last; ++k) {
      const bool from = left(k), to = left(other.next[k]);
      if (from != to) in ^= (side(1 - op, k, v) > 0) == to;
    }
    return in;
  }
  // Whether vertex k of the other operand is on the left of the line through v in the direction of its edge e: v and k
  // from the line of e.
  bool left_of(std::uint32_t op, std::uint32_t v, std::uint32_t e, std::uint32_t k) const {
    const WalkSegment s{1 - op, e, v};
    const auto at = [&](std::uint32_t of, std::uint32_t i) { return of == 0 ? forms_.points(0)[i] : robot_[i]; };
    const Point a = at(1 - op, e), b = at(1 - op, forms_.operand(1 - op).next[e]), p = at(op, v), q = at(1 - op, k);
    const double value = (b.x - a.x) * (q.y - p.y) - (b.y - a.y) * (q.x - p.x);
    if (std::abs(value) > 4 * SignsAt::kNear * forms_.length1(s) * forms_.span()) return value > 0;
    const Fraction own = signs_.side(s, z_);
    const exact::Polynomial its = forms_.exact_side(s, op == 0 ? Pair{v, k} : Pair{k, v}, signs_.chart());
    return signs_.compare({its, exact::Polynomial({exact::Big(exact::BigInteger(1))})}, own) > 0;
  }

  const SignsAt& signs_;
  const TurningForms& forms_;
  const ExactPosition& z_;
  Point near_;
  std::vector<Point> robot_;
  std::array<std::vector<std::uint8_t>, 2> touches_;
  std::array<std::vector<std::uint32_t>, 2> loop_of_;
};

}  // namespace

bool is_free(const SignsAt& signs, const ExactPosition& z) { return FreePosition(signs, z).run(); }

}  // namespace dymsum::planar
