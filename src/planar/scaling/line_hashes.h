// Hashes of the lines of a pair's segments, which no scale changes: found once each, and kept from frame to frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace dymsum::planar {

/// For every number the first place that it has in a list. Requires that the numbers asked for are in it.
class FirstPlaces {
 public:
  /// Once: later calls change nothing.
  void fill(std::span<const std::uint32_t> numbers) {
    if (!place_.empty()) return;
    for (std::uint32_t k = 0; k < numbers.size(); ++k) {
      if (numbers[k] >= place_.size()) place_.resize(numbers[k] + std::size_t{1}, kNone);
      if (place_[numbers[k]] == kNone) place_[numbers[k]] = k;
    }
  }
  std::uint32_t operator[](std::uint32_t number) const { return place_[number]; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> place_;
};

/// Of one pair of operands.
struct LineHashes {
  std::array<FirstPlaces, 2> edges, vertices;              ///< of the operands: places in their walks
  std::unordered_map<std::uint64_t, std::uint64_t> lines;  ///< of contacts
};

}  // namespace dymsum::planar
