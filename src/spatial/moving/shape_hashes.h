// Hashes that names of the parts of a sum are made of.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dymsum::spatial {

inline std::uint64_t mixed(std::uint64_t h, std::uint64_t v) {
  h ^= v + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
  h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 27, h *= 0x81dadef4bc2dd44dULL;
  return h ^ (h >> 33);
}
/// A hash of values in any order, which it sorts.
inline std::uint64_t mixed_list(std::uint64_t seed, std::vector<std::uint64_t>& values) {
  std::sort(values.begin(), values.end());
  for (const std::uint64_t v : values) seed = mixed(seed, v);
  return mixed(seed, values.size());
}

}  // namespace dymsum::spatial
