// The reduced convolution of operands of which vertices move, kept from step to step.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planar/convolution/convolution.h"
#include "planar/edit/walk_changes.h"

namespace dymsum::planar {

/// Edges of one operand in the order of their directions after `changed` ones got other directions; those that are not
/// in the list are left out. Cost: O(log n) for each, and the directions that it passes.
void sort_again(DirectionList& list, const OwnEdges& edges, const Operand& o, std::span<const std::uint32_t> changed);

class FollowedConvolution : public ReducedConvolution {
  const auto& ranges(std::uint32_t side) const { return turns_[side]; }

 public:
  FollowedConvolution(const Lattice& lattice, const Operand& p, const Operand& q);

  /// Whether follow() can be called: both operands are one component with area.
  bool can_follow() const;
  /// Follows operand `op`, of which vertices moved. What is filled is as it was, and the operands before and their
  /// lattice are still there. From then on ids of segments say nothing: find() reports only whether there is one.
  /// Cost: O(log n) for each edge that changed, and the directions that it passes.
  void follow(const Lattice& lattice, const Operand& p, const Operand& q, std::uint32_t op, const OperandMoves& moves);

  /// A number for each segment that grows as ids do. Requires: there is such a segment.
  std::uint64_t order(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const;

  /// Calls f(edge) for the edges that a vertex meets.
  template <class F>
  void for_each_edge_at(std::uint32_t side, std::uint32_t vertex, F&& f) const {
    for (std::uint32_t c = 0; c < columns_[side]; ++c) {
      const auto& t = ranges(side)[std::size_t{vertex} * columns_[side] + c];
      if (t.count == 0) continue;
      const auto& edges = lists_[t.list]->edges;
      for (std::uint32_t k = 0, at = t.lo; k < t.count; ++k, at = at + 1 == edges.size() ? 0 : at + 1) f(edges[at]);
    }
  }
  /// Calls f(vertex) for the vertices that meet an edge.
  template <class F>
  void for_each_vertex_at(std::uint32_t side, std::uint32_t edge, F&& f) const {
    const std::uint32_t columns = columns_[side], c = columns == 1 ? 0 : operands_[side]->component_of[edge];
    const auto n = static_cast<std::uint32_t>(operands_[1 - side]->size());
    for (std::uint32_t v = 0; v < n; ++v)
      if (id(ranges(side)[std::size_t{v} * columns + c], edge) != kNoRank) f(v);
  }

 private:
  void find_lists();
  void list_used(std::uint32_t side);
  std::uint32_t bound(std::uint32_t side, std::uint32_t list, std::uint32_t edge) const;
  bool meet_again(std::uint32_t side, std::uint32_t vertex);

  // Of one operand, in lists_: all its edges, those that outer loops of the other one meet, and those that holes meet.
  struct Lists {
    std::uint32_t whole = 0, outer = 0, hole = 0;
  };
  const Lattice* lattice_now_;
  std::array<Lists, 2> of_;
  std::array<std::vector<std::uint8_t>, 2> filled_loops_;
};

}  // namespace dymsum::planar
