// What operator new of this program counts, on request.
#pragma once

#include <cstdint>

namespace dymsum::cli {

/// Begins to count what is held: std::bad_alloc is thrown where it would be more. 0: no limit any more.
void count_memory(std::uint64_t limit);

struct CountedMemory {
  std::uint64_t limit = 0;    ///< the last one
  std::uint64_t refused = 0;  ///< what would have been held where more was requested, at last; 0: it never was
};
CountedMemory counted_memory();

}  // namespace dymsum::cli
