// How many lines a text has at most.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dymsum::fuzz {

/// With lines that end in a line feed, or in a carriage return.
inline std::int64_t most_lines(std::string_view text) {
  std::int64_t lines = 1;
  for (std::size_t i = 0; i < text.size(); ++i)
    lines += text[i] == '\n' || (text[i] == '\r' && !text.substr(i).starts_with("\r\n"));
  return lines;
}

}  // namespace dymsum::fuzz
