// What a computation may hold in memory: arrays that grow faster than its operands count here before they are made.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace dymsum::base {

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

}  // namespace dymsum::base
