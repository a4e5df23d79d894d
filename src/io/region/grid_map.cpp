#include "io/region/grid_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/source.h"

namespace dymsum::io {
namespace {

// Directions counter-clockwise: right, up, left, down.
constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

struct Corner {
  std::int64_t i = 0, j = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};
using Loop = std::vector<Corner>;

// Cells of a set with a frame of cells around them that are not in it.
class CellSet {
 public:
  CellSet(const GridMap& map, GridSet set) : border_(set == GridSet::blocked ? 1 : 0) {
    width_ = static_cast<std::int64_t>(map.width) + 2 * border_ + 2;
    height_ = static_cast<std::int64_t>(map.height) + 2 * border_ + 2;
    inside_.assign(static_cast<std::size_t>(width_ * height_), 0);
    for (std::int64_t j = 1; j + 1 < height_; ++j)
      for (std::int64_t i = 1; i + 1 < width_; ++i)
        inside_[at(i, j)] = holds(map, set, i - 1 - border_, j - 1 - border_);
  }

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  bool inside(std::int64_t i, std::int64_t j) const { return inside_[at(i, j)] != 0; }
  std::size_t at(std::int64_t i, std::int64_t j) const { return static_cast<std::size_t>(j * width_ + i); }
  // The corner in cells of the map.
  Corner on_map(Corner c) const { return {c.i - 1 - border_, c.j - 1 - border_}; }

  /// The cell on the left of the grid edge that leaves a corner in a direction.
  bool left_of(Corner c, int d) const { return inside(c.i - (d == 1 || d == 2), c.j - (d == 2 || d == 3)); }
  bool right_of(Corner c, int d) const { return inside(c.i - (d == 2 || d == 3), c.j - (d == 3 || d == 0)); }

 private:
  bool holds(const GridMap& map, GridSet set, std::int64_t i, std::int64_t j) const {
    const auto w = static_cast<std::int64_t>(map.width), h = static_cast<std::int64_t>(map.height);
    if (i < 0 || j < 0 || i >= w || j >= h) return set == GridSet::blocked;
    const GridCell cell = map.cells[static_cast<std::size_t>(j * w + i)];
    switch (set) {
      case GridSet::blocked:
        return cell != GridCell::free;
      case GridSet::occupied:
        return cell == GridCell::occupied;
      case GridSet::unknown:
        return cell == GridCell::unknown;
      case GridSet::free:
        break;
    }
    return cell == GridCell::free;
  }

  std::int64_t width_ = 0, height_ = 0, border_ = 0;
  std::vector<std::uint8_t> inside_;
};

// Boundaries with the set on their left. Where two cells of the set meet in a corner a loop stays with its cell: parts
// are connected through sides.
class Tracer {
 public:
  explicit Tracer(const CellSet& set) : set_(set), done_(static_cast<std::size_t>(set.width() * set.height()), 0) {}

  std::vector<Loop> loops() {
    std::vector<Loop> all;
    for (std::int64_t j = 1; j < set_.height(); ++j)
      for (std::int64_t i = 1; i < set_.width(); ++i)
        for (const int d : {0, 2}) {
          const Corner c{i, j};
          if (is_boundary(c, d) && !done(c, d)) split(traced(c, d), all);
        }
    return all;
  }

 private:
  bool is_boundary(Corner c, int d) const {
    const Corner to{c.i + kStep[d][0], c.j + kStep[d][1]};
    if (to.i < 1 || to.j < 1 || to.i >= set_.width() || to.j >= set_.height()) return false;
    return set_.left_of(c, d) && !set_.right_of(c, d);
  }
  bool done(Corner c, int d) const { return (done_[set_.at(c.i, c.j)] >> d & 1) != 0; }

  // All corners of the grid along it.
  Loop traced(Corner c, int d) {
    Loop loop;
    while (!done(c, d)) {
      done_[set_.at(c.i, c.j)] |= static_cast<std::uint8_t>(1 << d);
      loop.push_back(c);
      c = {c.i + kStep[d][0], c.j + kStep[d][1]};
      // Left first, which keeps the cell.
      for (const int turn : {1, 0, 3})
        if (const int next = (d + turn) % 4; is_boundary(c, next)) {
          d = next;
          break;
        }
    }
    return loop;
  }

  // A loop that comes to a corner twice is two that touch there.
  void split(const Loop& loop, std::vector<Loop>& all) {
    Loop open;
    std::vector<std::size_t> positions;
    for (const Corner& c : loop) {
      std::uint32_t& position = position_of(c);
      if (position != 0) {
        const auto first = open.begin() + static_cast<std::ptrdiff_t>(position - 1);
        all.emplace_back(first, open.end());
        for (auto k = first + 1; k != open.end(); ++k) position_of(*k) = 0;
        open.erase(first + 1, open.end());
        continue;
      }
      open.push_back(c);
      position = static_cast<std::uint32_t>(open.size());
    }
    for (const Corner& c : open) position_of(c) = 0;
    all.push_back(std::move(open));
  }
  std::uint32_t& position_of(Corner c) {
    if (positions_.empty()) positions_.assign(done_.size(), 0);
    return positions_[set_.at(c.i, c.j)];
  }

  const CellSet& set_;
  std::vector<std::uint8_t> done_;        // directions that were walked, per corner
  std::vector<std::uint32_t> positions_;  // in the open loop, from 1
};

// Parts of cells that are connected through sides, by index + 1.
std::vector<std::uint32_t> parts_of(const CellSet& set, std::uint32_t& count) {
  std::vector<std::uint32_t> part(static_cast<std::size_t>(set.width() * set.height()), 0);
  std::vector<Corner> open;
  for (std::int64_t j = 1; j + 1 < set.height(); ++j)
    for (std::int64_t i = 1; i + 1 < set.width(); ++i) {
      if (!set.inside(i, j) || part[set.at(i, j)] != 0) continue;
      part[set.at(i, j)] = ++count;
      open.push_back({i, j});
      while (!open.empty()) {
        const Corner c = open.back();
        open.pop_back();
        for (const auto& step : kStep) {
          const Corner to{c.i + step[0], c.j + step[1]};
          if (!set.inside(to.i, to.j) || part[set.at(to.i, to.j)] != 0) continue;
          part[set.at(to.i, to.j)] = count;
          open.push_back(to);
        }
      }
    }
  return part;
}

// Twice the area, positive counter-clockwise.
std::int64_t twice_area(const Loop& loop) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Corner &a = loop[k], &b = loop[(k + 1) % loop.size()];
    sum += a.i * b.j - a.j * b.i;
  }
  return sum;
}

Point placed(const GridMap& map, double c, double s, Corner corner) {
  const auto i = static_cast<double>(corner.i), j = static_cast<double>(corner.j);
  if (map.yaw == 0) return {std::fma(i, map.resolution, map.x), std::fma(j, map.resolution, map.y)};
  const double u = i * map.resolution, v = j * map.resolution;
  return {map.x + (c * u - s * v), map.y + (s * u + c * v)};
}

Ring ring_of(const GridMap& map, const CellSet& set, const Loop& loop) {
  const double c = std::cos(map.yaw), s = std::sin(map.yaw);
  Ring ring;
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Corner &a = loop[(k + n - 1) % n], &b = loop[k], &d = loop[(k + 1) % n];
    if ((b.i - a.i) * (d.j - b.j) - (b.j - a.j) * (d.i - b.i) != 0) ring.push_back(placed(map, c, s, set.on_map(b)));
  }
  return ring;
}

// The cell on the left of a loop's first edge.
std::size_t cell_beside(const CellSet& set, const Loop& loop) {
  const Corner &a = loop[0], &b = loop[1];
  const bool left = b.i < a.i, down = b.j<a.j, up = b.j> a.j;
  return set.at(a.i - (left || up), a.j - (left || down));
}

}  // namespace

RegionData grid_region(const GridMap& map, GridSet set) {
  const CellSet cells(map, set);
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> part = parts_of(cells, count);
  RegionData data;
  data.parts.resize(count);
  for (const Loop& loop : Tracer(cells).loops()) {
    Part& owner = data.parts[part[cell_beside(cells, loop)] - 1];
    if (twice_area(loop) > 0) owner.outer = ring_of(map, cells, loop);
    else owner.holes.push_back(ring_of(map, cells, loop));
  }
  return data;
}

// Grey images in portable graymap format, P5 (bytes) and P2 (numbers).

namespace {

constexpr const char* kTooLarge = "a pixel is larger than the largest value";
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;

class PgmReader {
 public:
  explicit PgmReader(const Source& source) : source_(source), text_(source.text) {}

  GreyImage read() {
    const std::string_view magic = text_.substr(0, 2);
    if (magic != "P5" && magic != "P2") source_.fail(ErrorCode::malformed, "a .pgm file begins with P5 or P2", 0);
    at_ = 2;
    GreyImage image;
    image.width = count("the width", kMostPixels);
    image.height = count("the height", kMostPixels);
    image.most = static_cast<std::uint32_t>(count("the largest value", 65535));
    if (image.width == 0 || image.height == 0 || image.most == 0)
      source_.fail(ErrorCode::malformed, "an image of nothing", at_);
    const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * image.height;
    if (pixels > kMostPixels) source_.fail(ErrorCode::malformed, "more than 2^30 pixels", at_);
    if (magic == "P5") read_bytes(image, pixels);
    else read_numbers(image, pixels);
    return image;
  }

 private:
  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else ++at_;
    }
  }

  std::uint64_t count(const std::string& what, std::uint64_t most) {
    skip();
    if (at_ >= text_.size()) source_.fail(ErrorCode::truncated, "the image ends before " + what, at_);
    const ScannedCount number = scan_count(text_.substr(at_));
    const std::size_t end = at_ + number.length;
    if (number.length == 0 || (end < text_.size() && !is_blank(text_[end])) || number.value > most)
      source_.fail(ErrorCode::malformed, "expected " + what + ", at most " + std::to_string(most), at_);
    at_ = end;
    return number.value;
  }

  // Two bytes each, the larger one first, where values exceed one.
  void read_bytes(GreyImage& image, std::uint64_t pixels) {
    const std::size_t size = image.most > 255 ? 2 : 1;
    if (at_ < text_.size()) ++at_;
    if (text_.size() - at_ < size * pixels)
      source_.fail_in_bytes(ErrorCode::truncated, "the image announces " + std::to_string(pixels) +
                                                      " pixels and ends after " +
                                                      std::to_string((text_.size() - at_) / size) + ", at byte " +
                                                      std::to_string(text_.size()));
    image.pixels.reserve(pixels);
    for (std::uint64_t k = 0; k < pixels; ++k, at_ += size) {
      std::uint32_t value = static_cast<unsigned char>(text_[at_]);
      if (size == 2) value = value << 8 | static_cast<unsigned char>(text_[at_ + 1]);
      if (value > image.most)
        source_.fail_in_bytes(ErrorCode::malformed, kTooLarge + std::string(", at byte ") + std::to_string(at_));
      image.pixels.push_back(static_cast<std::uint16_t>(value));
    }
  }

  void read_numbers(GreyImage& image, std::uint64_t pixels) {
    image.pixels.reserve(std::min<std::uint64_t>(pixels, text_.size() / 2));
    for (std::uint64_t k = 0; k < pixels; ++k) {
      const std::uint64_t value = count("pixel " + std::to_string(k), 65535);
      if (value > image.most) source_.fail(ErrorCode::malformed, kTooLarge, at_);
      image.pixels.push_back(static_cast<std::uint16_t>(value));
    }
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

GreyImage read_pgm(const Source& source) { return PgmReader(source).read(); }

// Maps of the MovingAI benchmarks.

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
