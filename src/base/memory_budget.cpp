#include "base/memory_budget.h"

namespace dymsum::base {

std::string memory_text(std::uint64_t bytes) {
  if (bytes < 1000000) return std::to_string(bytes) + " bytes";
  return std::to_string((bytes + 999999) / 1000000) + " MB";
}

Error budget_error(const std::string& what, std::uint64_t bytes, std::uint64_t limit) {
  return {
      ErrorCode::out_of_memory, what + " " + memory_text(bytes) + " of memory, the limit is " + memory_text(limit), {}};
}

namespace {

thread_local std::shared_ptr<MemoryBudget> current;

}  // namespace

void MemoryBudget::take(std::uint64_t bytes) {
  const std::uint64_t all = held_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  try {
    if (all > limit_) throw OverMemory(all, limit_);
    if (larger_ != nullptr) larger_->take(bytes);
  } catch (...) {
    held_.fetch_sub(bytes, std::memory_order_relaxed);
    throw;
  }
}

void MemoryBudget::give(std::uint64_t bytes) noexcept {
  held_.fetch_sub(bytes, std::memory_order_relaxed);
  if (larger_ != nullptr) larger_->give(bytes);
}

const std::shared_ptr<MemoryBudget>& current_budget() noexcept { return current; }

UseBudget::UseBudget(std::shared_ptr<MemoryBudget> budget) noexcept
    : before_(std::exchange(current, std::move(budget))) {}
UseBudget::~UseBudget() { current = std::move(before_); }

}  // namespace dymsum::base
