#include "shape/decompose/passages.h"

#include <algorithm>
#include <optional>

#include "exact/orient.h"

namespace dymsum::shape {
namespace {

Rational passage_cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether a cut through v goes on inside the region.
bool enters_at(const RingTable& table, std::uint32_t v, const Wall& cut) {
  const Point at = table.at[v], next = table.at[table.next[v]], previous = table.at[table.previous[v]];
  const bool right_of_previous = side_of_end(at, previous, cut)<0, left_of_next = side_of_end(at, next, cut)> 0;
  return exact::orient_sign(previous, at, next) > 0 ? left_of_next && right_of_previous
                                                    : left_of_next || right_of_previous;
}

/// The passage at the first end of an edge, where that lies on the cut.
std::optional<Passage> at_vertex(const RingTable& table, const Wall& edge, const Wall& cut) {
  if (side_of(cut, edge.a) != 0) return std::nullopt;
  const RationalPoint from = cut.from(), to = cut.end(), at = edge.from();
  const Rational dx = to.x - from.x, dy = to.y - from.y;
  const Rational t = ((at.x - from.x) * dx + (at.y - from.y) * dy) / (dx * dx + dy * dy);
  if (t.sign() < 0 || t > Rational(1)) return std::nullopt;
  return Passage{true, edge.index, Rational(0), t, at, enters_at(table, edge.index, cut)};
}

/// The passage where the cut crosses an edge between its ends.
std::optional<Passage> inside_edge(const Wall& edge, const Wall& cut) {
  if (side_of(cut, edge.a) * side_of(cut, edge.b) >= 0) return std::nullopt;
  const int side = side_of_end(edge.a, edge.b, cut);
  if (exact::orient_sign(edge.a, edge.b, cut.a) * side >= 0) return std::nullopt;
  const RationalPoint a = edge.from(), b = edge.end(), from = cut.from(), to = cut.end();
  const Rational s = passage_cross(a, b, from), t = s / (s - passage_cross(a, b, to));
  const Rational u = passage_cross(from, to, a);
  return Passage{false,
                 edge.index,
                 u / (u - passage_cross(from, to, b)),
                 t,
                 {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)},
                 side > 0};
}

}  // namespace

std::vector<Passage> passages(const RingTable& table, const WallSet& walls, const Wall& cut,
                              const std::vector<bool>& stands) {
  std::vector<Passage> over;
  walls.edges_meeting(cut.box, [&](std::uint32_t e) {
    const Wall& edge = walls[e];
    if (stands[edge.ring] || table.part[edge.ring] != table.part[cut.ring]) return;
    if (std::optional<Passage> passage = at_vertex(table, edge, cut)) over.push_back(*std::move(passage));
    if (std::optional<Passage> passage = inside_edge(edge, cut)) over.push_back(*std::move(passage));
  });
  std::sort(over.begin(), over.end(), [](const Passage& a, const Passage& b) {
    return a.on_cut != b.on_cut ? a.on_cut < b.on_cut : a.index < b.index;
  });
  return over;
}

std::vector<RationalSegment> runs_of(const Cut& cut, const std::vector<Passage>& over) {
  std::vector<RationalSegment> runs;
  RationalPoint from = cut.from;
  bool inside = true;
  for (const Passage& p : over) {
    if (inside && !p.enters) runs.push_back({from, p.at});
    if (!inside && p.enters) from = p.at;
    inside = p.enters;
  }
  if (inside) runs.push_back({from, cut.to});
  return runs;
}

}  // namespace dymsum::shape
