// The reduced convolution of operands of which vertices move, kept from step to step.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
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
  /// Calls f(edge, vertex) for the vertices that meet some edges of `side`. O(m log k) for k edges and m vertices, and
  /// the calls.
  template <class F>
  void for_each_at_edges(std::uint32_t side, std::span<const std::uint32_t> edges, F&& f) const {
    std::uint32_t list = kNone;
    std::vector<std::uint32_t> ranks;  // of the edges in that list
    for (const std::uint32_t row : used_[side]) {
      const auto& t = ranges(side)[row];
      if (std::exchange(list, t.list) != t.list) ranks = ranks_in(t.list, edges);
      const auto n = static_cast<std::uint32_t>(lists_[list]->edges.size());
      const auto within = [&](std::uint32_t low, std::uint32_t high) {
        for (auto at = std::lower_bound(ranks.begin(), ranks.end(), low); at != ranks.end() && *at < high; ++at)
          f(lists_[list]->edges[*at], vertex_of(side, row));
      };
      within(t.lo, std::min(n, t.lo + t.count));
      if (t.lo + t.count > n) within(0, t.lo + t.count - n);
    }
  }

 private:
  void find_lists();
  std::vector<std::uint32_t> ranks_in(std::uint32_t list, std::span<const std::uint32_t> edges) const;
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
