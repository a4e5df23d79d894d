#include "io/region/svg_path.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/number_text.h"
#include "io/region/svg_numbers.h"

namespace dymsum::io {

namespace {

class PathReader {
 public:
  PathReader(const Source& source, const SvgText& text) : numbers_(source, text) {}

  std::vector<Subpath> read() {
    for (numbers_.skip(); !numbers_.at_end(); numbers_.skip()) {
      const char command = numbers_.peek();
      if (!is_letter(command)) numbers_.fail("expected a path command");
      if (paths_.empty() && upper(command) != 'M') numbers_.fail("path data must start with a move, M or m");
      numbers_.advance();
      run(command);
    }
    finish();
    return std::move(paths_);
  }

 private:
  /// A command letter and the arguments that follow it, once or repeatedly.
  void run(char command) {
    if (upper(command) == 'Z') return close();
    bool first = true;
    do {
      step(command, first);
      first = false;
    } while (numbers_.at_number());
  }

  void step(char command, bool first) {
    const bool relative = command >= 'a';
    const Point base = relative ? at_ : Point{0, 0};
    switch (upper(command)) {
      case 'M':
        return first ? move_to(read_point(base)) : line_to(read_point(base));
      case 'L':
        return line_to(read_point(base));
      case 'H':
        return line_to({read_from(base.x), at_.y});
      case 'V':
        return line_to({at_.x, read_from(base.y)});
      case 'C':
        return curve(command, base, 2);
      case 'Q':
        return curve(command, base, 1);
      case 'A':
        return arc(command, base);
      case 'S':
      case 'T':
        refuse_curve(command);
      default:
        numbers_.fail_before("unknown path command " + in_quotes({&command, 1}));
    }
  }

  [[noreturn]] void refuse_curve(char command) const {
    numbers_.fail_before(std::string("the path command ") + command +
                         " draws a curve, and only straight lines can be read");
  }

  Point read_point(Point base) {
    const double x = read_from(base.x);
    return {x, read_from(base.y)};
  }

  double read_from(double base) {
    const double value = base + numbers_.read();
    if (!std::isfinite(value)) numbers_.fail_not_finite("a relative coordinate leaves the double range");
    return value;
  }

  void move_to(Point p) {
    finish();
    paths_.push_back({{p}, false});
    start_ = at_ = p;
  }

  void line_to(Point p) {
    if (paths_.back().closed) paths_.push_back({{start_}, false});
    paths_.back().vertices.push_back(p);
    at_ = p;
  }

  void close() {
    Subpath& path = paths_.back();
    path.closed = true;
    if (path.vertices.size() > 1 && path.vertices.back() == path.vertices.front()) path.vertices.pop_back();
    at_ = start_;
  }

  /// A move that nothing follows draws nothing.
  void finish() {
    if (!paths_.empty() && !paths_.back().closed && paths_.back().vertices.size() == 1) paths_.pop_back();
  }

  void curve(char command, Point base, int controls) {
    bool straight = true;
    const Point from = at_;
    Point control[2];
    for (int k = 0; k < controls; ++k) control[k] = read_point(base);
    const Point to = read_point(base);
    for (int k = 0; k < controls; ++k) straight = straight && (control[k] == from || control[k] == to);
    if (!straight) refuse_curve(command);
    line_to(to);
  }

  void arc(char command, Point base) {
    const double rx = numbers_.read(), ry = numbers_.read();
    numbers_.read();
    numbers_.read_flag();
    numbers_.read_flag();
    const Point to = read_point(base);
    if (rx != 0 && ry != 0) refuse_curve(command);
    line_to(to);
  }

  SvgNumbers numbers_;
  std::vector<Subpath> paths_;
  Point start_, at_;
};

}  // namespace

std::vector<Subpath> parse_path(const Source& source, const SvgText& text) { return PathReader(source, text).read(); }

std::vector<Point> parse_points(const Source& source, const SvgText& text) {
  SvgNumbers numbers(source, text);
  std::vector<Point> points;
  for (numbers.skip(); !numbers.at_end(); numbers.skip()) {
    const double x = numbers.read();
    points.push_back({x, numbers.read()});
  }
  return points;
}

double parse_length(const Source& source, const SvgText& text) {
  SvgNumbers numbers(source, text);
  numbers.skip();
  const double value = numbers.read();
  const std::string_view unit = numbers.rest();
  const std::size_t end = unit.find_last_not_of(" \t\r\n");
  if (end != std::string_view::npos && unit.substr(0, end + 1) != "px") {
    numbers.fail("the length '" + std::string(text.name) + "' is not a plain number");
  }
  return value;
}

}  // namespace dymsum::io
