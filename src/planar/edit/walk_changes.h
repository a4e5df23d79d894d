// What of an operand's walk an edit left as it was: the names by which everything that is kept is found again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Per vertex of an edited region: the vertex it was before, or kNone.
using VertexOrigins = std::vector<std::uint32_t>;

/// What became of the vertices of a region.
struct VertexChanges {
  VertexOrigins origins;                            ///< empty where `moved` is given
  std::optional<std::vector<std::uint32_t>> moved;  ///< every vertex is the one it was; these moved, in ascending order
};
/// The origins of the vertices of a region that has n.
VertexOrigins origins_of(const VertexChanges& changes, std::size_t n);

/// A vertex and where it is now, in the coordinates of the operand: reflected where that is.
struct MovedVertex {
  std::uint32_t vertex = 0;
  Point to;
};

/// What moves of an operand's vertices change.
struct OperandMoves {
  std::vector<MovedVertex> moved;             ///< vertices that are elsewhere, in ascending order
  std::vector<std::uint32_t> edges, corners;  ///< edges and vertices at these, and their neighbours: both ascending
  std::vector<std::uint8_t> convex;           ///< of `corners`, as they are after
};

/// The walk vertices and edges of an operand before and after an edit. A vertex stays when it is one vertex of the
/// region before and after, in the same position; an edge when its ends stay and follow one another before and after.
class WalkChanges {
 public:
  /// Nothing changed.
  WalkChanges() = default;
  /// Vertices moved, and nothing else. Requires: every vertex of the region is one of the walk, before and after.
  WalkChanges(const Operand& after, const OperandMoves& moves);
  /// Requires: regions whose rings do not touch, without polylines. O(n).
  WalkChanges(const Operand& before, const Operand& after, std::span<const std::uint32_t> origins);

  /// Walk vertex before -> after, or kNone.
  std::uint32_t after(std::uint32_t vertex) const {
    if (unchanged_) return vertex;
    if (only_moves_) return vertex_stays_[vertex] ? vertex : kNone;
    return after_[vertex];
  }
  std::uint32_t before(std::uint32_t vertex) const {
    if (unchanged_) return vertex;
    if (only_moves_) return vertex_stays_[vertex] ? vertex : kNone;
    return before_[vertex];
  }
  /// Of walk edges before: the edge after, or kNone.
  std::uint32_t edge_after(std::uint32_t edge) const {
    if (unchanged_) return edge;
    const std::uint32_t to = only_moves_ ? edge : after_[edge];
    return to != kNone && edge_stays_[to] ? to : kNone;
  }
  /// Whether a walk edge after the edit was there before.
  bool edge_stays(std::uint32_t edge) const { return unchanged_ || edge_stays_[edge]; }
  /// Whether a walk vertex after the edit has both edges that it had before: it meets the same edges of the other
  /// operand.
  bool corner_stays(std::uint32_t vertex) const { return unchanged_ || corner_stays_[vertex]; }

  bool unchanged() const { return unchanged_; }
  /// Whether vertices moved, and nothing else.
  bool only_moves() const { return unchanged_ || only_moves_; }
  /// Whether what stays has other indices.
  bool renumbered() const { return renumbered_; }
  /// Calls f for walk edges before, of which there were so many, that are gone.
  template <class F>
  void for_each_gone_edge(std::size_t size, F&& f) const {
    if (only_moves()) {
      for (const std::uint32_t e : new_edges_) f(e);
      return;
    }
    for (std::uint32_t e = 0; e < size; ++e)
      if (edge_after(e) == kNone) f(e);
  }
  /// Walk edges after the edit that were not there before, and vertices that do not meet the same edges.
  const std::vector<std::uint32_t>& new_edges() const { return new_edges_; }
  const std::vector<std::uint32_t>& new_corners() const { return new_corners_; }
  /// Region vertex before -> after.
  std::uint32_t vertex_index(std::uint32_t index) const {
    return only_moves() || index >= index_after_.size() ? index : index_after_[index];
  }

  /// Takes all vertices and edges of a loop of the operand after the edit for new.
  void renew(const Loop& loop);

 private:
  void compare_edges(const Operand& before, const Operand& after);

  bool unchanged_ = true, only_moves_ = false, renumbered_ = false;
  std::vector<std::uint32_t> after_, before_, index_after_, new_edges_, new_corners_;
  std::vector<std::uint8_t> vertex_stays_, edge_stays_, corner_stays_;  // the first of moves only
};

}  // namespace dymsum::planar
