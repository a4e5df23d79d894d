// Classes of elements that are made one by one.
#pragma once

#include <cstdint>

#include "base/scratch.h"

namespace dymsum {

/// Elements 0, 1, ..., each in a class of its own until unite() joins two. Amortized O(log n) each (paths are halved).
class UnionFind {
 public:
  explicit UnionFind(std::uint32_t size = 0, Scratch* memory = nullptr) : parent_(memory) {
    parent_.reserve(size);
    while (parent_.size() < size) add();
  }

  /// One more element.
  std::uint32_t add() {
    const auto element = static_cast<std::uint32_t>(parent_.size());
    parent_.push_back(element);
    return element;
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }
  /// The element that stands for the class of i.
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::uint32_t root(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  bool same(std::uint32_t i, std::uint32_t j) { return root(i) == root(j); }
  /// Joins two classes; the root of j's stands for both.
  void unite(std::uint32_t i, std::uint32_t j) { parent_[root(i)] = root(j); }

 private:
  Array<std::uint32_t> parent_;
};

}  // namespace dymsum
