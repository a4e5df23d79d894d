#include "io/read_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "io/archive.h"

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

Error file_error(ErrorCode code, std::string message, std::string_view file) {
  Evidence evidence;
  evidence.file = file;
  return {code, std::move(message), std::move(evidence)};
}

bool ends_in_gz(std::string_view path) {
  if (path.size() < 3) return false;
  const std::string_view end = path.substr(path.size() - 3);
  return end == ".gz" || end == ".GZ";
}

std::string extension(std::string_view path) {
  if (ends_in_gz(path)) path.remove_suffix(3);
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  if (dot == std::string_view::npos || (slash != std::string_view::npos && slash > dot)) return "";
  std::string text(path.substr(dot));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

bool is_directory(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

Result<std::string> read_file(const std::string& path) {
  const bool standard = path == "-";
  if (!standard && is_directory(path)) return file_error(ErrorCode::cannot_open, "this is a directory", path);
  const auto close = [standard](std::FILE* file) { return standard ? 0 : std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(standard ? stdin : std::fopen(path.c_str(), "rb"), close);
  if (!file) return file_error(ErrorCode::cannot_open, std::strerror(errno), path);
  std::string text;
  std::array<char, 1 << 16> block;
  std::size_t count = 0;
  while ((count = std::fread(block.data(), 1, block.size(), file.get())) > 0) text.append(block.data(), count);
  if (std::ferror(file.get()))
    return file_error(ErrorCode::cannot_open, std::string("reading failed: ") + std::strerror(errno), path);
  return is_gzip(text) ? unzipped_gz(text, path) : std::move(text);
}

}  // namespace dymsum::io
