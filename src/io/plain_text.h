// Text as the readers take it.
#pragma once

#include <string>
#include <string_view>

namespace dymsum::io {

/// Bytes without the mark of their byte order, with line feeds for carriage returns where lines end in these alone: the
/// readers look for line feeds, and a comment would hide the rest of such a file. Nothing else changes. Requires: the
/// bytes outlive it.
class PlainText {
 public:
  /// `text`: how many of the bytes are text; behind them nothing changes.
  explicit PlainText(std::string_view bytes, std::size_t text = std::string_view::npos);
  PlainText(const PlainText&) = delete;
  PlainText& operator=(const PlainText&) = delete;

  std::string_view view() const { return rewritten_.empty() ? given_ : std::string_view(rewritten_); }

 private:
  std::string_view given_;
  std::string rewritten_;
};

}  // namespace dymsum::io
