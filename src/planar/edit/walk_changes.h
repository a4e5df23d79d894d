// What of an operand's walk an edit left as it was: the names by which everything that is kept is found again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Per vertex of an edited region: the vertex it was before, or kNone.
using VertexOrigins = std::vector<std::uint32_t>;

/// The walk vertices and edges of an operand before and after an edit. A vertex stays when it is one vertex of the
/// region before and after, in the same position; an edge when its ends stay and follow one another before and after.
class WalkChanges {
 public:
  WalkChanges() = default;
  /// Nothing changed.
  explicit WalkChanges(const Operand& o);
  /// Requires: regions whose rings do not touch, without polylines. O(n).
  WalkChanges(const Operand& before, const Operand& after, std::span<const std::uint32_t> origins);

  /// Walk vertex before -> after, or kNone.
  std::uint32_t after(std::uint32_t vertex) const { return unchanged_ ? vertex : after_[vertex]; }
  std::uint32_t before(std::uint32_t vertex) const { return unchanged_ ? vertex : before_[vertex]; }
  /// Of walk edges before: the edge after, or kNone.
  std::uint32_t edge_after(std::uint32_t edge) const {
    if (unchanged_) return edge;
    const std::uint32_t to = after_[edge];
    return to != kNone && edge_stays_[to] ? to : kNone;
  }
  /// Whether a walk edge after the edit was there before.
  bool edge_stays(std::uint32_t edge) const { return unchanged_ || edge_stays_[edge]; }
  /// Whether a walk vertex after the edit has both edges that it had before: it meets the same edges of the other
  /// operand.
  bool corner_stays(std::uint32_t vertex) const { return unchanged_ || corner_stays_[vertex]; }

  bool unchanged() const { return unchanged_; }
  /// Whether what stays has other indices.
  bool renumbered() const { return renumbered_; }
  /// Walk edges after the edit that were not there before, and vertices that do not meet the same edges.
  const std::vector<std::uint32_t>& new_edges() const { return new_edges_; }
  const std::vector<std::uint32_t>& turned() const { return turned_; }
  /// Region vertex before -> after.
  std::uint32_t vertex_index(std::uint32_t index) const {
    return unchanged_ || index >= index_after_.size() ? index : index_after_[index];
  }

  /// Takes all vertices and edges of a loop of the operand after the edit for new.
  void renew(const Operand& after, const Loop& loop);

 private:
  void compare_edges(const Operand& before, const Operand& after);

  bool unchanged_ = true, renumbered_ = false;
  std::vector<std::uint32_t> after_, before_, index_after_, new_edges_, turned_;
  std::vector<std::uint8_t> edge_stays_, corner_stays_;
};

}  // namespace dymsum::planar
