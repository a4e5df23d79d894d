#include "provenance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "numbers.h"

namespace dymsum::oracles {
namespace {

/// A region's vertices by number, and for each the number of the vertex its edge runs to, if it starts one.
template <class N>
struct Numbered {
  std::vector<Pt<N>> vertices;
  std::vector<std::optional<std::size_t>> next, previous;
  std::vector<bool> on_ring;
};

template <class N>
Numbered<N> numbered(const Region& region, int sign) {
  Numbered<N> out;
  const auto add = [&](const Point& c) {
    const N x = from_double<N>(c.x), y = from_double<N>(c.y);
    out.vertices.push_back(sign > 0 ? Pt<N>{x, y} : Pt<N>{-x, -y});
    out.next.push_back(out.vertices.size());
    out.on_ring.push_back(false);
  };
  const auto add_ring = [&](const Ring& ring) {
    const std::size_t first = out.vertices.size();
    for (const Point& c : ring) add(c);
    for (std::size_t i = first; i < out.on_ring.size(); ++i) out.on_ring[i] = true;
    out.next.back() = first;
  };
  for (const Part& part : region.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  for (const Polyline& line : region.polylines()) {
    for (const Point& c : line) add(c);
    out.next.back().reset();
  }
  for (const Point& c : region.points()) {
    add(c);
    out.next.back().reset();
  }
  out.previous.resize(out.vertices.size());
  for (std::size_t i = 0; i < out.vertices.size(); ++i)
    if (out.next[i]) out.previous[*out.next[i]] = i;
  return out;
}

template <class N>
std::string point_text(const Pt<N>& c) {
  std::ostringstream out;
  out << "(" << to_big(c.x) << ", " << to_big(c.y) << ")";
  return out.str();
}

bool within(double rounded, const Big& exact, double error) {
  const Big gap = from_double<Big>(rounded) - exact;
  return (gap < 0 ? Big(-gap) : gap) <= from_double<Big>(error);
}

template <class N>
class Checker {
 public:
  Checker(const Region& p, const Region& q, Combination combination, const PlanarSum& sum)
      : p_(numbered<N>(p, 1)),
        q_(numbered<N>(q, combination == Combination::sum ? 1 : -1)),
        combination_(combination),
        sum_(sum) {}

  std::string run() {
    check_error_bound();
    for (const SumPart& part : sum_.parts) {
      check_ring(part.outer);
      for (const SumRing& hole : part.holes) check_ring(hole);
    }
    for (const auto* segments : {&sum_.segments, &sum_.tight_segments})
      for (const SumSegment& s : *segments) check_lone(s.from), check_lone(s.to);
    for (const auto* points : {&sum_.points, &sum_.tight_points})
      for (const SumVertex& v : *points) check_lone(v);
    return wrong_;
  }

 private:
  void complain(const std::string& what, const Pt<N>& at) {
    if (wrong_.empty()) wrong_ = "provenance: " + what + " at " + point_text(at);
  }

  Pt<N> position(const SumVertex& v) {
    const RationalPoint at = sum_.exact(v);
    return {from_digits<N>(at.x.numerator(), at.x.denominator()), from_digits<N>(at.y.numerator(), at.y.denominator())};
  }

  /// The stated error is small against the extent of the operands, 2^-33 of it, or against what doubles decide.
  void check_error_bound() {
    double extent = 0;
    for (const auto* operand : {&p_, &q_})
      for (const Pt<N>& c : operand->vertices)
        for (const N& value : {c.x, c.y})
          extent = std::max(extent, std::fabs(to_big(value).template convert_to<double>()));
    if (sum_.at_error > std::max(extent * 0x1p-33, 0x1p-1069))
      wrong_ = "provenance: the error bound of positions is too large";
  }

  /// The segment a contact names, and whether both its features exist.
  std::optional<Seg<N>> segment(const Contact& contact) {
    const bool of_p = contact.kind == Contact::Kind::edge_of_p;
    if (contact.p >= p_.vertices.size() || contact.q >= q_.vertices.size()) return std::nullopt;
    const Numbered<N>& owner = of_p ? p_ : q_;
    const std::size_t edge = of_p ? contact.p : contact.q;
    if (!owner.next[edge]) return std::nullopt;
    const Pt<N>& corner = of_p ? q_.vertices[contact.q] : p_.vertices[contact.p];
    const auto [from, to] = straight_run(owner, edge);
    return Seg<N>{owner.vertices[from] + corner, owner.vertices[to] + corner};
  }

  /// The ends of the longest straight run of edges through an edge: collinear vertices of an operand end no contact.
  static std::pair<std::size_t, std::size_t> straight_run(const Numbered<N>& owner, std::size_t edge) {
    const auto goes_on = [&](std::size_t a, std::size_t b, std::size_t c) {
      const Pt<N>&u = owner.vertices[a], &v = owner.vertices[b], &w = owner.vertices[c];
      return turn(u, v, w) == 0 && (v.x - u.x) * (w.x - v.x) + (v.y - u.y) * (w.y - v.y) > N(0);
    };
    std::size_t from = edge, to = *owner.next[edge];
    while (owner.next[to] && goes_on(from, to, *owner.next[to])) to = *owner.next[to];
    while (owner.previous[from] && goes_on(*owner.previous[from], from, to)) from = *owner.previous[from];
    return {from, to};
  }

  static bool has_edge(const Numbered<N>& owner, std::size_t vertex) {
    return owner.next[vertex].has_value() || owner.previous[vertex].has_value();
  }

  bool directed(const Contact& contact) {
    if (combination_ == Combination::erosion) return contact.kind == Contact::Kind::edge_of_p;
    return contact.kind == Contact::Kind::edge_of_p ? p_.on_ring[contact.p] : q_.on_ring[contact.q];
  }

  void check_position(const SumVertex& v, const Pt<N>& at) {
    if (!within(v.at.x, to_big(at.x), sum_.at_error) || !within(v.at.y, to_big(at.y), sum_.at_error))
      complain("position farther off than at_error", at);
    if (v.corner_p == SumVertex::kNone && v.corner_q == SumVertex::kNone) return;
    if (v.corner_p >= p_.vertices.size() || v.corner_q >= q_.vertices.size())
      return complain("corner does not exist", at);
    if (p_.vertices[v.corner_p] + q_.vertices[v.corner_q] != at) complain("corner lies elsewhere", at);
  }

  /// An edge that starts (or ends) at `at` and has its other end at `other` runs along the contact.
  void check_along(const Contact& contact, const Pt<N>& at, const Pt<N>& other, bool starts) {
    const std::optional<Seg<N>> s = segment(contact);
    if (!s) return complain("contact does not exist", at);
    if (!on_segment(*s, at)) return complain("vertex is off its contact", at);
    if (turn(s->a, s->b, other) != 0) return complain("edge is off the line of its contact", at);
    const Pt<N> way = other - at, ahead = s->b - at, back = s->a - at;
    const auto dot = [](const Pt<N>& u, const Pt<N>& v) { return u.x * v.x + u.y * v.y; };
    const bool over_b = dot(way, ahead) > N(0), over_a = dot(way, back) > N(0);
    if (!over_a && !over_b) return complain("edge only touches its contact", at);
    if (directed(contact) && (starts ? !over_b : !over_a)) complain("edge runs against its contact", at);
  }

  void check_ring(const SumRing& ring) {
    const std::size_t n = ring.vertices.size();
    std::vector<Pt<N>> at;
    for (const SumVertex& v : ring.vertices) at.push_back(position(v));
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      check_position(ring.vertices[i], at[i]);
      check_along(ring.vertices[i].out, at[i], at[j], true);
      check_along(ring.vertices[j].in, at[j], at[i], false);
    }
  }

  /// A vertex of a feature: on its contacts where these exist, otherwise a named corner.
  void check_lone(const SumVertex& v) {
    const Pt<N> at = position(v);
    check_position(v, at);
    if (v.corner_p < p_.vertices.size() && v.corner_q < q_.vertices.size() && !has_edge(p_, v.corner_p) &&
        !has_edge(q_, v.corner_q))
      return;  // the sum of two points has no contacts
    for (const Contact& contact : {v.in, v.out}) {
      const std::optional<Seg<N>> s = segment(contact);
      if (s && !on_segment(*s, at)) complain("feature is off its contact", at);
      if (!s && v.corner_p == SumVertex::kNone) complain("feature names neither contact nor corner", at);
    }
  }

  Numbered<N> p_, q_;
  Combination combination_;
  const PlanarSum& sum_;
  std::string wrong_;
};

}  // namespace

std::string check_provenance(const Region& p, const Region& q, Combination combination, const PlanarSum& sum) {
  try {
    return Checker<Small>(p, q, combination, sum).run();
  } catch (const Overflow&) {
    return Checker<Big>(p, q, combination, sum).run();
  }
}

}  // namespace dymsum::oracles
