#include "reference_sum.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace dymsum::oracles {
namespace {

template <class N>
bool fit_in_box(const Seg<N>& s, const Seg<N>& t) {  // s.a < s.b and t.a < t.b: x is sorted
  if (s.b.x < t.a.x || t.b.x < s.a.x) return false;
  const N &s_low = std::min(s.a.y, s.b.y), &s_high = std::max(s.a.y, s.b.y);
  const N &t_low = std::min(t.a.y, t.b.y), &t_high = std::max(t.a.y, t.b.y);
  return !(s_high < t_low || t_high < s_low);
}

template <class N>
void sort_unique(std::vector<N>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// All segments edge + vertex and all points vertex + vertex of two operands.
template <class N>
struct Lines {
  std::vector<Seg<N>> segments;
  std::vector<Pt<N>> dots;
};

template <class N>
Lines<N> all_contacts(const Pieces<N>& p, const Pieces<N>& q) {
  Lines<N> out;
  const auto add = [&](const std::vector<Seg<N>>& edges, const Pieces<N>& other) {
    for (const Seg<N>& e : edges)
      for (const auto* corners : {&other.corners, &other.dots})
        for (const Pt<N>& c : *corners) {
          Seg<N> s{e.a + c, e.b + c};
          if (s.b < s.a) std::swap(s.a, s.b);
          out.segments.push_back(s);
        }
  };
  add(p.rim, q);
  add(p.lines, q);
  add(q.rim, p);
  add(q.lines, p);
  for (const Pt<N>& a : p.dots)
    for (const Pt<N>& b : q.dots) out.dots.push_back(a + b);
  sort_unique(out.segments);
  sort_unique(out.dots);
  return out;
}

template <class N>
Pieces<N> reflected(Pieces<N> region) {
  const auto flip = [](Pt<N>& c) { c = {-c.x, -c.y}; };
  for (auto* edges : {&region.rim, &region.lines})
    for (Seg<N>& s : *edges) flip(s.a), flip(s.b);
  for (auto* corners : {&region.corners, &region.dots})
    for (Pt<N>& c : *corners) flip(c);
  return region;
}

/// Vertices and edges of the arrangement; edges as pairs of vertex indices, the smaller first.
template <class N>
struct Arrangement {
  Lines<N> lines;
  std::vector<Pt<N>> stops;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
};

template <class N>
void add_crossing(const Seg<N>& s, const Seg<N>& t, std::vector<Pt<N>>& on_s, std::vector<Pt<N>>& on_t) {
  const Pt<N> d = s.b - s.a, e = t.b - t.a;
  const N det = cross(d, e);
  if (det == N(0)) {
    for (const Pt<N>& c : {t.a, t.b})
      if (on_segment(s, c)) on_s.push_back(c);
    for (const Pt<N>& c : {s.a, s.b})
      if (on_segment(t, c)) on_t.push_back(c);
    return;
  }
  if (turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) > 0 || turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) > 0) return;
  const N at = cross(t.a - s.a, e) / det;
  const Pt<N> c{s.a.x + d.x * at, s.a.y + d.y * at};
  on_s.push_back(c);
  on_t.push_back(c);
}

template <class N>
Arrangement<N> arrange(Lines<N> lines) {
  Arrangement<N> out;
  std::vector<std::vector<Pt<N>>> on(lines.segments.size());
  for (std::size_t i = 0; i < on.size(); ++i) {
    const Seg<N>& s = lines.segments[i];
    on[i].push_back(s.a);
    on[i].push_back(s.b);
    for (std::size_t j = 0; j < i; ++j)
      if (fit_in_box(s, lines.segments[j])) add_crossing(s, lines.segments[j], on[i], on[j]);
    for (const Pt<N>& c : lines.dots)
      if (on_segment(s, c)) on[i].push_back(c);
  }
  out.stops = lines.dots;
  for (auto& list : on) {
    sort_unique(list);
    out.stops.insert(out.stops.end(), list.begin(), list.end());
  }
  sort_unique(out.stops);
  const auto number = [&](const Pt<N>& c) {
    return static_cast<std::size_t>(std::lower_bound(out.stops.begin(), out.stops.end(), c) - out.stops.begin());
  };
  for (const auto& list : on)
    for (std::size_t k = 0; k + 1 < list.size(); ++k) out.edges.emplace_back(number(list[k]), number(list[k + 1]));
  sort_unique(out.edges);
  out.lines = std::move(lines);
  return out;
}

template <class N>
Pt<N> midpoint(const Pt<N>& a, const Pt<N>& b) {
  const N half = N(1) / N(2);
  return {(a.x + b.x) * half, (a.y + b.y) * half};
}

/// A position in the open face next to m, looking from m along the y axis (or the x axis) towards `sign`: half way to
/// the nearest segment.
template <class N>
Pt<N> beside(const Arrangement<N>& a, const Pt<N>& m, bool along_y, int sign) {
  const N& here = along_y ? m.x : m.y;
  const N& start = along_y ? m.y : m.x;
  bool found = false;
  N nearest(0);
  const auto offer = [&](const N& at) {
    if (sign > 0 ? !(at > start) : !(at < start)) return;
    if (!found || (sign > 0 ? at < nearest : at > nearest)) nearest = at;
    found = true;
  };
  for (const Seg<N>& s : a.lines.segments) {
    const N &u0 = along_y ? s.a.x : s.a.y, &u1 = along_y ? s.b.x : s.b.y;
    const N &v0 = along_y ? s.a.y : s.a.x, &v1 = along_y ? s.b.y : s.b.x;
    if ((u0 < here && u1 < here) || (u0 > here && u1 > here)) continue;
    if (u0 == u1) {
      offer(v0);
      offer(v1);
    } else {
      offer(v0 + (v1 - v0) * ((here - u0) / (u1 - u0)));
    }
  }
  for (const Pt<N>& c : a.lines.dots)
    if ((along_y ? c.x : c.y) == here) offer(along_y ? c.y : c.x);
  const N at = found ? (start + nearest) / N(2) : start + N(sign);
  return along_y ? Pt<N>{m.x, at} : Pt<N>{at, m.y};
}

/// Joins collinear segments that follow each other.
template <class N>
std::vector<Seg<N>> maximal(std::vector<Seg<N>> pieces) {
  std::sort(pieces.begin(), pieces.end());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < pieces.size() && !changed; ++i)
      for (std::size_t j = 0; j < pieces.size() && !changed; ++j)
        if (pieces[i].b == pieces[j].a && turn(pieces[i].a, pieces[i].b, pieces[j].b) == 0) {
          pieces[i].b = pieces[j].b;
          pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
          changed = true;
        }
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

/// What is queried the set: membership of the closed set, and of an open set inside it whose points are not
/// interesting.
template <class N>
struct Questions {
  std::function<bool(const Pt<N>&)> in_set;
  std::function<bool(const Pt<N>&)> in_open;  ///< faces of the set are exactly the faces in here, unless has_thin_faces
  bool has_thin_faces = false;
};

/// Edges by what is on their two sides.
enum class EdgeKind { off, deep, rim_forward, rim_backward, crack, thin };

template <class N>
EdgeKind classify(const Arrangement<N>& a, const Questions<N>& query, const Pt<N>& from, const Pt<N>& to,
                  std::size_t& queried) {
  const Pt<N> m = midpoint(from, to);
  queried += 2;
  if (!query.in_set(m)) {
    if (query.in_open(m)) throw std::logic_error("the open set is not inside the closed one");
    return EdgeKind::off;
  }
  if (query.in_open(m)) return EdgeKind::deep;
  const bool along_y = from.x != to.x;  // then the left of from -> to is up; otherwise from is below and left is left
  const Pt<N> left_position = beside(a, m, along_y, along_y ? 1 : -1),
              right_position = beside(a, m, along_y, along_y ? -1 : 1);
  const bool left = query.in_set(left_position), right = query.in_set(right_position);
  queried += 2;
  if (!query.has_thin_faces && (query.in_open(left_position) != left || query.in_open(right_position) != right))
    throw std::logic_error("a face lies in the closed set and not in the open one");
  if (left && right) return EdgeKind::crack;
  if (left) return EdgeKind::rim_forward;
  return right ? EdgeKind::rim_backward : EdgeKind::thin;
}

template <class N>
ReferenceSum<N> classify_all(Arrangement<N> a, const Questions<N>& query) {
  ReferenceSum<N> out;
  struct Around {
    bool any = false, all_deep = true, all_off = true;
  };
  std::vector<Around> around(a.stops.size());
  for (const auto& [from, to] : a.edges) {
    const Pt<N>&u = a.stops[from], &v = a.stops[to];
    const EdgeKind kind = classify(a, query, u, v, out.cells_queried);
    if (kind == EdgeKind::rim_forward) out.rim.push_back({u, v});
    if (kind == EdgeKind::rim_backward) out.rim.push_back({v, u});
    if (kind == EdgeKind::crack) out.tight_segments.push_back({u, v});
    if (kind == EdgeKind::thin) out.segments.push_back({u, v});
    for (const std::size_t end : {from, to}) {
      around[end].any = true;
      around[end].all_deep = around[end].all_deep && kind == EdgeKind::deep;
      around[end].all_off = around[end].all_off && kind == EdgeKind::off;
    }
  }
  for (std::size_t i = 0; i < a.stops.size(); ++i) {
    const Pt<N>& c = a.stops[i];
    ++out.cells_queried;
    const bool in_set = query.in_set(c);
    if (!in_set && around[i].any && !around[i].all_off) throw std::logic_error("the closed set is not closed");
    if (!in_set || query.in_open(c)) continue;
    if (!around[i].any) {
      (query.in_set(beside(a, c, true, 1)) ? out.tight_points : out.points).push_back(c);
    } else if (around[i].all_deep) {
      out.tight_points.push_back(c);
    } else if (around[i].all_off) {
      out.points.push_back(c);
    }
  }
  std::sort(out.rim.begin(), out.rim.end());
  out.segments = maximal(std::move(out.segments));
  out.tight_segments = maximal(std::move(out.tight_segments));
  out.stops = std::move(a.stops);
  return out;
}

}  // namespace

bool has_thin_pair(const RegionData& p, const RegionData& q) {
  return (!p.polylines.empty() || !p.points.empty()) && (!q.polylines.empty() || !q.points.empty());
}

template <class N>
ReferenceSum<N> reference_sum(const RegionData& p, const RegionData& q, Semantics semantics) {
  const Membership<N> member(p, q);
  const bool thin_pairs = semantics != Semantics::open && has_thin_pair(p, q);
  Questions<N> query;
  if (thin_pairs) {
    query.in_set = [&](const Pt<N>& z) { return member.meets(z); };
  } else {
    query.in_set = [&](const Pt<N>& z) { return member.meets_with_area(z); };
  }
  query.in_open = [&](const Pt<N>& z) { return member.overlaps(z); };
  query.has_thin_faces = thin_pairs;
  ReferenceSum<N> out = classify_all(arrange(all_contacts(pieces_of<N>(p), pieces_of<N>(q))), query);
  if (semantics == Semantics::regular || thin_pairs) {
    out.tight_segments.clear();
    out.tight_points.clear();
  }
  if (semantics == Semantics::regular) {
    out.segments.clear();
    out.points.clear();
  }
  return out;
}

template <class N>
ReferenceSum<N> reference_erode(const RegionData& p, const RegionData& q) {
  const Membership<N> member(p, q);
  Questions<N> query;
  query.in_set = [&](const Pt<N>& x) { return member.holds(x); };
  query.in_open = [](const Pt<N>&) { return false; };
  query.has_thin_faces = true;
  ReferenceSum<N> out = classify_all(arrange(all_contacts(pieces_of<N>(p), reflected(pieces_of<N>(q)))), query);
  out.tight_segments = out.segments;  // cracks here are edges inside the closed set: nothing
  out.tight_points = out.points;
  return out;
}

template <class N>
ReferenceSum<N> reference_boolean(const std::vector<RegionData>& inputs, const BooleanExpression& expression,
                                  Semantics semantics) {
  const RegionData origin{{}, {}, {Point{0, 0}}};
  std::vector<Membership<N>> members;
  Lines<N> lines;
  for (const RegionData& input : inputs) {
    members.emplace_back(input, origin);
    const Lines<N> of = all_contacts(pieces_of<N>(input), pieces_of<N>(origin));
    lines.segments.insert(lines.segments.end(), of.segments.begin(), of.segments.end());
    lines.dots.insert(lines.dots.end(), of.dots.begin(), of.dots.end());
  }
  sort_unique(lines.segments);
  sort_unique(lines.dots);
  const auto at = [&](const Pt<N>& z) {
    std::vector<ClosedAndOpen> lies;
    for (const Membership<N>& member : members) lies.push_back({member.meets(z), member.overlaps(z)});
    return expression(lies);
  };
  Questions<N> query;
  query.in_set = [&](const Pt<N>& z) { return at(z).closed; };
  query.in_open = [&](const Pt<N>& z) { return at(z).open; };
  ReferenceSum<N> out = classify_all(arrange(std::move(lines)), query);
  out.tight_segments.insert(out.tight_segments.end(), out.segments.begin(), out.segments.end());
  out.tight_segments = maximal(std::move(out.tight_segments));
  out.tight_points.insert(out.tight_points.end(), out.points.begin(), out.points.end());
  std::sort(out.tight_points.begin(), out.tight_points.end());
  if (semantics != Semantics::closed) out.segments.clear(), out.points.clear();
  if (semantics == Semantics::regular) out.tight_segments.clear(), out.tight_points.clear();
  return out;
}

template struct ReferenceSum<Small>;
template struct ReferenceSum<Big>;
template ReferenceSum<Small> reference_sum<Small>(const RegionData&, const RegionData&, Semantics);
template ReferenceSum<Big> reference_sum<Big>(const RegionData&, const RegionData&, Semantics);
template ReferenceSum<Small> reference_erode<Small>(const RegionData&, const RegionData&);
template ReferenceSum<Big> reference_erode<Big>(const RegionData&, const RegionData&);
template ReferenceSum<Small> reference_boolean<Small>(const std::vector<RegionData>&, const BooleanExpression&,
                                                      Semantics);
template ReferenceSum<Big> reference_boolean<Big>(const std::vector<RegionData>&, const BooleanExpression&, Semantics);

}  // namespace dymsum::oracles
