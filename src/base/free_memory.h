// Giving back memory before an array dies.
#pragma once

namespace dymsum::base {

/// Empties arrays and gives their memory back, which `array = {}` does not.
template <class... Arrays>
void free_memory(Arrays&... arrays) {
  (Arrays().swap(arrays), ...);
}

}  // namespace dymsum::base
