// What windows before found out about crossings inside the sum: the edges that covered one crossing of a segment often
// cover the next one, in this window or a later one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "planar/scaling/edge_search.h"

namespace dymsum::planar {

/// By segments, named by their ids in one convolution. What is remembered decides nothing: edges are asked again
/// whether they cross.
class CoverMemory {
 public:
  /// Of a convolution with so many segments.
  explicit CoverMemory(std::uint32_t segments) : of_(segments) {}
  std::size_t bytes() const { return of_.capacity() * sizeof(Covers); }

  /// Whether edges that are remembered for one of two segments cross at both places.
  bool covers(std::uint32_t a, std::uint32_t b, const EdgeSearch& search, const EdgeSearch::Place& from,
              const EdgeSearch::Place& to) {
    for (std::size_t k = 0; k < 2; ++k)
      for (const std::uint32_t segment : {a, b}) {
        Covers& known = of_[segment];
        if (known[k][0] == kNone || !search.cross(known[k], from, to)) continue;
        if (k > 0) std::swap(known[0], known[1]);
        return true;
      }
    return false;
  }
  void remember(std::uint32_t segment, const CrossingEdges& edges) { of_[segment] = {edges, of_[segment][0]}; }

 private:
  struct Covers : std::array<CrossingEdges, 2> {  // the last one first
    Covers() : array{CrossingEdges{kNone, kNone}, CrossingEdges{kNone, kNone}} {}
    Covers(const CrossingEdges& last, const CrossingEdges& before) : array{last, before} {}
  };
  base::CountedArray<Covers> of_;
};

}  // namespace dymsum::planar
