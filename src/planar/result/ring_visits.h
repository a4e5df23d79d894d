// The rings of a result as visits of positions, each with one sector of the set beside it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "planar/result/sum_skeleton.h"

namespace dymsum::planar {

/// The rings of a sum as chains of visits, of its vertices and of those that lie inside its edges: each visit has one
/// whole sector of the set on its left. Requires that the skeleton outlives this.
class RingVisits {
 public:
  struct Visit {
    std::uint32_t vertex = 0, edge = 0, chain = 0;  ///< of the skeleton; the edge that leaves, by its first vertex
    std::uint32_t next = 0, prev = 0;
  };

  explicit RingVisits(const SumSkeleton& skeleton);

  const std::vector<Visit>& visits() const { return visits_; }
  /// The visits of every position: those of one position, in the order of the rings.
  const std::map<std::uint32_t, std::vector<std::uint32_t>>& at() const { return at_; }

 private:
  void add(std::uint32_t e, std::uint32_t vertex);
  void join_sectors(std::uint32_t position, const std::vector<std::uint32_t>& here);

  const SumSkeleton& skeleton_;
  std::vector<Visit> visits_;
  std::uint32_t first_ = 0;                                 // visit of the ring
  std::map<std::uint32_t, std::vector<std::uint32_t>> at_;  // position -> visits
};

}  // namespace dymsum::planar
