// Memory for the arrays of one computation: small ones lie in a buffer on the stack, large ones in blocks that the
// next computation of the same thread uses again. Fresh pages cost more than the arithmetic of a middling sum. And
// tables in it: indices by keys, and indices that are united.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "base/memory_budget.h"

namespace dymsum {

/// Not thread-safe; at most 16 MB of blocks outlive it, until the thread ends. Its blocks count with the budget that is
/// the current one when it is made (memory_budget.h).
class Scratch {
 public:
  Scratch() : budget_(base::current_budget()) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// The most bytes that were handed out at one time.
  std::size_t peak_bytes() const { return peak_; }

  /// Aligned for every plain type. Inline: a small sum has some forty arrays, and calls cost as much as filling them.
  void* take(std::size_t bytes) {
    held_ += bytes;
    if (held_ > peak_) peak_ = held_;
    const std::size_t room = rounded(bytes);
    if (bytes > kSmall || used_ + room > kBuffer) [[unlikely]]
      return take_block(bytes);
    void* const at = buffer_ + used_;
    used_ += room;
    return at;
  }
  void give(void* pointer, std::size_t bytes) {
    held_ -= bytes;
    const std::size_t at = reinterpret_cast<std::uintptr_t>(pointer) - reinterpret_cast<std::uintptr_t>(buffer_);
    if (at >= kBuffer) [[unlikely]]
      return give_block(pointer, bytes);
    if (at + rounded(bytes) == used_) used_ = at;  // the last one handed out
  }

 private:
  // Arrays that grow leave gaps in the buffer, so only small ones go there.
  static constexpr std::size_t kBuffer = 48 << 10, kSmall = 8 << 10;
  static constexpr std::size_t kAlign = alignof(std::max_align_t);
  static constexpr std::size_t rounded(std::size_t bytes) { return (bytes + kAlign - 1) & ~(kAlign - 1); }

  void* take_block(std::size_t bytes);
  void give_block(void* pointer, std::size_t bytes);

  // What of the buffer is used before the first array: nothing, or in a library built with the address sanitizer more
  // than all of it, so that every array is an allocation of its own and the sanitizer sees its ends. Not a constant of
  // this header: a program may be built without the sanitizer and its library with it.
  static const std::size_t kUsedAtFirst;

  alignas(kAlign) std::byte buffer_[kBuffer];
  std::size_t used_ = kUsedAtFirst;
  std::size_t held_ = 0, peak_ = 0;  // bytes handed out, now and at most
  std::shared_ptr<base::MemoryBudget> budget_;
};

/// Arrays of a computation with a scratch, or without one on the heap. What is not given a value has none: resize()
/// does not clear numbers.
template <class T>
class ScratchAllocator {
 public:
  using value_type = T;

  ScratchAllocator(Scratch* scratch = nullptr) noexcept : scratch_(scratch) {}
  template <class U>
  ScratchAllocator(const ScratchAllocator<U>& other) noexcept : scratch_(other.scratch()) {}
  ScratchAllocator select_on_container_copy_construction() const { return {}; }

  T* allocate(std::size_t n) {
    return static_cast<T*>(scratch_ != nullptr ? scratch_->take(n * sizeof(T)) : ::operator new(n * sizeof(T)));
  }
  void deallocate(T* pointer, std::size_t n) {
    if (scratch_ != nullptr) scratch_->give(pointer, n * sizeof(T));
    else ::operator delete(pointer);
  }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  Scratch* scratch() const { return scratch_; }
  friend bool operator==(const ScratchAllocator& a, const ScratchAllocator& b) { return a.scratch_ == b.scratch_; }

 private:
  Scratch* scratch_;
};

template <class T>
using Array = std::vector<T, ScratchAllocator<T>>;

// Numbers for keys: a hash table for the few keys of a small computation, without an allocation per key.

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

// Classes of elements that are made one by one.

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
