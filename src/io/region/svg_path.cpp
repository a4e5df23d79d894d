#include "io/region/svg_path.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/region/curves.h"
#include "io/source.h"

namespace dymsum::io {
namespace {

// Numbers in SVG attributes: separated by blanks, a comma, or nothing where a sign or second decimal point starts the
// next.

class SvgNumbers {
 public:
  SvgNumbers(const Source& source, const SvgText& text) : source_(source), text_(text) {}

  void skip();  ///< blanks and commas
  bool at_end() const { return at_ >= text_.value.size(); }
  char peek() const { return text_.value[at_]; }
  void advance() { ++at_; }
  bool at_number();  ///< after blanks and commas
  double read();     ///< failures: malformed, not_finite
  bool read_flag();  ///< 0 or 1, which needs no separator
  std::string_view rest() const { return text_.value.substr(at_ < text_.value.size() ? at_ : text_.value.size()); }

  [[noreturn]] void fail(const std::string& message) const;         ///< malformed, showing what stands here
  [[noreturn]] void fail_before(const std::string& message) const;  ///< malformed, message only
  [[noreturn]] void fail_not_finite(const std::string& message) const;

 private:
  std::int64_t line() const;

  const Source& source_;
  SvgText text_;
  std::size_t at_ = 0;
};

std::string_view one_word(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\n,")); }

/// The offset at which a start tag's attribute value begins, counted from the tag's name; 0 when it is not found.
std::size_t offset_of_value(std::string_view tag, std::string_view name) {
  for (std::size_t i = 0; i < tag.size() && tag[i] != '>';) {
    const std::size_t equals = tag.find('=', i);
    const std::size_t open = equals == std::string_view::npos ? equals : tag.find_first_of("\"'", equals);
    if (open == std::string_view::npos) return 0;
    std::size_t end = equals;
    while (end > i && is_blank(tag[end - 1])) --end;
    const std::string_view before = tag.substr(i, end - i);
    const std::size_t start = before.size() - name.size();
    if (before.ends_with(name) && (start == 0 || is_blank(before[start - 1]))) return open + 1;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) return 0;
    i = close + 1;
  }
  return 0;
}

void SvgNumbers::skip() {
  while (!at_end() && (is_blank(peek()) || peek() == ',')) ++at_;
}

bool SvgNumbers::at_number() {
  skip();
  return !at_end() && (is_digit(peek()) || peek() == '-' || peek() == '+' || peek() == '.');
}

double SvgNumbers::read() {
  skip();
  const ScannedNumber number = scan_number(rest());
  if (number.length == 0) fail("expected a number");
  if (!std::isfinite(number.value)) {
    fail_not_finite("the number " + in_quotes(one_word(rest())) + " is not a finite double");
  }
  at_ += number.length;
  return number.value;
}

bool SvgNumbers::read_flag() {
  skip();
  if (at_end() || (peek() != '0' && peek() != '1')) fail("expected a flag, 0 or 1");
  return text_.value[at_++] == '1';
}

void SvgNumbers::fail(const std::string& message) const {
  source_.fail_on_line(ErrorCode::malformed,
                       at_end() ? message + ", but the attribute ends" : message + " at " + in_quotes(one_word(rest())),
                       line());
}

void SvgNumbers::fail_before(const std::string& message) const {
  source_.fail_on_line(ErrorCode::malformed, message, line());
}

void SvgNumbers::fail_not_finite(const std::string& message) const {
  source_.fail_on_line(ErrorCode::not_finite, message, line());
}

std::int64_t SvgNumbers::line() const {
  const auto end = text_.value.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.value.size()));
  const std::size_t start = text_.tag + offset_of_value(source_.text.substr(text_.tag), text_.name);
  return source_.line(start) + std::count(text_.value.begin(), end, '\n');
}

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

namespace {

/// A rotation about a point; exact for multiples of 90 degrees.
PlaneTransform rotation(double degrees, Point about) {
  const Point d = direction(degrees);
  const PlaneTransform rotated{d.x, d.y, -d.y, d.x, 0, 0};
  return PlaneTransform{1, 0, 0, 1, about.x, about.y}.after(rotated).after({1, 0, 0, 1, -about.x, -about.y});
}

double tangent(double degrees) {
  const Point d = direction(degrees);
  return d.y / d.x;
}

PlaneTransform make_transform(const SvgNumbers& numbers, const std::string& name, const std::vector<double>& v) {
  if (name == "translate" && (v.size() == 1 || v.size() == 2)) return {1, 0, 0, 1, v[0], v.size() == 2 ? v[1] : 0};
  if (name == "scale" && (v.size() == 1 || v.size() == 2)) return {v[0], 0, 0, v.back(), 0, 0};
  if (name == "matrix" && v.size() == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "rotate" && (v.size() == 1 || v.size() == 3))
    return rotation(v[0], v.size() == 3 ? Point{v[1], v[2]} : Point{});
  if (name == "skewX" && v.size() == 1) return {1, 0, tangent(v[0]), 1, 0, 0};
  if (name == "skewY" && v.size() == 1) return {1, tangent(v[0]), 0, 1, 0, 0};
  for (const char* known : {"translate", "scale", "matrix", "rotate", "skewX", "skewY"})
    if (name == known) numbers.fail_before("the transform " + name + " has " + std::to_string(v.size()) + " arguments");
  numbers.fail_before("the transform " + in_quotes(name) +
                      " is none of translate, scale, rotate, skewX, skewY, matrix");
}

}  // namespace

PlaneTransform parse_transform(const Source& source, const SvgText& text) {
  SvgNumbers numbers(source, text);
  PlaneTransform whole;
  for (numbers.skip(); !numbers.at_end(); numbers.skip()) {
    std::string name;
    while (!numbers.at_end() && is_letter(numbers.peek())) {
      name += numbers.peek();
      numbers.advance();
    }
    numbers.skip();
    if (name.empty() || numbers.at_end() || numbers.peek() != '(')
      numbers.fail("expected a transform such as translate(x, y)");
    numbers.advance();
    std::vector<double> values;
    while (numbers.at_number()) values.push_back(numbers.read());
    if (numbers.at_end() || numbers.peek() != ')') numbers.fail("expected ')'");
    numbers.advance();
    whole = whole.after(make_transform(numbers, name, values));
  }
  return whole;
}

// Nested svg elements: where their content goes; and whether an element is drawn at all.

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Names of properties may be in capitals.
bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The fraction of the free space that lies before the content: 0, 1/2 or 1.
double fraction(std::string_view align, std::string_view axis) {
  if (align.find(std::string(axis) + "Min") != std::string_view::npos) return 0;
  return align.find(std::string(axis) + "Max") != std::string_view::npos ? 1 : 0.5;
}

}  // namespace

PlaneTransform parse_view_box(const Source& source, const SvgText& text, const SvgViewport& viewport,
                              std::string_view preserve_aspect_ratio) {
  SvgNumbers numbers(source, text);
  std::array<double, 4> box{};
  for (double& v : box) {
    if (!numbers.at_number()) numbers.fail("expected four numbers");
    v = numbers.read();
  }
  numbers.skip();
  if (!numbers.at_end()) numbers.fail("expected four numbers");
  const auto [x, y, width, height] = box;
  if (!(width > 0 && height > 0 && viewport.width > 0 && viewport.height > 0))
    numbers.fail_before("a viewBox and its element need a positive width and height");
  if (preserve_aspect_ratio.find("slice") != std::string_view::npos)
    numbers.fail_before("preserveAspectRatio with slice cuts off what is drawn, and that cannot be read");
  double sx = viewport.width / width, sy = viewport.height / height;
  if (preserve_aspect_ratio.find("none") == std::string_view::npos) sx = sy = std::min(sx, sy);
  const double left = viewport.x + fraction(preserve_aspect_ratio, "x") * (viewport.width - sx * width);
  const double top = viewport.y + fraction(preserve_aspect_ratio, "Y") * (viewport.height - sy * height);
  return {sx, 0, 0, sy, left - sx * x, top - sy * y};
}

std::string_view svg_property(std::string_view style, std::string_view name, std::string_view attribute) {
  std::string_view value = trimmed(attribute);
  // The last of several declarations counts.
  while (!style.empty()) {
    const std::size_t end = std::min(style.find(';'), style.size());
    const std::string_view declaration = style.substr(0, end);
    const std::size_t colon = declaration.find(':');
    if (colon != std::string_view::npos && same_name(trimmed(declaration.substr(0, colon)), name)) {
      value = trimmed(declaration.substr(colon + 1));
      if (const std::size_t important = value.find('!'); important != std::string_view::npos)
        value = trimmed(value.substr(0, important));
    }
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return value;
}

}  // namespace dymsum::io
