// Memory of a value with many arrays that are made together and die together: one block instead of an allocation for
// each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace dymsum {

/// Memory that has to be the first member, so that the arrays after it die before their memory does. A copy has arrays
/// of its own on the heap, and what is assigned is copied into the arrays that are there: so neither changes whose
/// memory it is. Arrays are made by one thread at a time.
class OwnMemory {
 public:
  OwnMemory() = default;
  explicit OwnMemory(std::size_t bytes) : block_(static_cast<Block*>(::operator new(sizeof(Block) + bytes))) {
    *block_ = {0, bytes};
  }
  OwnMemory(const OwnMemory&) noexcept {}
  OwnMemory(OwnMemory&& other) noexcept = default;
  OwnMemory& operator=(const OwnMemory&) noexcept { return *this; }
  OwnMemory& operator=(OwnMemory&&) noexcept { return *this; }

 private:
  template <class T>
  friend class OwnAllocator;
  static constexpr std::size_t kAlign = alignof(std::max_align_t);

  // The bytes to be handed out follow.
  struct alignas(kAlign) Block {
    std::size_t used, size;

    std::byte* bytes() { return reinterpret_cast<std::byte*>(this + 1); }
    // Takes from the heap what the block does not hold.
    void* take(std::size_t n) {
      const std::size_t room = (n + kAlign - 1) & ~(kAlign - 1);
      if (room > size - used) [[unlikely]]
        return ::operator new(n);
      void* const at = bytes() + used;
      used += room;
      return at;
    }
    bool holds(const void* at) {
      return reinterpret_cast<std::uintptr_t>(at) - reinterpret_cast<std::uintptr_t>(bytes()) < size;
    }
  };
  struct Free {
    void operator()(Block* block) const { ::operator delete(block); }
  };

  std::unique_ptr<Block, Free> block_;
};

/// Arrays in an OwnMemory, or without one on the heap. What is not given a value has none: resize() does not clear
/// numbers. What an array in the block gives back is not handed out again.
template <class T>
class OwnAllocator {
 public:
  using value_type = T;

  OwnAllocator() noexcept = default;
  OwnAllocator(const OwnMemory& memory) noexcept : block_(memory.block_.get()) {}
  template <class U>
  OwnAllocator(const OwnAllocator<U>& other) noexcept : block_(other.block_) {}
  OwnAllocator select_on_container_copy_construction() const { return {}; }

  T* allocate(std::size_t n) {
    return static_cast<T*>(block_ != nullptr ? block_->take(n * sizeof(T)) : ::operator new(n * sizeof(T)));
  }
  void deallocate(T* pointer, std::size_t) {
    if (block_ == nullptr || !block_->holds(pointer)) ::operator delete(pointer);
  }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  friend bool operator==(const OwnAllocator& a, const OwnAllocator& b) { return a.block_ == b.block_; }

 private:
  template <class U>
  friend class OwnAllocator;
  OwnMemory::Block* block_ = nullptr;
};

template <class T>
using OwnArray = std::vector<T, OwnAllocator<T>>;

}  // namespace dymsum
