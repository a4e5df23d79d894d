// Whole files as bytes, and what paths say about them.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/result.h"

namespace dymsum::io {

// Text as the readers take it.

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

/// The bytes of a file, or of standard input for "-"; of a compressed one (.gz, whatever its name) what it holds.
/// Errors: cannot_open, also for directories; as unzipped_gz.
Result<std::string> read_file(const std::string& path);

bool is_directory(const std::string& path);

/// The path's last part from its last dot on, in lower case: ".off", also of "x.off.gz"; empty where there is none.
std::string extension(std::string_view path);

/// Whether a file of this name is compressed.
bool ends_in_gz(std::string_view path);

/// An error that is about a file as a whole.
Error file_error(ErrorCode code, std::string message, std::string_view file);

}  // namespace dymsum::io
