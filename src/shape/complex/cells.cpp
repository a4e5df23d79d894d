#include "shape/complex/cells.h"

#include <algorithm>

namespace dymsum::shape {
namespace {

/// Direction `away` lies before the piece begins, counted from the first direction of the site's first section.
bool begins_past(Order& order, const CellPiece& piece, std::uint32_t other) {
  const Walks& walks = order.walks();
  for (const Section& s : sections_of(walks, piece.site)) {
    const Mark away = order.mark(s, {.kind = Mark::Kind::away, .i = other});
    const Mark start = order.mark(s, {.kind = Mark::Kind::start}), end = order.mark(s, {.kind = Mark::Kind::end});
    const bool inside = order.compare(s, start, away) <= 0 && order.compare(s, away, end) <= 0;
    if (s.axis == piece.section.axis) return inside && order.compare(s, away, piece.from) <= 0;
    if (inside) return true;  // in the section before the piece's
  }
  return false;
}

using Iterator = std::vector<std::uint32_t>::iterator;

/// Pieces of one site with one other site, so that those of a vertex begin after the direction away from the other.
/// The piece across the first direction begins last of all, though it is the first of its row.
void order_from_away(Order& order, const Cells& cells, Iterator first, Iterator last) {
  const CellPiece& piece = cells.pieces[*first];
  if (last - first < 2 || order.walks().is_edge(piece.site)) return;
  if (piece.wraps) std::rotate(first, first + 1, last);
  std::stable_partition(first, last, [&](std::uint32_t i) { return begins_past(order, cells.pieces[i], piece.other); });
}

}  // namespace

Cells join_cells(const Walks& walks, const std::vector<Section>& sections,
                 const std::vector<std::vector<Piece>>& rows) {
  Cells cells;
  std::vector<CellPiece>& out = cells.pieces;
  std::size_t i = 0;
  for (const SiteLoop& loop : walks.loops) {
    const std::size_t first = out.size();
    for (; i < sections.size() && sections[i].site < loop.last; ++i) {
      const Section& s = sections[i];
      for (const Piece& p : rows[i]) {
        const bool goes_on = out.size() > first && out.back().site == s.site && out.back().other == p.other;
        if (goes_on) {
          out.back().to_section = s;
          out.back().to = p.to;
        } else {
          out.push_back({.site = s.site, .other = p.other, .section = s, .to_section = s, .from = p.from, .to = p.to});
        }
      }
    }
    // Round an isolated point the last piece may be the beginning of the first.
    if (out.size() > first + 1 && out[first].site == out.back().site && out[first].other == out.back().other) {
      out[first].section = out.back().section;
      out[first].from = out.back().from;
      out[first].wraps = true;
      out.pop_back();
    }
    for (std::size_t k = first; k < out.size(); ++k) {
      out[k].prev = static_cast<std::uint32_t>(k == first ? out.size() - 1 : k - 1);
      out[k].next = static_cast<std::uint32_t>(k + 1 == out.size() ? first : k + 1);
    }
  }
  return cells;
}

bool match_cells(Order& order, Cells& cells) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < cells.pieces.size(); ++i) {
    if (cells.pieces[i].other != kNoIndex) list.push_back(i);
  }
  const auto pair_of = [&](std::uint32_t i) {
    const CellPiece& p = cells.pieces[i];
    return std::array<std::uint32_t, 3>{std::min(p.site, p.other), std::max(p.site, p.other), p.site};
  };
  std::stable_sort(list.begin(), list.end(), [&](std::uint32_t i, std::uint32_t j) { return pair_of(i) < pair_of(j); });
  for (auto first = list.begin(); first != list.end();) {
    const auto pair = pair_of(*first);
    auto midpoint = first, last = first;
    while (midpoint != list.end() && pair_of(*midpoint) == pair) ++midpoint;
    for (last = midpoint; last != list.end() && pair_of(*last)[0] == pair[0] && pair_of(*last)[1] == pair[1];) ++last;
    if (midpoint - first != last - midpoint) return false;
    order_from_away(order, cells, first, midpoint);
    order_from_away(order, cells, midpoint, last);
    const auto count = midpoint - first;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const std::uint32_t i = first[k], j = midpoint[count - 1 - k];
      cells.pieces[i].mate = j;
      cells.pieces[j].mate = i;
    }
    first = last;
  }
  return true;
}

}  // namespace dymsum::shape
