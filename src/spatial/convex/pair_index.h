// The index of the sum's vertex for each pair of vertices: a hash table with open addressing.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spatial/convex/vertex_pair.h"

namespace dymsum::spatial {

class PairIndex {
 public:
  /// The index of a pair; where it has none, it gets the one that fresh() gives. O(1) on average.
  template <class Fresh>
  std::uint32_t find_or_add(VertexPair pair, const Fresh& fresh) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::size_t at = home(pair);
    while (slots_[at].pair != kNoPair) {
      if (slots_[at].pair == pair) return slots_[at].index;
      at = (at + 1) & (slots_.size() - 1);
    }
    ++count_;
    slots_[at] = {pair, fresh()};
    return slots_[at].index;
  }
  /// Requires that the pair is there.
  void erase(VertexPair pair) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t hole = home(pair);
    while (slots_[hole].pair != pair) hole = (hole + 1) & mask;
    // What would no longer be found behind the hole moves into it.
    for (std::size_t at = (hole + 1) & mask; slots_[at].pair != kNoPair; at = (at + 1) & mask) {
      if (((at - home(slots_[at].pair)) & mask) < ((at - hole) & mask)) continue;
      slots_[hole] = slots_[at];
      hole = at;
    }
    slots_[hole].pair = kNoPair;
    --count_;
  }
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    VertexPair pair = kNoPair;
    std::uint32_t index = 0;
  };
  std::size_t home(VertexPair pair) const {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio: spreads runs of numbers
    const std::uint64_t key = (std::uint64_t{pair.p} << 32 | pair.q) * kGolden;
    return static_cast<std::size_t>((key ^ key >> 29) * kGolden >> (64 - std::countr_zero(slots_.size())));
  }
  void grow() {
    std::vector<Slot> before(slots_.empty() ? 64 : 2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before) {
      if (slot.pair == kNoPair) continue;
      std::size_t at = home(slot.pair);
      while (slots_[at].pair != kNoPair) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two
  std::size_t count_ = 0;
};

}  // namespace dymsum::spatial
