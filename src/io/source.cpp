#include "io/source.h"

#include <algorithm>
#include <utility>

namespace dymsum::io {

std::int64_t Source::line(std::size_t offset) const {
  std::size_t last = text.size();
  while (last > 0 && is_blank(text[last - 1])) --last;
  const std::size_t end = std::min(offset, last > 0 ? last - 1 : 0);
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
}

void Source::fail(ErrorCode code, std::string message, std::size_t offset, Evidence evidence) const {
  fail_on_line(code, std::move(message), line(offset), std::move(evidence));
}

void Source::fail_in_bytes(ErrorCode code, std::string message) const {
  Evidence evidence;
  evidence.file = file;
  throw ReadFailure{Error{code, std::move(message), std::move(evidence)}};
}

void Source::fail_on_line(ErrorCode code, std::string message, std::int64_t line, Evidence evidence) const {
  evidence.file = file;
  evidence.line = line;
  throw ReadFailure{Error{code, std::move(message), std::move(evidence)}};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 24;
  std::string out = "'";
  for (const char c : text.substr(0, kLongest)) out += c >= ' ' && c <= '~' ? c : '?';
  if (text.size() > kLongest) out += "...";
  return out + "'";
}

}  // namespace dymsum::io
