#include <algorithm>
#include <set>
#include <utility>

#include "dymsum/decomposition.h"

namespace dymsum {
namespace {

/// A vertex with its nearest doubles, which decide nearly all comparisons: rounding keeps the order of what it
/// distinguishes.
struct Corner {
  const RationalPoint* at = nullptr;
  double x = 0, y = 0;
};

bool before(const Corner& a, const Corner& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.at->x != b.at->x) return a.at->x < b.at->x;
  if (a.y != b.y) return a.y < b.y;
  return a.at->y < b.at->y;
}

/// An edge of a piece, whichever way the piece runs along it.
struct PieceEdge {
  Corner low, high;
  std::uint32_t piece = 0;
};

bool before(const PieceEdge& a, const PieceEdge& b) {
  if (before(a.low, b.low)) return true;
  return !before(b.low, a.low) && before(a.high, b.high);
}

void add_edges(const RationalRing& ring, std::uint32_t piece, std::vector<PieceEdge>& edges) {
  std::vector<Corner> corners;
  for (const RationalPoint& at : ring) corners.push_back({&at, at.x.to_double(), at.y.to_double()});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    PieceEdge edge{corners[i], corners[(i + 1) % corners.size()], piece};
    if (before(edge.high, edge.low)) std::swap(edge.low, edge.high);
    edges.push_back(edge);
  }
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const std::vector<Piece>& pieces) {
  std::vector<PieceEdge> edges;
  for (std::uint32_t piece = 0; piece < pieces.size(); ++piece) {
    add_edges(pieces[piece].outer, piece, edges);
    for (const RationalRing& hole : pieces[piece].holes) add_edges(hole, piece, edges);
  }
  std::sort(edges.begin(), edges.end(), [](const PieceEdge& a, const PieceEdge& b) { return before(a, b); });
  Neighbours made(pieces.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && !before(edges[begin], edges[end])) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = begin; j < end; ++j)
        if (edges[i].piece != edges[j].piece) made[edges[i].piece].push_back(edges[j].piece);
  }
  for (std::vector<std::uint32_t>& list : made) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return made;
}

/// Each piece has the fewest neighbours of all that stand no later; of several such pieces the one of the least index
/// stands last.
std::vector<std::uint32_t> smallest_last(const Neighbours& neighbours) {
  std::vector<std::size_t> degree;
  std::set<std::pair<std::size_t, std::uint32_t>> left;
  for (std::uint32_t piece = 0; piece < neighbours.size(); ++piece) {
    degree.push_back(neighbours[piece].size());
    left.insert({degree[piece], piece});
  }
  std::vector<std::uint32_t> order;
  while (!left.empty()) {
    const std::uint32_t piece = left.begin()->second;
    left.erase(left.begin());
    order.push_back(piece);
    for (const std::uint32_t other : neighbours[piece])
      if (left.erase({degree[other], other}) > 0) left.insert({--degree[other], other});
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

// Pieces are connected open sets that do not meet, so that the graph of those with a common edge is planar; and in
// every planar graph some vertex has at most five neighbours (Euler). In smallest-last order every piece has at most
// five neighbours that are coloured before it. (Matula, Beck 1983.)
std::vector<std::uint32_t> piece_colours(const Decomposition& decomposition) {
  const Neighbours neighbours = neighbours_of(decomposition.pieces);
  const auto none = std::uint32_t(neighbours.size());
  std::vector<std::uint32_t> colours(neighbours.size(), none);
  for (const std::uint32_t piece : smallest_last(neighbours)) {
    std::set<std::uint32_t> taken;
    for (const std::uint32_t other : neighbours[piece]) taken.insert(colours[other]);
    std::uint32_t colour = 0;
    while (taken.count(colour) > 0) ++colour;
    colours[piece] = colour;
  }
  return colours;
}

}  // namespace dymsum
