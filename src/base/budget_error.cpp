#include "base/budget_error.h"

namespace dymsum::base {

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999999) / 1000000) + " MB"; }

Error budget_error(const std::string& what, std::uint64_t bytes, std::uint64_t limit) {
  return {ErrorCode::out_of_memory, what + " " + megabytes(bytes) + " of memory, the limit is " + megabytes(limit), {}};
}

}  // namespace dymsum::base
