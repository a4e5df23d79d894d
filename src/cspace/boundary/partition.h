// Elements 0, 1, ... in classes that may be joined.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dymsum::planar {

/// A class is named by its smallest element, in whatever order classes were joined.
class Partition {
 public:
  explicit Partition(std::size_t count = 0) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::size_t size() const { return parent_.size(); }
  /// A class of its own.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = shorten(a);
    b = shorten(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::uint32_t shorten(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
};

}  // namespace dymsum::planar
