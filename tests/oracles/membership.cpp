#include "membership.h"

#include <algorithm>
#include <stdexcept>

namespace dymsum::oracles {
namespace {

enum class Where { outside, boundary, inside };

/// Where c lies in the parts bounded by `rim`: their interiors are disjoint, so a ray crosses it an odd number of times
/// exactly from inside.
template <class I>
Where locate(const std::vector<Seg<I>>& rim, const Pt<I>& c) {
  bool odd = false;
  for (const Seg<I>& e : rim) {
    if (on_segment(e, c)) return Where::boundary;
    if ((e.a.y > c.y) == (e.b.y > c.y)) continue;
    const int side = turn(e.a, e.b, c);
    if (e.b.y > e.a.y ? side > 0 : side < 0) odd = !odd;
  }
  return odd ? Where::inside : Where::outside;
}

template <class I>
bool boxes_apart(const Seg<I>& s, const Seg<I>& t) {
  return std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) || std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
         std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y);
}

/// The open segments cross at a single point.
template <class I>
bool cross_properly(const Seg<I>& s, const Seg<I>& t) {
  if (boxes_apart(s, t)) return false;
  return turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0;
}

template <class I>
bool share_a_point(const Seg<I>& s, const Seg<I>& t) {
  if (boxes_apart(s, t)) return false;
  return cross_properly(s, t) || on_segment(s, t.a) || on_segment(s, t.b) || on_segment(t, s.a) || on_segment(t, s.b);
}

template <class I>
bool any_fraction(const std::vector<Seg<I>>& some, const std::vector<Seg<I>>& others) {
  for (const Seg<I>& s : some)
    for (const Seg<I>& t : others)
      if (share_a_point(s, t)) return true;
  return false;
}

template <class I>
bool any_cross(const std::vector<Seg<I>>& some, const std::vector<Seg<I>>& others) {
  for (const Seg<I>& s : some)
    for (const Seg<I>& t : others)
      if (cross_properly(s, t)) return true;
  return false;
}

template <class I>
bool any_not_outside(const std::vector<Pt<I>>& positions, const std::vector<Seg<I>>& rim) {
  return std::any_of(positions.begin(), positions.end(),
                     [&](const Pt<I>& c) { return locate(rim, c) != Where::outside; });
}

template <class I>
bool any_inside(const std::vector<Pt<I>>& positions, const std::vector<Seg<I>>& rim) {
  return std::any_of(positions.begin(), positions.end(),
                     [&](const Pt<I>& c) { return locate(rim, c) == Where::inside; });
}

template <class I>
bool any_on(const std::vector<Pt<I>>& positions, const std::vector<Seg<I>>& segments) {
  for (const Pt<I>& c : positions)
    for (const Seg<I>& s : segments)
      if (on_segment(s, c)) return true;
  return false;
}

/// A piece of `whole` between two consecutive places where the rim it was split by has a vertex, and its midpoint.
template <class I>
struct Run {
  Seg<I> whole;
  Pt<I> midpoint;
};

/// Splits segments at the vertices of `rim` on them. Coordinates must be even so that midpoints are whole numbers.
template <class I>
std::vector<Run<I>> split(const std::vector<Seg<I>>& segments, const std::vector<Seg<I>>& rim) {
  std::vector<Run<I>> runs;
  std::vector<Pt<I>> stops;
  for (const Seg<I>& s : segments) {
    stops = {s.a, s.b};
    for (const Seg<I>& e : rim)
      if (on_segment(s, e.a)) stops.push_back(e.a);  // every vertex of a rim starts an edge
    std::sort(stops.begin(), stops.end());
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Pt<I> sum = stops[i] + stops[i + 1];
      runs.push_back({s, {sum.x / I(2), sum.y / I(2)}});
    }
  }
  return runs;
}

template <class I>
bool same_direction(const Seg<I>& s, const Seg<I>& t) {
  return (s.b.x - s.a.x) * (t.b.x - t.a.x) + (s.b.y - s.a.y) * (t.b.y - t.a.y) > I(0);
}

/// Closed sets share a point; pairs of lower dimension count only on request.
template <class I>
bool meet(const Pieces<I>& p, const Pieces<I>& r, bool thin_pairs) {
  if (any_fraction(p.rim, r.rim) || any_fraction(p.rim, r.lines) || any_fraction(p.lines, r.rim)) return true;
  if (any_not_outside(p.corners, r.rim) || any_not_outside(p.dots, r.rim)) return true;
  if (any_not_outside(r.corners, p.rim) || any_not_outside(r.dots, p.rim)) return true;
  if (!thin_pairs) return false;
  if (any_fraction(p.lines, r.lines) || any_on(p.dots, r.lines) || any_on(r.dots, p.lines)) return true;
  for (const Pt<I>& c : p.dots)
    if (std::find(r.dots.begin(), r.dots.end(), c) != r.dots.end()) return true;
  return false;
}

/// The interior of p's parts meets r, or the interior of r's parts meets p. A proper crossing enters the half-plane on
/// the left of a rim's edge. Without one the rims only touch at their vertices, so between these each edge stays
/// inside, outside or along the other rim, and its midpoints tell.
template <class I>
bool overlap(const Pieces<I>& p, const Pieces<I>& r) {
  if (any_cross(p.rim, r.rim) || any_cross(p.rim, r.lines) || any_cross(p.lines, r.rim)) return true;
  for (const Run<I>& run : split(p.rim, r.rim)) {
    if (locate(r.rim, run.midpoint) == Where::inside) return true;
    for (const Seg<I>& e : r.rim)  // both interiors on the same side of a common run
      if (on_segment(e, run.midpoint) && same_direction(e, run.whole)) return true;
  }
  for (const Run<I>& run : split(r.rim, p.rim))
    if (locate(p.rim, run.midpoint) == Where::inside) return true;
  for (const Run<I>& run : split(p.lines, r.rim))
    if (locate(r.rim, run.midpoint) == Where::inside) return true;
  for (const Run<I>& run : split(r.lines, p.rim))
    if (locate(p.rim, run.midpoint) == Where::inside) return true;
  return any_inside(p.corners, r.rim) || any_inside(r.corners, p.rim) || any_inside(p.dots, r.rim) ||
         any_inside(r.dots, p.rim);
}

/// r lies in p's parts.
template <class I>
bool hold(const Pieces<I>& p, const Pieces<I>& r) {
  const auto outside = [&](const Pt<I>& c) { return locate(p.rim, c) == Where::outside; };
  if (any_cross(p.rim, r.rim) || any_cross(p.rim, r.lines)) return false;
  if (std::any_of(r.corners.begin(), r.corners.end(), outside) || std::any_of(r.dots.begin(), r.dots.end(), outside))
    return false;
  for (const Run<I>& run : split(r.lines, p.rim))
    if (outside(run.midpoint)) return false;
  for (const Run<I>& run : split(r.rim, p.rim)) {
    if (outside(run.midpoint)) return false;
    for (const Seg<I>& e : p.rim)  // p's outside is where r's inside is
      if (on_segment(e, run.midpoint) && !same_direction(e, run.whole)) return false;
  }
  for (const Run<I>& run : split(p.rim, r.rim))
    if (locate(r.rim, run.midpoint) == Where::inside) return false;
  return true;
}

std::int64_t lcm_small(std::int64_t a, std::int64_t b) { return Small(Wide{a / std::gcd(a, b)} * b, Wide{1}).num(); }

/// Coordinates as integers after multiplication with 2 * scale, all even.
template <class I>
Pt<I> scaled_point(const Pt<Small>& c, std::int64_t scale) {
  return {I(c.x.num() * (scale / c.x.den()) * 2), I(c.y.num() * (scale / c.y.den()) * 2)};
}

template <class I>
Pt<I> scaled_point(const Pt<Big>& c, const BigInt& scale) {
  return {numerator_of(c.x) * (scale / denominator_of(c.x)) * 2, numerator_of(c.y) * (scale / denominator_of(c.y)) * 2};
}

template <class I, class N, class Scale>
Pieces<I> scaled_pieces(const Pieces<N>& in, const Scale& scale) {
  Pieces<I> out;
  for (const Seg<N>& s : in.rim) out.rim.push_back({scaled_point<I>(s.a, scale), scaled_point<I>(s.b, scale)});
  for (const Seg<N>& s : in.lines) out.lines.push_back({scaled_point<I>(s.a, scale), scaled_point<I>(s.b, scale)});
  for (const Pt<N>& c : in.dots) out.dots.push_back(scaled_point<I>(c, scale));
  for (const Pt<N>& c : in.corners) out.corners.push_back(scaled_point<I>(c, scale));
  return out;
}

/// z + sign * region. A half turn keeps the interior on the left.
template <class I>
void position(Pieces<I>& region, const Pt<I>& z, int sign) {
  const auto move = [&](Pt<I>& c) { c = sign > 0 ? z + c : z - c; };
  for (Seg<I>& s : region.rim) move(s.a), move(s.b);
  for (Seg<I>& s : region.lines) move(s.a), move(s.b);
  for (Pt<I>& c : region.dots) move(c);
  for (Pt<I>& c : region.corners) move(c);
}

template <class N, class Visit>
void visit_coordinates(const Pieces<N>& region, const Visit& visit) {
  for (const Pt<N>& c : region.corners) visit(c.x), visit(c.y);
  for (const Pt<N>& c : region.dots) visit(c.x), visit(c.y);
}

template <class I, class N, class Scale, class Query>
bool query_scaled(const Pieces<N>& p, const Pieces<N>& q, const Pt<N>& z, const Scale& scale, int sign,
                  const Query& query) {
  const Pieces<I> fixed = scaled_pieces<I>(p, scale);
  Pieces<I> moved = scaled_pieces<I>(q, scale);
  position(moved, scaled_point<I>(z, scale), sign);
  return query(fixed, moved);
}

/// Scales everything to integers that are just wide enough and asks there.
template <class Query>
bool query_at(const Pieces<Small>& p, const Pieces<Small>& q, const Pt<Small>& z, int sign, const Query& query) {
  std::int64_t scale = lcm_small(z.x.den(), z.y.den());
  double reach = std::fabs(static_cast<double>(z.x.num()) / static_cast<double>(z.x.den()));
  reach = std::max(reach, std::fabs(static_cast<double>(z.y.num()) / static_cast<double>(z.y.den())));
  double extent = 0;
  const auto widen = [&](const Small& value) {
    scale = lcm_small(scale, value.den());
    extent = std::max(extent, std::fabs(static_cast<double>(value.num()) / static_cast<double>(value.den())));
  };
  visit_coordinates(p, widen);
  visit_coordinates(q, widen);
  const double largest = (reach + extent) * static_cast<double>(scale) * 2.01;
  if (largest < 0x1p29) return query_scaled<std::int64_t>(p, q, z, scale, sign, query);
  if (largest < 0x1p60) return query_scaled<Wide>(p, q, z, scale, sign, query);
  throw Overflow{};
}

template <class Query>
bool query_at(const Pieces<Big>& p, const Pieces<Big>& q, const Pt<Big>& z, int sign, const Query& query) {
  BigInt scale = boost::multiprecision::lcm(denominator_of(z.x), denominator_of(z.y));
  const auto widen = [&](const Big& value) { scale = boost::multiprecision::lcm(scale, denominator_of(value)); };
  visit_coordinates(p, widen);
  visit_coordinates(q, widen);
  return query_scaled<BigInt>(p, q, z, scale, sign, query);
}

}  // namespace

/// Rims that touch do so at vertices of their edges: inside an edge, the region is locally the half-plane on its left.
template <class N>
std::vector<Seg<N>> cut_where_touched(const std::vector<Seg<N>>& rim) {
  std::vector<Seg<N>> out;
  for (const Seg<N>& s : rim) {
    std::vector<Pt<N>> stops{s.a, s.b};
    for (const Seg<N>& e : rim)
      if (on_segment(s, e.a)) stops.push_back(e.a);
    std::sort(stops.begin(), stops.end());
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    if (s.b < s.a) std::reverse(stops.begin(), stops.end());
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) out.push_back({stops[i], stops[i + 1]});
  }
  return out;
}

template <class N>
Pieces<N> pieces_of(const RegionData& region) {
  Pieces<N> out;
  const auto exact = [](const Point& c) { return Pt<N>{from_double<N>(c.x), from_double<N>(c.y)}; };
  const auto add_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      out.rim.push_back({exact(ring[i]), exact(ring[(i + 1) % ring.size()])});
      out.corners.push_back(exact(ring[i]));
    }
  };
  for (const Part& part : region.parts) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  out.rim = cut_where_touched(out.rim);
  for (const Polyline& line : region.polylines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) out.lines.push_back({exact(line[i]), exact(line[i + 1])});
    for (const Point& c : line) out.corners.push_back(exact(c));
  }
  for (const Point& c : region.points) out.dots.push_back(exact(c));
  return out;
}

template <class N>
Membership<N>::Membership(const RegionData& p, const RegionData& q) : p_(pieces_of<N>(p)), q_(pieces_of<N>(q)) {}

template <class N>
bool Membership<N>::meets(const Pt<N>& z) const {
  return query_at(p_, q_, z, -1, [](const auto& p, const auto& r) { return meet(p, r, true); });
}

template <class N>
bool Membership<N>::meets_with_area(const Pt<N>& z) const {
  return query_at(p_, q_, z, -1, [](const auto& p, const auto& r) { return meet(p, r, false); });
}

template <class N>
bool Membership<N>::overlaps(const Pt<N>& z) const {
  return query_at(p_, q_, z, -1, [](const auto& p, const auto& r) { return overlap(p, r); });
}

template <class N>
bool Membership<N>::holds(const Pt<N>& z) const {
  if (!p_.lines.empty() || !p_.dots.empty()) throw std::logic_error("holds() needs a container of parts only");
  return query_at(p_, q_, z, +1, [](const auto& p, const auto& r) { return hold(p, r); });
}

bool meets_closed(const RegionData& p, const RegionData& q, const Pt<Big>& z) { return Membership<Big>(p, q).meets(z); }
bool overlaps_open(const RegionData& p, const RegionData& q, const Pt<Big>& z) {
  return Membership<Big>(p, q).overlaps(z);
}
bool holds_closed(const RegionData& p, const RegionData& q, const Pt<Big>& z) { return Membership<Big>(p, q).holds(z); }

template Pieces<Small> pieces_of<Small>(const RegionData&);
template Pieces<Big> pieces_of<Big>(const RegionData&);
template class Membership<Small>;
template class Membership<Big>;

}  // namespace dymsum::oracles
