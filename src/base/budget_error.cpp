#include "base/budget_error.h"

namespace dymsum::base {

std::string memory_text(std::uint64_t bytes) {
  if (bytes < 1000000) return std::to_string(bytes) + " bytes";
  return std::to_string((bytes + 999999) / 1000000) + " MB";
}

Error budget_error(const std::string& what, std::uint64_t bytes, std::uint64_t limit) {
  return {
      ErrorCode::out_of_memory, what + " " + memory_text(bytes) + " of memory, the limit is " + memory_text(limit), {}};
}

}  // namespace dymsum::base
