#include "io/region/svg_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "io/number_text.h"
#include "io/region/dxf_arc.h"
#include "io/region/svg_numbers.h"

namespace dymsum::io {

namespace {

class PathReader {
 public:
  PathReader(const Source& source, const SvgText& text, const PlaneTransform& placement)
      : numbers_(source, text), options_(source.options.curves), placement_(placement) {}

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
        return cubic(read_point(base), base);
      case 'S':
        return cubic(mirrored('C'), base);
      case 'Q':
        return quadratic(read_point(base), base);
      case 'T':
        return quadratic(mirrored('Q'), base);
      case 'A':
        return arc(base);
      default:
        numbers_.fail_before("unknown path command " + in_quotes({&command, 1}));
    }
  }

  /// The first control point of a curve that goes on smoothly from one of that kind; else the point where it begins.
  Point mirrored(char kind) const {
    return curve_ == kind ? Point{2 * at_.x - control_.x, 2 * at_.y - control_.y} : at_;
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
    start_ = p;
    start_chain();
    move(p);
  }

  void start_chain() {
    paths_.emplace_back();
    paths_.back().chain.add(placement_.apply(start_));
  }

  /// What is drawn next goes on from p, and no curve ends there.
  void move(Point p) {
    at_ = p;
    curve_ = 0;
  }

  ChordChain& open_chain() {
    if (paths_.back().closed) start_chain();
    return paths_.back().chain;
  }

  void line_to(Point p) {
    open_chain().add(placement_.apply(p));
    move(p);
  }

  void close() {
    Subpath& path = paths_.back();
    path.closed = true;
    if (path.chain.on.size() > 1 && path.chain.back() == path.chain.front()) path.chain.pop_back();
    move(start_);
  }

  /// A move that nothing follows draws nothing.
  void finish() {
    if (!paths_.empty() && !paths_.back().closed && paths_.back().chain.on.size() == 1) paths_.pop_back();
  }

  void cubic(Point first, Point base) {
    const Point second = read_point(base), to = read_point(base);
    bezier({at_, first, second, to});
    control_ = second;
    curve_ = 'C';
  }

  void quadratic(Point control, Point base) {
    const Point to = read_point(base);
    bezier({at_, control, to});
    control_ = control;
    curve_ = 'Q';
  }

  /// Straight where its control points are its ends.
  void bezier(std::vector<Point> points) {
    const Point from = points.front(), to = points.back();
    const bool straight = std::all_of(points.begin(), points.end(), [&](Point p) { return p == from || p == to; });
    if (straight) return line_to(to);
    for (Point& p : points) p = placement_.apply(p);
    append_bezier(open_chain(), {std::move(points), {}}, options_);
    move(to);
  }

  void arc(Point base) {
    const double rx = std::abs(numbers_.read()), ry = std::abs(numbers_.read()), degrees = numbers_.read();
    const bool large = numbers_.read_flag(), counter_clockwise = numbers_.read_flag();
    const Point from = at_, to = read_point(base);
    if (from == to) return;
    if (rx == 0 || ry == 0) return line_to(to);
    EllipseArc arc = arc_between(from, to, {rx, ry}, direction(degrees), large == counter_clockwise, counter_clockwise);
    arc = {placement_.apply(from), placement_.apply_vector(arc.u), placement_.apply_vector(arc.v), arc.sweep};
    append_arc(open_chain(), arc, placement_.apply(to), options_);
    move(to);
  }

  /// As SVG says: of the two ellipses with these half axes, the first of them in the direction `axis`, through both
  /// points one of four arcs; where they are too small they grow. Where one is, in coordinates in which it is the unit
  /// circle, its centre lies on the bisector of the chord, on the right of it where `right`.
  static EllipseArc arc_between(Point from, Point to, Point radii, Point axis, bool right, bool counter_clockwise) {
    const auto flat = [&](Point p) {
      return Point{(axis.x * p.x + axis.y * p.y) / radii.x, (axis.x * p.y - axis.y * p.x) / radii.y};
    };
    const Point chord = flat({to.x - from.x, to.y - from.y});
    const double half = std::hypot(chord.x, chord.y) / 2;
    // Of the chord's length, how far the centre is from its midpoint.
    const double off = half < 1 ? std::sqrt((1 - half) * (1 + half)) / (2 * half) * (right ? -1 : 1) : 0;
    const Point centre{chord.x / 2 - chord.y * off, chord.y / 2 + chord.x * off};  // seen from `from`
    const Point u{-centre.x, -centre.y}, last{chord.x - centre.x, chord.y - centre.y};
    double sweep = std::atan2(u.x * last.y - u.y * last.x, u.x * last.x + u.y * last.y);
    if (counter_clockwise && sweep < 0) sweep += 2 * std::numbers::pi;
    if (!counter_clockwise && sweep > 0) sweep -= 2 * std::numbers::pi;
    const auto back = [&](Point p) {
      const double x = p.x * radii.x, y = p.y * radii.y;
      return Point{axis.x * x - axis.y * y, axis.y * x + axis.x * y};
    };
    return {from, back(u), back({-u.y, u.x}), sweep};
  }

  SvgNumbers numbers_;
  const CurveOptions& options_;
  const PlaneTransform& placement_;
  std::vector<Subpath> paths_;
  Point start_, at_;
  Point control_;   ///< the last one of the curve that ends where this goes on
  char curve_ = 0;  ///< its kind: C, Q, or none
};

}  // namespace

std::vector<Subpath> parse_path(const Source& source, const SvgText& text, const PlaneTransform& placement) {
  return PathReader(source, text, placement).read();
}

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
