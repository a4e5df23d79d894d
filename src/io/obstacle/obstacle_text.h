// What writers and readers of obstacles agree on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace dymsum::io {

inline constexpr const char* kObstacleFormat = "dymsum obstacle";
inline constexpr int kObstacleVersion = 1;

/// FNV-1a of 64 bits in hexadecimal digits, of the content's text without blanks and with sorted keys: every change of
/// one byte changes it.
inline std::string checksum(const nlohmann::json& content) {
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const char c : content.dump()) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[sum >> shift & 15];
  return digits;
}

}  // namespace dymsum::io
