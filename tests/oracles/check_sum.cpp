#include "check_sum.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "exact_shape.h"
#include "provenance.h"
#include "random.h"
#include "reference_sum.h"

namespace dymsum::oracles {
namespace {

template <class N>
std::string text(const Pt<N>& c) {
  std::ostringstream out;
  out << "(" << to_big(c.x) << ", " << to_big(c.y) << ")";
  return out.str();
}

template <class N>
std::string text(const Seg<N>& s) {
  return text(s.a) + " -> " + text(s.b);
}

template <class N>
std::string differences(const std::string& what, std::vector<N> want, std::vector<N> have) {
  std::sort(want.begin(), want.end());
  if (!std::is_sorted(have.begin(), have.end())) return what + " are not sorted";
  for (std::size_t i = 0; i + 1 < have.size(); ++i)
    if (have[i] == have[i + 1]) return what + ": twice " + text(have[i]);
  for (const N& one : want)
    if (!std::binary_search(have.begin(), have.end(), one)) return what + ": missing " + text(one);
  for (const N& one : have)
    if (!std::binary_search(want.begin(), want.end(), one)) return what + ": unexpected " + text(one);
  return "";
}

template <class N>
std::string check_ring(const ExactRing<N>& ring, bool outer) {
  const std::size_t n = ring.size();
  if (n < 3) return "a ring has fewer than three vertices";
  for (std::size_t i = 0; i < n; ++i) {
    const Pt<N>&a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
    if (a == b) return "a ring repeats the vertex " + text(a);
    if (turn(a, b, c) == 0) return "a ring has the collinear vertex " + text(b);
    if (a < ring[0]) return "a ring does not start at its smallest vertex " + text(a);
  }
  const N area = doubled_area(ring);
  if (outer ? !(area > N(0)) : !(area < N(0))) return "a ring at " + text(ring[0]) + " has the wrong orientation";
  return "";
}

/// The ring's edges cut at the stops on them; empty with a sentence in `wrong` when a ring vertex is no stop.
template <class N>
std::vector<Seg<N>> cut(const ExactRing<N>& ring, const std::vector<Pt<N>>& stops) {
  std::vector<Seg<N>> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pt<N>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    const auto low = std::lower_bound(stops.begin(), stops.end(), std::min(a, b));
    std::vector<Pt<N>> on;
    for (auto it = low; it != stops.end() && !(std::max(a, b) < *it); ++it)
      if (turn(a, b, *it) == 0) on.push_back(*it);
    if (b < a) std::reverse(on.begin(), on.end());
    if (on.empty() || on.front() != a || on.back() != b) return {};
    for (std::size_t k = 0; k + 1 < on.size(); ++k) out.push_back({on[k], on[k + 1]});
  }
  return out;
}

/// A way through a stop: where it comes from and where it goes.
template <class N>
struct Pass {
  Pt<N> from, to;
};

/// d points strictly into the sector on the left of the way in -> at -> out.
template <class N>
bool on_left(const Pt<N>& in, const Pt<N>& at, const Pt<N>& out, const Pt<N>& d) {
  const bool left_of_in = turn(in, at, d) > 0, left_of_out = turn(at, out, d) > 0;
  return turn(in, at, out) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

template <class N>
std::string check_passes(const std::vector<std::vector<Seg<N>>>& rings) {
  std::map<Pt<N>, std::vector<Pass<N>>> passes;
  for (const auto& edges : rings)
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Seg<N>&in = edges[i], &out = edges[(i + 1) % edges.size()];
      passes[in.b].push_back({in.a, out.b});
    }
  for (const auto& [at, list] : passes)
    for (std::size_t i = 0; i < list.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (on_left(list[i].from, at, list[i].to, list[j].from) != on_left(list[i].from, at, list[i].to, list[j].to))
          return "rings cross at " + text(at);
  return "";
}

template <class N>
bool inside_ring(const ExactRing<N>& ring, const Pt<N>& c) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pt<N>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y > c.y) == (b.y > c.y)) continue;
    if ((b.y > a.y) == (turn(a, b, c) > 0)) odd = !odd;
  }
  return odd;
}

template <class N>
bool on_ring(const ExactRing<N>& ring, const Pt<N>& c) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pt<N>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (turn(a, b, c) == 0 && !(c < std::min(a, b)) && !(std::max(a, b) < c)) return true;
  }
  return false;
}

/// A point on a hole's first edge where it touches no outer ring: it may touch them at finitely many points.
template <class N>
Pt<N> position_on_first_edge(const ExactRing<N>& hole, const ExactShape<N>& shape) {
  for (int k = 2;; ++k) {
    const N t = N(1) / N(k);
    const Pt<N> m{hole[0].x + (hole[1].x - hole[0].x) * t, hole[0].y + (hole[1].y - hole[0].y) * t};
    if (k == 1000 || std::none_of(shape.parts.begin(), shape.parts.end(),
                                  [&](const ExactPart<N>& part) { return on_ring(part.outer, m); }))
      return m;
  }
}

/// Every hole lies in its own outer ring, and in no smaller one.
template <class N>
std::string check_nesting(const ExactShape<N>& shape) {
  for (const ExactPart<N>& part : shape.parts)
    for (const ExactRing<N>& hole : part.holes) {
      const Pt<N> m = position_on_first_edge(hole, shape);
      if (!inside_ring(part.outer, m)) return "the hole at " + text(hole[0]) + " lies outside its part";
      for (const ExactPart<N>& other : shape.parts)
        if (inside_ring(other.outer, m) && doubled_area(other.outer) < doubled_area(part.outer))
          return "the hole at " + text(hole[0]) + " belongs to a smaller part";
    }
  return "";
}

template <class N>
std::string check_rings(const ExactShape<N>& shape) {
  for (const ExactPart<N>& part : shape.parts) {
    if (std::string wrong = check_ring(part.outer, true); !wrong.empty()) return wrong;
    for (const ExactRing<N>& hole : part.holes)
      if (std::string wrong = check_ring(hole, false); !wrong.empty()) return wrong;
  }
  if (!(canonical(shape) == shape)) return "parts, holes or features are not in canonical order";
  return check_nesting(shape);
}

template <class N>
std::string check_rim(const ExactShape<N>& shape, const ReferenceSum<N>& reference) {
  std::vector<std::vector<Seg<N>>> rings;
  const auto add = [&](const ExactRing<N>& ring) {
    rings.push_back(cut(ring, reference.stops));
    return !rings.back().empty();
  };
  for (const ExactPart<N>& part : shape.parts) {
    if (!add(part.outer)) return "the ring at " + text(part.outer[0]) + " has a vertex off the arrangement";
    for (const ExactRing<N>& hole : part.holes)
      if (!add(hole)) return "the ring at " + text(hole[0]) + " has a vertex off the arrangement";
  }
  std::vector<Seg<N>> rim;
  for (const auto& edges : rings) rim.insert(rim.end(), edges.begin(), edges.end());
  std::sort(rim.begin(), rim.end());
  if (std::string wrong = differences("boundary pieces", reference.rim, rim); !wrong.empty()) return wrong;
  return check_passes(rings);
}

template <class N>
std::string check_against(const ReferenceSum<N>& reference, const PlanarSum& sum) {
  const ExactShape<N> shape = exact_shape<N>(sum);
  std::string wrong = check_rings(shape);
  if (wrong.empty()) wrong = check_rim(shape, reference);
  if (wrong.empty()) wrong = differences("segments", reference.segments, shape.segments);
  if (wrong.empty()) wrong = differences("points", reference.points, shape.points);
  if (wrong.empty()) wrong = differences("tight segments", reference.tight_segments, shape.tight_segments);
  if (wrong.empty()) wrong = differences("tight points", reference.tight_points, shape.tight_points);
  return wrong;
}

/// Runs `work` on Small and, where that is too small, on Big.
template <class Work>
std::string on_either(const Work& work) {
  try {
    return work(Small());
  } catch (const Overflow&) {
    return work(Big());
  }
}

/// Every vertex and edge midpoint touches without overlap; random places agree with the rings.
template <class N>
std::string spot_check(const Region& p, const Region& q, const PlanarSum& sum, int positions, std::uint64_t seed) {
  const ExactShape<N> shape = exact_shape<N>(sum);
  if (std::string wrong = check_rings(shape); !wrong.empty()) return wrong;
  const Membership<N> member(p.data(), q.data());
  std::vector<ExactRing<N>> rings;
  for (const ExactPart<N>& part : shape.parts) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  const N half = N(1) / N(2);
  const auto touches = [&](const Pt<N>& c) { return member.meets(c) && !member.overlaps(c); };
  for (const ExactRing<N>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Pt<N> next = ring[(i + 1) % ring.size()], m{(ring[i].x + next.x) * half, (ring[i].y + next.y) * half};
      if (!touches(ring[i])) return "the boundary vertex " + text(ring[i]) + " is no touching position";
      if (!touches(m)) return "the boundary midpoint " + text(m) + " is no touching position";
    }
  for (const Pt<N>& c : shape.tight_points)
    if (!touches(c)) return "the tight point " + text(c) + " is no touching position";
  for (const Seg<N>& s : shape.tight_segments)
    if (!touches({(s.a.x + s.b.x) * half, (s.a.y + s.b.y) * half})) return "the tight segment " + text(s) + " is none";
  const auto box_p = bounds(p), box_q = bounds(q);
  Random random(seed);
  for (int i = 0; i < positions; ++i) {
    const auto pick = [&](double low, double high) {
      const double step = (high - low) / 1024;
      return from_double<N>(std::floor(low + step * static_cast<double>(random.below(1025)))) +
             N(random.below(5)) / N(7);
    };
    const Pt<N> c{pick(box_p[0] + box_q[0], box_p[2] + box_q[2]), pick(box_p[1] + box_q[1], box_p[3] + box_q[3])};
    int depth = 0;
    bool on_rim = false;
    for (const ExactRing<N>& ring : rings) {
      depth += inside_ring(ring, c) ? 1 : 0;
      for (std::size_t k = 0; k < ring.size(); ++k)
        on_rim = on_rim || on_segment(Seg<N>{ring[k], ring[(k + 1) % ring.size()]}, c);
    }
    if (on_rim) continue;
    if ((depth % 2 == 1) != member.meets(c)) return "membership of " + text(c) + " is wrong";
  }
  return "";
}

}  // namespace

std::string check_sum(const Region& p, const Region& q, Semantics semantics, const PlanarSum& sum) {
  const std::string wrong = on_either(
      [&](auto number) { return check_against(reference_sum<decltype(number)>(p.data(), q.data(), semantics), sum); });
  return wrong.empty() ? check_provenance(p, q, Combination::sum, sum) : wrong;
}

std::string check_nfp(const Region& a, const Region& b, const PlanarSum& sum) {
  const Region turned = negated(b);
  const std::string wrong = on_either([&](auto number) {
    return check_against(reference_sum<decltype(number)>(a.data(), turned.data(), Semantics::closed), sum);
  });
  return wrong.empty() ? check_provenance(a, b, Combination::difference, sum) : wrong;
}

std::string check_erode(const Region& p, const Region& q, const PlanarSum& sum) {
  const std::string wrong =
      on_either([&](auto number) { return check_against(reference_erode<decltype(number)>(p.data(), q.data()), sum); });
  return wrong.empty() ? check_provenance(p, q, Combination::erosion, sum) : wrong;
}

std::string check_boolean(const std::vector<RegionData>& inputs, const BooleanExpression& expression,
                          Semantics semantics, const PlanarSum& result) {
  return on_either([&](auto number) {
    return check_against(reference_boolean<decltype(number)>(inputs, expression, semantics), result);
  });
}

std::string spot_check_sum(const Region& p, const Region& q, const PlanarSum& sum, int positions, std::uint64_t seed) {
  const std::string wrong =
      on_either([&](auto number) { return spot_check<decltype(number)>(p, q, sum, positions, seed); });
  return wrong.empty() ? check_provenance(p, q, Combination::sum, sum) : wrong;
}

}  // namespace dymsum::oracles
