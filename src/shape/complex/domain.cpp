#include "shape/complex/domain.h"

namespace dymsum::shape {
namespace {

using exact::cross_sign;
using exact::dot_sign;
using exact::orient_sign;

Mark infinite(int sign) { return {.kind = sign < 0 ? Mark::Kind::minus_infinity : Mark::Kind::plus_infinity}; }

/// A directed edge by its ends.
struct Line {
  Point a, b;
  explicit Line(const Site& s) : a(s.a), b(s.b) {}
  /// 1: p lies strictly on the right, where the discs are.
  int side(Point p) const { return -orient_sign(a, b, p); }
};

class DomainOf {
 public:
  DomainOf(Order& order, const Section& s, std::uint32_t j) : order_(order), walks_(order.walks()), s_(s), j_(j) {}

  Domain operator()() {
    if (walks_.is_edge(s_.site)) {
      walks_.is_edge(j_) ? edge_along_edge() : vertex_along_edge();
    } else {
      walks_.is_edge(j_) ? edge_about_vertex() : vertex_about_vertex();
    }
    return out_;
  }

 private:
  const Site& site(std::uint32_t s) const { return walks_.sites[s]; }

  /// The foot on j goes back as U grows.
  void edge_along_edge() {
    const Line s(site(s_.site)), j(site(j_));
    const int start = s.side(j.a), end = s.side(j.b);
    if (start <= 0 && end <= 0) return;                                                   // j lies behind s
    if (j.side(s.a) <= 0 && j.side(s.b) <= 0) return;                                     // s lies behind j
    if (cross_sign(s.a, s.b, j.a, j.b) == 0 && dot_sign(s.a, s.b, j.a, j.b) > 0) return;  // never both at once
    // An end of j behind s: lines cross, beyond an end of s, and discs between s and j reach as far as s does.
    out_.add(end > 0 ? order_.tangent(s_, j_, 1) : infinite(-1), start > 0 ? order_.tangent(s_, j_, 0) : infinite(1));
  }

  /// The contact's direction at j turns clockwise as U grows, from the one away from s to itself.
  void vertex_along_edge() {
    const Line s(site(s_.site));
    if (s.side(site(j_).a) <= 0) return;
    if (walks_.is_isolated(j_)) {
      out_.add(infinite(-1), infinite(1));
      return;
    }
    const SiteEnds& ends = walks_.ends[j_];
    const Line in(site(ends.prev)), next(site(ends.next));
    const int in_cross = -cross_sign(s.a, s.b, in.a, in.b), out_cross = -cross_sign(s.a, s.b, next.a, next.b);
    const bool from_away = in_cross == 0 && dot_sign(s.a, s.b, in.a, in.b) > 0;
    const bool to_away = out_cross == 0 && dot_sign(s.a, s.b, next.a, next.b) > 0;
    const Mark low = to_away ? infinite(-1) : order_.tangent(s_, ends.next, 0);
    const Mark high = from_away ? infinite(1) : order_.tangent(s_, ends.prev, 1);
    if (in_cross > 0 && out_cross < 0) {  // the direction away from s is one of j's
      out_.add(infinite(-1), high);
      out_.add(low, infinite(1));
    } else {
      out_.add(low, high);
    }
  }

  void edge_about_vertex() {
    const Line j(site(j_));
    if (j.side(site(s_.site).a) <= 0) return;
    add_turn(j_, 1, j_, 0);
  }

  void vertex_about_vertex() {
    if (behind()) return;
    if (walks_.is_isolated(j_)) {
      out_.add(infinite(-1), infinite(1));
      return;
    }
    add_turn(walks_.ends[j_].next, 0, walks_.ends[j_].prev, 1);
  }

  /// No direction of the vertex has j in front.
  bool behind() const {
    if (walks_.is_isolated(s_.site)) return false;
    const SiteEnds& ends = walks_.ends[s_.site];
    const Line in(site(ends.prev)), out(site(ends.next));
    const Point v = site(s_.site).a, p = site(j_).a;
    const bool of_first = cross_sign(in.a, in.b, v, p) < 0, of_last = cross_sign(out.a, out.b, v, p) < 0;
    const bool between = dot_sign(in.a, in.b, v, p) >= 0 && dot_sign(out.a, out.b, v, p) <= 0;
    return !of_first && !of_last && !between;
  }

  /// Counter-clockwise from one tangent to another.
  void add_turn(std::uint32_t from, int from_end, std::uint32_t to, int to_end) {
    const bool from_opposite = order_.is_opposite(s_, from, from_end);
    const bool to_opposite = order_.is_opposite(s_, to, to_end);
    const Mark low = from_opposite ? infinite(-1) : order_.tangent(s_, from, from_end);
    const Mark high = to_opposite ? infinite(1) : order_.tangent(s_, to, to_end);
    if (order_.compare(s_, low, high) < 0) {
      out_.add(low, high);
    } else {  // past the direction opposite to the axis
      out_.add(infinite(-1), high);
      out_.add(low, infinite(1));
    }
  }

  Order& order_;
  const Walks& walks_;
  Section s_;
  std::uint32_t j_;
  Domain out_;
};

}  // namespace

Domain domain(Order& order, const Section& s, std::uint32_t j) { return DomainOf(order, s, j)(); }

}  // namespace dymsum::shape
