// Memory that a computation may take: budgets, what happens past them, arrays that own theirs and give it back.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/result.h"

namespace dymsum::base {

// Giving back memory before an array dies.

/// Empties arrays and gives their memory back, which `array = {}` does not.
template <class... Arrays>
void free_memory(Arrays&... arrays) {
  (Arrays().swap(arrays), ...);
}

}  // namespace dymsum::base

namespace dymsum {

// Memory of a value with many arrays that are made together and die together: one block instead of an allocation for
// each.

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

namespace dymsum::base {

// What takes more memory than a caller allows.

/// 1000000 bytes are "1 MB", fewer so many bytes.
std::string memory_text(std::uint64_t bytes);

/// out_of_memory, as in "the sum takes at least 12 MB of memory, the limit is 5 MB".
Error budget_error(const std::string& what, std::uint64_t bytes, std::uint64_t limit);

// What a computation may hold in memory: arrays that grow faster than its operands count here before they are made.

/// Thrown where more is about to be held than the limit. What handles memory that has run out handles this too.
class OverMemory : public std::bad_alloc {
 public:
  OverMemory(std::uint64_t bytes, std::uint64_t limit) : bytes_(bytes), limit_(limit) {}
  std::uint64_t bytes() const { return bytes_; }  ///< that would be held, all together
  std::uint64_t limit() const { return limit_; }
  const char* what() const noexcept override { return "more memory would be held than the limit allows"; }

 private:
  std::uint64_t bytes_, limit_;
};

/// Shared by the threads of a computation.
class MemoryBudget {
 public:
  /// What is held here counts with the budget of a larger computation, too, if there is one.
  MemoryBudget(std::uint64_t limit, std::shared_ptr<MemoryBudget> larger = nullptr)
      : limit_(limit), larger_(std::move(larger)) {}

  /// Throws OverMemory, and then counts nothing.
  void take(std::uint64_t bytes);
  void give(std::uint64_t bytes) noexcept;
  std::uint64_t held() const { return held_.load(std::memory_order_relaxed); }
  std::uint64_t limit() const { return limit_; }

 private:
  const std::uint64_t limit_;
  const std::shared_ptr<MemoryBudget> larger_;
  std::atomic<std::uint64_t> held_{0};
};

/// That of what this thread computes; none: nothing counts.
const std::shared_ptr<MemoryBudget>& current_budget() noexcept;

/// Makes a budget the current one of this thread while it lives.
class UseBudget {
 public:
  explicit UseBudget(std::shared_ptr<MemoryBudget> budget) noexcept;
  ~UseBudget();
  UseBudget(const UseBudget&) = delete;
  UseBudget& operator=(const UseBudget&) = delete;

 private:
  std::shared_ptr<MemoryBudget> before_;
};

/// Bytes that count with the current budget until this dies.
class HeldMemory {
 public:
  HeldMemory() : budget_(current_budget()) {}
  ~HeldMemory() {
    if (budget_ != nullptr) budget_->give(bytes_);
  }
  HeldMemory(const HeldMemory&) = delete;
  HeldMemory& operator=(const HeldMemory&) = delete;

  void add(std::uint64_t bytes) {
    if (budget_ == nullptr) return;
    budget_->take(bytes);
    bytes_ += bytes;
  }
  /// Gives back bytes of those that were added.
  void give(std::uint64_t bytes) {
    if (budget_ == nullptr) return;
    budget_->give(bytes);
    bytes_ -= bytes;
  }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_ = 0;
};

/// The allocator of arrays that count with the budget that was the current one when they were made.
template <class T>
class CountedAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  CountedAllocator() noexcept : budget_(current_budget()) {}
  template <class U>
  CountedAllocator(const CountedAllocator<U>& other) noexcept : budget_(other.budget_) {}
  CountedAllocator select_on_container_copy_construction() const { return {}; }

  T* allocate(std::size_t n) {
    if (budget_ == nullptr) return static_cast<T*>(::operator new(n * sizeof(T)));
    budget_->take(n * sizeof(T));
    try {
      return static_cast<T*>(::operator new(n * sizeof(T)));
    } catch (...) {
      budget_->give(n * sizeof(T));
      throw;
    }
  }
  void deallocate(T* pointer, std::size_t n) noexcept {
    if (budget_ != nullptr) budget_->give(n * sizeof(T));
    ::operator delete(pointer);
  }
  friend bool operator==(const CountedAllocator& a, const CountedAllocator& b) { return a.budget_ == b.budget_; }

 private:
  template <class U>
  friend class CountedAllocator;
  std::shared_ptr<MemoryBudget> budget_;
};

template <class T>
using CountedArray = std::vector<T, CountedAllocator<T>>;

// Computations with a limit of memory: past it they end with an error.

/// A budget of so many bytes within the current one; 0: the current one, or none.
inline std::shared_ptr<MemoryBudget> budget_of(std::uint64_t limit) {
  return limit == 0 ? current_budget() : std::make_shared<MemoryBudget>(limit, current_budget());
}

/// "the sum takes at least 12 MB of memory, the limit is 5 MB".
inline Error over_memory(const std::string& what, const OverMemory& over) {
  return budget_error(what + " takes at least", over.bytes(), over.limit());
}

/// f(), which returns a Result, within a budget; out_of_memory where that does not suffice.
template <class F>
auto within_memory(std::shared_ptr<MemoryBudget> budget, const char* what, F f) -> decltype(f()) {
  if (budget == nullptr) return f();
  const UseBudget use(std::move(budget));
  try {
    return f();
  } catch (const OverMemory& over) {
    return over_memory(what, over);
  }
}

/// The same within so many bytes; 0: no limit of its own.
template <class F>
auto within_memory(std::uint64_t limit, const char* what, F f) -> decltype(f()) {
  return limit == 0 ? f() : within_memory(budget_of(limit), what, std::move(f));
}

}  // namespace dymsum::base
