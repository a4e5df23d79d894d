// The thesis's format: number of chains; per chain `n out|in`, n points, the order of the points on a line or more.
// Besides, of our own: `n open` is a polyline, `n points` are single points.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "io/region/read_shapes.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

class PolyReader {
 public:
  explicit PolyReader(const Source& source) : source_(source), text_(source.text) {}

  RegionData read() {
    skip();
    const std::uint64_t chains = read_count("the number of chains");
    for (std::uint64_t k = 0; k < chains; ++k) {
      skip();
      if (at_end()) {
        fail(ErrorCode::truncated,
             "the file announces " + std::to_string(chains) + " chains and ends after " + std::to_string(k));
      }
      read_chain();
    }
    skip();
    if (!at_end()) fail(ErrorCode::malformed, "unexpected " + in_quotes(word()) + " after the last chain");
    return std::move(data_);
  }

 private:
  bool at_end() const { return at_ >= text_.size(); }

  [[noreturn]] void fail(ErrorCode code, std::string message, Evidence evidence = {}) const {
    source_.fail(code, std::move(message), at_, std::move(evidence));
  }

  /// Blanks and comments; `stay_on_line` stops in front of the line's end.
  void skip(bool stay_on_line = false) {
    while (!at_end()) {
      if (text_[at_] == '#') {
        while (!at_end() && text_[at_] != '\n') ++at_;
      } else if (!is_blank(text_[at_]) || (stay_on_line && text_[at_] == '\n')) {
        return;
      } else {
        ++at_;
      }
    }
  }

  /// What stands here up to the next blank.
  std::string_view word() const {
    std::size_t end = at_;
    while (end < text_.size() && !is_blank(text_[end]) && text_[end] != '#') ++end;
    return text_.substr(at_, end - at_);
  }

  std::uint64_t read_count(const std::string& what) {
    if (at_end()) fail(ErrorCode::truncated, "the file ends before " + what);
    const std::string_view digits = word();
    const ScannedCount count = scan_count(digits);
    if (count.length == 0 || count.length != digits.size()) {
      fail(ErrorCode::malformed, "expected " + what + " instead of " + in_quotes(digits));
    }
    at_ += count.length;
    return count.value;
  }

  void read_chain() {
    const std::uint64_t announced = read_count("the number of points of a chain");
    skip();
    if (at_end()) fail(ErrorCode::truncated, "the file ends before the kind of a chain");
    const std::string_view kind = word();
    if (kind == "out") {
      data_.parts.emplace_back();
      read_vertices(announced, data_.parts.back().outer, position(0));
    } else if (kind == "in") {
      if (data_.parts.empty()) fail(ErrorCode::malformed, "an 'in' chain without an 'out' chain before it");
      auto& holes = data_.parts.back().holes;
      holes.emplace_back();
      read_vertices(announced, holes.back(), position(static_cast<std::int64_t>(holes.size())));
    } else if (kind == "open") {
      data_.polylines.emplace_back();
      read_vertices(announced, data_.polylines.back(), {});
    } else if (kind == "points") {
      std::vector<Point> points;
      read_vertices(announced, points, {});
      data_.points.insert(data_.points.end(), points.begin(), points.end());
    } else {
      fail(ErrorCode::malformed, "expected 'out' or 'in' (or 'open' or 'points') instead of " + in_quotes(kind));
    }
  }

  Evidence position(std::int64_t ring) const {
    Evidence evidence;
    evidence.part = static_cast<std::int64_t>(data_.parts.size()) - 1;
    evidence.ring = ring;
    return evidence;
  }

  void read_vertices(std::uint64_t announced, std::vector<Point>& vertices, Evidence evidence) {
    at_ += word().size();
    // A point takes at least four characters, so a count larger than the file can hold reserves no more than the file.
    vertices.reserve(std::min<std::uint64_t>(announced, (text_.size() - at_) / 4));
    for (std::uint64_t k = 0; k < announced; ++k) {
      evidence.vertex = static_cast<std::int64_t>(k);
      const double x = read_coordinate(announced, evidence);
      const double y = read_coordinate(announced, evidence);
      vertices.push_back({x, y});
    }
    apply_index_line(vertices);
  }

  double read_coordinate(std::uint64_t announced, const Evidence& evidence) {
    skip();
    if (at_end()) {
      fail(ErrorCode::truncated,
           "a chain announces " + std::to_string(announced) + " points and the file ends before them", evidence);
    }
    const ScannedNumber number = scan_number(text_.substr(at_));
    if (number.length > 0 && !std::isfinite(number.value)) {
      fail(ErrorCode::not_finite, "the coordinate " + in_quotes(word()) + " is not a finite double", evidence);
    }
    const std::size_t end = at_ + number.length;
    const bool complete = end >= text_.size() || is_blank(text_[end]) || text_[end] == '#';
    // Glued numbers, "-6.64248.788605": a second decimal point starts the next number.
    const bool glued = !complete && text_[end] == '.' && end + 1 < text_.size() && is_digit(text_[end + 1]) &&
                       text_.substr(at_, number.length).find('.') != std::string_view::npos;
    if (number.length == 0 || !(complete || glued)) {
      fail(ErrorCode::malformed, "expected a coordinate instead of " + in_quotes(word()), evidence);
    }
    at_ = end;
    return number.value;
  }

  /// True when what follows is the `n kind` of the next chain, so that the index line is missing.
  bool at_chain_header() {
    const std::size_t here = at_;
    at_ += scan_count(text_.substr(at_)).length;
    skip();
    const bool header = !at_end() && is_letter(text_[at_]);
    at_ = here;
    return header;
  }

  /// The index line holds the vertex indices, from 1, in the order of the chain. It may be missing, and it may go on on
  /// further lines, as real files have it, until every point has come or the next chain begins.
  void apply_index_line(std::vector<Point>& vertices) {
    skip();
    if (at_end() || vertices.empty() || at_chain_header()) return;
    const std::size_t line_start = at_;
    std::vector<Point> ordered;
    std::vector<bool> seen(vertices.size());
    ordered.reserve(vertices.size());
    while (true) {
      read_indices(vertices, line_start, seen, ordered);
      if (ordered.size() >= vertices.size()) break;
      skip();
      if (at_end() || at_chain_header()) break;
    }
    if (ordered.size() != vertices.size()) {
      const ErrorCode code = at_end() ? ErrorCode::truncated : ErrorCode::malformed;
      at_ = line_start;
      fail(code, "the index line has " + std::to_string(ordered.size()) + " numbers for " +
                     std::to_string(vertices.size()) + " points");
    }
    vertices = std::move(ordered);
  }

  /// The indices up to the end of the line.
  void read_indices(const std::vector<Point>& vertices, std::size_t line_start, std::vector<bool>& seen,
                    std::vector<Point>& ordered) {
    for (skip(true); !at_end() && text_[at_] != '\n'; skip(true)) {
      const std::uint64_t index = read_count("a point's index");
      if (index < 1 || index > vertices.size() || seen[index - 1]) {
        at_ = line_start;
        fail(ErrorCode::malformed, "the index line is not a permutation of 1 to " + std::to_string(vertices.size()) +
                                       ": " + std::to_string(index) +
                                       (index < 1 || index > vertices.size() ? " is outside" : " comes twice"));
      }
      seen[index - 1] = true;
      ordered.push_back(vertices[index - 1]);
    }
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
  RegionData data_;
};

}  // namespace

std::vector<NamedShape> read_poly(const Source& source) {
  std::vector<NamedShape> shapes(1);
  shapes[0].data = PolyReader(source).read();
  return shapes;
}

}  // namespace dymsum::io
