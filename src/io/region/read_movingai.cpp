// Maps of the MovingAI benchmarks.
#include <algorithm>

#include "io/number_text.h"
#include "io/region/grid_map.h"

namespace dymsum::io {
namespace {

class MovingAiReader {
 public:
  explicit MovingAiReader(const Source& source) : source_(source) {}

  GridMap read() {
    GridMap map;
    word_after("type");
    map.height = count_after("height");
    map.width = count_after("width");
    if (next_line() != "map") fail("expected 'map'");
    std::vector<GridCell> rows;  // from above
    for (std::size_t row = 0; row < map.height; ++row) {
      if (at_ >= source_.text.size())
        source_.fail_on_line(
            ErrorCode::truncated,
            "the map announces " + std::to_string(map.height) + " rows and ends after " + std::to_string(row), line_);
      read_row(next_line(), map.width, rows);
    }
    for (auto end = rows.end(); end != rows.begin(); end -= static_cast<std::ptrdiff_t>(map.width))
      map.cells.insert(map.cells.end(), end - static_cast<std::ptrdiff_t>(map.width), end);
    for (; at_ < source_.text.size();)
      if (!next_line().empty()) fail("unexpected text after the last row");
    return map;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { source_.fail_on_line(ErrorCode::malformed, what, line_); }

  std::string_view next_line() {
    if (at_ >= source_.text.size()) source_.fail_on_line(ErrorCode::truncated, "the map ends before its rows", line_);
    ++line_;
    const std::size_t end = std::min(source_.text.find('\n', at_), source_.text.size());
    std::string_view line = source_.text.substr(at_, end - at_);
    at_ = end + 1;
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
  }

  std::string_view word_after(std::string_view key) {
    const std::string_view line = next_line();
    const std::size_t blank = line.find(' ');
    if (line.substr(0, blank) != key || blank == std::string_view::npos)
      fail("expected '" + std::string(key) + "' and a value");
    return line.substr(blank + 1);
  }

  // A row has a character per cell, so the file holds as many.
  std::size_t count_after(std::string_view key) {
    const std::string_view word = word_after(key);
    const ScannedCount count = scan_count(word);
    if (count.length == 0 || count.length != word.size() || count.value == 0 || count.value > 1u << 15)
      fail("expected a " + std::string(key) + " from 1 to 32768");
    return count.value;
  }

  void read_row(std::string_view row, std::size_t width, std::vector<GridCell>& cells) {
    if (row.size() != width)
      fail("the row has " + std::to_string(row.size()) + " cells and the map is " + std::to_string(width) + " wide");
    for (std::size_t i = 0; i < width; ++i) {
      const char c = row[i];
      const bool blocked = c == '@' || c == 'O' || c == 'T' || c == 'W';
      if (!blocked && c != '.' && c != 'G' && c != 'S') fail("a map has no terrain " + in_quotes(row.substr(i, 1)));
      cells.push_back(blocked ? GridCell::occupied : GridCell::free);
    }
  }

  const Source& source_;
  std::size_t at_ = 0;
  std::int64_t line_ = 0;
};

}  // namespace

GridMap read_movingai(const Source& source) { return MovingAiReader(source).read(); }

}  // namespace dymsum::io
