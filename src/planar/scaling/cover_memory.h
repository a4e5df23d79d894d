// What windows before found out about crossings inside the sum: most pairs of segments that cross in one window cross
// in the next one too, and mostly the same edges cover them.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "planar/scaling/edge_search.h"

namespace dymsum::planar {

/// By pairs of segments, named by their ids in one convolution. What is remembered decides nothing: edges are asked
/// again whether they cross, and a crossing that is not known to be covered only costs.
class CoverMemory {
 public:
  struct Known {
    std::uint64_t pair = kFree;
    CrossingEdges edges{};    ///< that covered it, where `vain` is 0
    std::uint32_t vain = 0;   ///< how often it was asked about since a search in vain, counting that one
  };
  /// What is known of a pair; what is asked about for the first time is free to be filled in.
  Known& at(std::uint32_t a, std::uint32_t b) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    const std::uint64_t pair = a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
    Known& known = slots_[find(pair)];
    if (known.pair == kFree) {
      known.pair = pair;
      ++used_;
      known.vain = kNew;
    }
    return known;
  }
  static constexpr std::uint32_t kNew = 0xffffffff;  ///< in `vain`: nothing is known yet
  void clear() {
    slots_.clear();
    used_ = 0;
  }
  std::size_t bytes() const { return slots_.capacity() * sizeof(Known); }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static constexpr std::size_t kLeast = 1024, kMost = std::size_t{1} << 18;

  std::size_t find(std::uint64_t pair) const {
    std::size_t at = (pair * 0x9e3779b97f4a7c15u >> 20) & (slots_.size() - 1);
    while (slots_[at].pair != kFree && slots_[at].pair != pair) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  // Beyond kMost everything is forgotten: what windows far away knew serves nobody.
  void grow() {
    std::vector<Known> before(slots_.size() >= kMost ? kLeast : std::max(kLeast, 2 * slots_.size()));
    before.swap(slots_);
    used_ = 0;
    if (before.size() >= kMost) return;
    for (const Known& known : before)
      if (known.pair != kFree) {
        slots_[find(known.pair)] = known;
        ++used_;
      }
  }

  std::vector<Known> slots_;
  std::size_t used_ = 0;
};

}  // namespace dymsum::planar
