#include "io/plain_text.h"

#include <algorithm>

namespace dymsum::io {

PlainText::PlainText(std::string_view bytes, std::size_t text) : given_(bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::string_view head = bytes.substr(0, text);
  if (head.find('\r') != std::string_view::npos && head.find('\n') == std::string_view::npos) {
    rewritten_ = bytes;
    std::replace(rewritten_.begin(), rewritten_.begin() + static_cast<std::ptrdiff_t>(head.size()), '\r', '\n');
    if (head.starts_with(kByteOrderMark)) rewritten_.erase(0, kByteOrderMark.size());
  } else if (head.starts_with(kByteOrderMark)) {
    given_.remove_prefix(kByteOrderMark.size());
  }
}

}  // namespace dymsum::io
