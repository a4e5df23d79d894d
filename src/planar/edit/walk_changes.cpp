#include "planar/edit/walk_changes.h"

#include <numeric>

namespace dymsum::planar {

VertexOrigins origins_of(const VertexChanges& changes, std::size_t n) {
  if (!changes.moved) return changes.origins;
  VertexOrigins origins(n);
  std::iota(origins.begin(), origins.end(), 0u);
  return origins;
}

WalkChanges::WalkChanges(const Operand& after, const OperandMoves& moves)
    : unchanged_(false),
      only_moves_(true),
      new_edges_(moves.edges),
      new_corners_(moves.corners),
      vertex_stays_(after.size(), 1),
      edge_stays_(after.size(), 1),
      corner_stays_(after.size(), 1) {
  for (const MovedVertex& m : moves.moved) vertex_stays_[m.vertex] = 0;
  for (const std::uint32_t e : moves.edges) edge_stays_[e] = 0;
  for (const std::uint32_t v : moves.corners) corner_stays_[v] = 0;
}

WalkChanges::WalkChanges(const Operand& before, const Operand& after, std::span<const std::uint32_t> origins)
    : unchanged_(false) {
  after_.assign(before.size(), kNone);
  before_.assign(after.size(), kNone);
  std::vector<std::uint32_t> walk_of(before.vertex_of_index.size(), kNone);
  for (std::uint32_t w = 0; w < before.size(); ++w) walk_of[before.vertex_index[w]] = w;
  index_after_.assign(before.vertex_of_index.size(), kNone);
  for (std::uint32_t v = 0; v < origins.size(); ++v)
    if (origins[v] != kNone) index_after_[origins[v]] = v;
  for (const Loop& loop : after.loops)
    for (std::uint32_t w = loop.first; w < loop.last; ++w) {
      const std::uint32_t v = after.vertex_index[w], was = origins[v] == kNone ? kNone : walk_of[origins[v]];
      if (was == kNone || before.points->input[before.source[was]] != after.points->input[after.source[w]]) continue;
      before_[w] = was;
      after_[was] = w;
      renumbered_ |= was != w;
    }
  for (std::uint32_t v = 0; v < origins.size(); ++v) renumbered_ |= origins[v] != v;
  renumbered_ |= before.size() != after.size() || index_after_.size() != origins.size();
  compare_edges(before, after);
}

void WalkChanges::compare_edges(const Operand& before, const Operand& after) {
  new_edges_.clear();
  new_corners_.clear();
  edge_stays_.assign(after.size(), 0);
  corner_stays_.assign(after.size(), 0);
  for (std::uint32_t w = 0; w < after.size(); ++w) {
    const std::uint32_t from = before_[w], to = before_[after.next[w]];
    edge_stays_[w] = from != kNone && to != kNone && before.next[from] == to;
    if (!edge_stays_[w]) new_edges_.push_back(w);
  }
  for (std::uint32_t w = 0; w < after.size(); ++w) {
    corner_stays_[w] = edge_stays_[w] && edge_stays_[after.prev[w]];
    if (!corner_stays_[w]) new_corners_.push_back(w);
  }
}

void WalkChanges::renew(const Loop& loop) {
  for (std::uint32_t w = loop.first; w < loop.last; ++w) {
    if (edge_stays_[w]) new_edges_.push_back(w);
    if (corner_stays_[w]) new_corners_.push_back(w);
    edge_stays_[w] = corner_stays_[w] = 0;
    if (only_moves_) {
      vertex_stays_[w] = 0;
      continue;
    }
    if (before_[w] != kNone) after_[before_[w]] = kNone;
    before_[w] = kNone;
  }
}

}  // namespace dymsum::planar
