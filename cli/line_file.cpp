#include "line_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include "inputs.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

/// The text without the mark of its byte order; where lines end in carriage returns alone, these are line feeds.
std::string text_of_lines(std::string_view bytes) {
  std::string text(without_mark(bytes));
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

}  // namespace

void refuse_line(Error error, const std::string& file, std::optional<std::int64_t> line) {
  error.evidence.file = shown_file(file);
  error.evidence.line = line;
  stop_with(error);
}

std::string file_text(const std::string& file) {
  if (file == "-") return text_of_lines(standard_input());
  const auto refuse = [&](const std::string& why) {
    refuse_line({ErrorCode::cannot_open, why, {}}, file, std::nullopt);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) refuse("this is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) refuse(std::string("reading failed: ") + std::strerror(errno));
  return text_of_lines(text);
}

std::vector<std::string> words_of(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  std::vector<std::string> words;
  if (text.find(',') == std::string::npos) {
    std::istringstream in(text);
    for (std::string word; in >> word;) words.push_back(word);
    return words;
  }
  for (const std::string& piece : split(text, ',')) {
    const std::size_t first = piece.find_first_not_of(kBlanks);
    words.push_back(first == std::string::npos ? "" : piece.substr(first, piece.find_last_not_of(kBlanks) + 1 - first));
  }
  return words;
}

bool for_each_line(const std::string& text, const TakeLine& take) {
  std::istringstream in(text);
  std::int64_t line = 0;
  bool any = false;
  for (std::string one; std::getline(in, one);) {
    ++line;
    one.resize(std::min(one.find('#'), one.size()));
    if (one.find_first_not_of(" \t\r") == std::string::npos) continue;
    take(one, line);
    any = true;
  }
  return any;
}

}  // namespace dymsum::cli
