#include "cspace/events/walked_rings.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "exact/orient.h"

namespace dymsum::planar {
namespace {

struct RingEdge {
  Point from, to;  // by x, then y
  bool of_line;
};

bool before(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

std::vector<RingEdge> sorted_edges(const Region& r) {
  std::vector<RingEdge> edges;
  const auto add = [&](Point a, Point b, bool of_line) {
    edges.push_back(before(a, b) ? RingEdge{a, b, of_line} : RingEdge{b, a, of_line});
  };
  const auto add_ring = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) add(ring[k], ring[(k + 1) % ring.size()], false);
  };
  for (const Part& part : r.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  for (const Polyline& line : r.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) add(line[k], line[k + 1], true);
  std::sort(edges.begin(), edges.end(), [](const RingEdge& a, const RingEdge& b) {
    return a.from != b.from ? before(a.from, b.from) : before(a.to, b.to);
  });
  return edges;
}

}  // namespace

// On one line, an edge that begins after another one's end has no interval of it.
std::optional<Point> overlapping_polylines(const Region& r) {
  if (r.polylines().empty()) return std::nullopt;
  const std::vector<RingEdge> edges = sorted_edges(r);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && before(edges[j].from, edges[i].to); ++j) {
      const RingEdge &e = edges[i], &f = edges[j];
      if (!e.of_line && !f.of_line) continue;
      if (exact::orient_sign(e.from, e.to, f.from) == 0 && exact::orient_sign(e.from, e.to, f.to) == 0) return f.from;
    }
  return std::nullopt;
}

namespace {

bool same_point(const Operand& o, std::uint32_t v, std::uint32_t w) {
  return o.points->input[o.source[v]] == o.points->input[o.source[w]];
}

// The walk edge that goes straight on where another one ends, perhaps of another visit of that vertex; none, or one, as
// edges do not overlap.
std::optional<std::uint32_t> straight_on(const TurningForms& forms, const WalkSegment& s) {
  const Operand& o = forms.operand(s.side);
  for (std::uint32_t e = 0; e < o.size(); ++e)
    if (same_point(o, e, o.next[s.edge]) && forms.parallel(s, {s.side, e, s.vertex})) {
      const Point d = forms.edge(s.side, s.edge), f = forms.edge(s.side, e);
      if (d.x * f.x + d.y * f.y > 0) return e;
    }
  return std::nullopt;
}

// Contacts name walk edges and walk vertices.
void index_by_walk(Operand& o) {
  std::iota(o.vertex_index.begin(), o.vertex_index.end(), 0u);
  std::iota(o.edge_index.begin(), o.edge_index.end(), 0u);
  o.vertex_of_index = o.source;
  o.edge_of_index.clear();
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    o.edge_of_index.push_back({o.source[i], o.source[o.next[i]]});
    o.indices[i] = {i, i, o.next[i]};
  }
}

// The walk along a polyline or a point that begins at vertex `from` of the region, at vertex `to` of the walked rings,
// and turns back at vertex `from + last`. Collinear vertices are left out of it.
void index_loop(Operand& o, const Loop& loop, std::uint32_t from, std::uint32_t to, std::uint32_t last) {
  bool back = false;
  for (std::uint32_t i = loop.first; i < loop.last; ++i) {
    const std::uint32_t k = o.vertex_index[i] - from;
    back |= k == last;
    const std::uint32_t index = to + (back ? 2 * last - k : k);
    o.vertex_index[i] = o.edge_index[i] = index;
    o.vertex_of_index[index] = o.source[i];
    o.edge_of_index[index] = {o.source[i], o.source[o.next[i]]};
  }
}

void index_there_and_back(Operand& o, const Region& region) {
  std::uint32_t from = static_cast<std::uint32_t>(region.vertex_count());
  for (const Polyline& line : region.polylines()) from -= static_cast<std::uint32_t>(line.size());
  from -= static_cast<std::uint32_t>(region.points().size());  // the parts keep their numbers
  std::uint32_t to = from;
  o.vertex_of_index.resize(walked_vertices(region));
  o.edge_of_index.resize(walked_vertices(region));
  auto loop = std::find_if(o.loops.begin(), o.loops.end(),
                           [](const Loop& l) { return l.kind == LoopKind::curve || l.kind == LoopKind::point; });
  for (const Polyline& line : region.polylines()) {
    const auto n = static_cast<std::uint32_t>(line.size());
    index_loop(o, *loop++, from, to, n - 1);
    from += n;
    to += 2 * (n - 1);
  }
  for (; loop != o.loops.end(); ++loop) index_loop(o, *loop, from++, to++, 0);
  for (std::uint32_t i = 0; i < o.size(); ++i)
    o.indices[i] = {o.vertex_index[i], o.edge_index[i], o.vertex_index[o.next[i]]};
}

}  // namespace

std::shared_ptr<const OperandPair> numbered_by_walk(const OperandPair& base) {
  auto same = std::make_shared<OperandPair>(base);
  for (Operand& o : same->operands) index_by_walk(o);
  return same;
}

std::shared_ptr<const OperandPair> numbered_there_and_back(const OperandPair& base,
                                                           const std::array<const Region*, 2>& regions) {
  auto same = std::make_shared<OperandPair>(base);
  for (const std::uint32_t op : {0u, 1u})
    if (has_thin_pieces(*regions[op])) index_there_and_back(same->operands[op], *regions[op]);
  return same;
}

// Segments that differ otherwise are one, of an edge with two visits of a vertex.
void append_run(WalkSegment first, const WalkSegment& last, const TurningForms& forms, std::vector<WalkSegment>& to) {
  to.push_back(first);
  if (first.side != last.side || first.vertex != last.vertex) return;
  for (WalkSegment s = first; s.edge != last.edge;) {
    const std::optional<std::uint32_t> next = straight_on(forms, s);
    if (!next) return;
    s.edge = *next;
    to.push_back(s);
  }
}

bool meet_at_ends(const TurningForms& forms, const WalkSegment& s, const WalkSegment& t) {
  const Pair a = forms.end(s), b = TurningForms::start(t);
  return a == b || (same_point(forms.operand(0), a.p, b.p) && same_point(forms.operand(1), a.q, b.q));
}

// An edge without cuts is one walk edge. One with cuts starts with the walk edge at the vertex of its number; its end
// is determined by the ring.
EdgeEnds::EdgeEnds(const Region& region, const Operand& operand)
    : starts_(operand.size(), true), ends_(operand.size(), true) {
  if (region.touching_points().empty()) return;
  std::vector<Point> end_of;
  for_each_ring(region, [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point end = ring[i + 1 == ring.size() ? 0 : i + 1];
      end_of.push_back(operand.reflected ? Point{0 - end.x, 0 - end.y} : end);
    }
  });
  for (std::uint32_t i = 0; i < operand.size(); ++i) {
    const std::uint32_t edge = operand.edge_index[i];
    starts_[i] = operand.vertex_index[i] == edge;
    ends_[i] = operand.points->input[operand.source[operand.next[i]]] == end_of[edge];
  }
}

}  // namespace dymsum::planar
