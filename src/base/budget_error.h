// What takes more memory than a caller allows.
#pragma once

#include <cstdint>
#include <string>

#include "dymsum/result.h"

namespace dymsum::base {

/// 1000000 bytes are "1 MB", fewer so many bytes.
std::string memory_text(std::uint64_t bytes);

/// out_of_memory, as in "the sum takes at least 12 MB of memory, the limit is 5 MB".
Error budget_error(const std::string& what, std::uint64_t bytes, std::uint64_t limit);

}  // namespace dymsum::base
