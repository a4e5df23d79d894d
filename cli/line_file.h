// Files with one thing on a line: configurations, places, copies.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/result.h"

namespace dymsum::cli {

/// Ends the command with an error of a file, and of a line of it where that is known.
[[noreturn]] void refuse_line(Error error, const std::string& file, std::optional<std::int64_t> line);

/// All of a file, or of standard input for "-", without a byte order mark. Stops when it cannot be read, with the words
/// of all readers.
std::string file_text(const std::string& file);

/// The pieces between commas, without the blanks around them; where there are no commas, the words between blanks.
std::vector<std::string> words_of(const std::string& text);

using TakeLine = std::function<void(const std::string& text, std::int64_t line)>;

/// Calls take(text, line) for every line that holds something, lines counted from 1; # begins a comment. Returns
/// whether there was one.
bool for_each_line(const std::string& text, const TakeLine& take);

}  // namespace dymsum::cli
