// Elements 0, 1, ... in classes that may be joined.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/scratch.h"

namespace dymsum::planar {

/// A class is named by its smallest element, in whatever order classes were joined.
class Partition {
 public:
  explicit Partition(std::size_t count = 0) : classes_(static_cast<std::uint32_t>(count)) {}
  std::size_t size() const { return classes_.size(); }
  /// A class of its own.
  std::uint32_t add() { return classes_.add(); }
  std::uint32_t find(std::uint32_t i) const { return classes_.root(i); }
  void join(std::uint32_t a, std::uint32_t b) {
    a = classes_.root(a);
    b = classes_.root(b);
    if (a != b) classes_.unite(std::max(a, b), std::min(a, b));
  }

 private:
  UnionFind classes_;
};

}  // namespace dymsum::planar
