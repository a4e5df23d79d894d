// Numbers for keys: a hash table for the few keys of a small computation, without an allocation per key.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/scratch.h"

namespace dymsum {

/// Gives different keys the numbers 0, 1, ... in the order in which they come. Up to kLinear keys are looked for one
/// after the other.
class KeyIndices {
 public:
  static constexpr std::uint32_t kMissing = 0xffffffff;

  explicit KeyIndices(Scratch* memory) : keys_(memory), slots_(memory) {}

  /// The keys in the order of their indices.
  const Array<std::uint64_t>& keys() const { return keys_; }

  /// The number of a key, or kMissing.
  std::uint32_t find(std::uint64_t key) const { return slots_.empty() ? find_linear(key) : slots_[slot_of(key)]; }

  /// The number of a key, and whether it is new.
  std::pair<std::uint32_t, bool> add(std::uint64_t key) {
    if (const std::uint32_t known = find(key); known != kMissing) return {known, false};
    const std::uint32_t number = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    if (keys_.size() * 2 > slots_.size() && keys_.size() > kLinear) rehash();
    else if (!slots_.empty()) slots_[slot_of(key)] = number;
    return {number, true};
  }

 private:
  static constexpr std::size_t kLinear = 12;

  std::uint32_t find_linear(std::uint64_t key) const {
    for (std::size_t k = 0; k < keys_.size(); ++k)
      if (keys_[k] == key) return static_cast<std::uint32_t>(k);
    return kMissing;
  }
  // The slot of a key, or the free one where it belongs.
  std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::uint64_t hash = (key ^ (key >> 32)) * 0x9e3779b97f4a7c15;
    std::size_t at = static_cast<std::size_t>(hash >> 32) & mask;
    while (slots_[at] != kMissing && keys_[slots_[at]] != key) at = (at + 1) & mask;
    return at;
  }
  void rehash() {
    slots_.assign(std::bit_ceil(4 * keys_.size()), kMissing);
    for (std::size_t k = 0; k < keys_.size(); ++k) slots_[slot_of(keys_[k])] = static_cast<std::uint32_t>(k);
  }

  Array<std::uint64_t> keys_;
  Array<std::uint32_t> slots_;  // a power of two, at most half full; empty while few
};

}  // namespace dymsum
