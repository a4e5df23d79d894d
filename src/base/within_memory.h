// Computations with a limit of memory: past it they end with an error.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "base/budget_error.h"
#include "base/memory_budget.h"

namespace dymsum::base {

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
