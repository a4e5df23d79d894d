// Hashes of the lines of a pair's segments, which no scale changes: found once each, and kept from frame to frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "planar/scaling/exact_forms.h"

namespace dymsum::planar {

/// For every value the first index that it has in a list. Requires that the values asked for are in it.
class FirstIndices {
 public:
  /// Once: later calls change nothing.
  void fill(std::span<const std::uint32_t> values) {
    if (!index_.empty()) return;
    for (std::uint32_t k = 0; k < values.size(); ++k) {
      if (values[k] >= index_.size()) index_.resize(values[k] + std::size_t{1}, kNone);
      if (index_[values[k]] == kNone) index_[values[k]] = k;
    }
  }
  std::uint32_t operator[](std::uint32_t value) const { return index_[value]; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> index_;
};

/// Of one pair of operands.
struct LineHashes {
  std::array<FirstIndices, 2> edges, vertices;             ///< of the operands: indices in their walks
  std::unordered_map<std::uint64_t, std::uint64_t> lines;  ///< of contacts
};

/// See ScalingSum::combinatorial_hash.
std::uint64_t combinatorial_hash(const PlanarSum& sum, const OperandPair& base, const ExactForms& forms,
                                 LineHashes& known);

}  // namespace dymsum::planar
