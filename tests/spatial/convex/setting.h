// Numbers from the environment that make a random test longer or replay it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace dymsum::test {

inline std::uint64_t setting(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  const std::uint64_t value = text != nullptr && *text != 0 ? std::strtoull(text, nullptr, 10) : fallback;
  std::printf("%s=%llu\n", name, static_cast<unsigned long long>(value));
  return value;
}

}  // namespace dymsum::test
