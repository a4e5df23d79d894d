// The candidates of every piece of a window.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory_budget.h"

namespace dymsum::planar {

struct CandidateIndex {
  base::CountedArray<std::uint32_t> first_of, of;  ///< those of piece i are of[first_of[i] .. first_of[i + 1])

  /// Candidates have pieces `a` and `b`.
  template <class Candidates>
  void index(const Candidates& candidates, std::size_t pieces) {
    first_of.assign(pieces + 1, 0);
    for (const auto& c : candidates) {
      ++first_of[c.a + 1];
      ++first_of[c.b + 1];
    }
    for (std::size_t i = 0; i < pieces; ++i) first_of[i + 1] += first_of[i];
    of.resize(first_of[pieces]);
    std::vector<std::uint32_t> fill(first_of.begin(), first_of.end() - 1);
    for (std::uint32_t c = 0; c < candidates.size(); ++c) {
      of[fill[candidates[c].a]++] = c;
      of[fill[candidates[c].b]++] = c;
    }
  }
};

}  // namespace dymsum::planar
