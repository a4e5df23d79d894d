// Well-known text: geometries one after the other, usually one a line; each is a shape. Arcs become chords. Rings are
// closed in the file (the closing vertex is dropped) and oriented here, because the format leaves orientation open.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "io/region/curves.h"
#include "io/region/read_shapes.h"
#include "io/region/ring_order.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

class WktReader {
 public:
  explicit WktReader(const Source& source) : source_(source), text_(source.text) {}

  std::vector<NamedShape> read() try {
    std::vector<NamedShape> shapes;
    for (skip(); at_ < text_.size(); skip()) {
      shapes.emplace_back();
      data_ = &shapes.back().data;
      curves_ = 0;
      read_geometry(0);
      shapes.back().curves = curves_;
      take(';');  // as between statements
    }
    if (shapes.empty()) source_.fail(ErrorCode::truncated, "the file ends before the first geometry", at_);
    return shapes;
  } catch (const CurveFailure& failure) {
    source_.fail(failure.trouble == CurveTrouble::not_finite ? ErrorCode::not_finite : ErrorCode::malformed,
                 text_of(failure), at_);
  }

 private:
  static constexpr int kMostNested = 32;
  static constexpr std::size_t kLongestWord = 64;

  void skip() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  /// The rest of a word for messages, which quote less of it.
  std::string_view rest_of_word() const {
    const std::string_view rest = text_.substr(at_, kLongestWord);
    std::size_t end = 0;
    while (end < rest.size() && !is_blank(rest[end]) && rest[end] != ',' && rest[end] != ')') ++end;
    return rest.substr(0, end);
  }

  [[noreturn]] void fail_expecting(const std::string& what) const {
    if (at_ >= text_.size()) source_.fail(ErrorCode::truncated, "the file ends before " + what, at_);
    source_.fail(ErrorCode::malformed, "expected " + what + " instead of " + in_quotes(rest_of_word()), at_);
  }

  /// No further than a word that means something may reach.
  std::string read_word() {
    skip();
    std::string word;
    while (at_ < text_.size() && is_letter(text_[at_]) && word.size() < kLongestWord) word += upper(text_[at_++]);
    return word;
  }

  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void require(char c) {
    if (!take(c)) fail_expecting(std::string("'") + c + "'");
  }

  /// "(", items separated by ",", ")".
  template <class Item>
  void read_list(Item item) {
    require('(');
    do {
      item();
    } while (take(','));
    if (!take(')')) fail_expecting("',' or ')'");
  }

  /// A list, or the word EMPTY.
  template <class Item>
  void read_list_or_empty(Item item) {
    skip();
    const std::size_t start = at_;
    std::string word = read_word();
    if (announces_third(word, start)) {
      const std::size_t after = at_;
      word = read_word();
      if (word != "EMPTY") at_ = after;
    } else if (word != "EMPTY") {
      at_ = start;
    }
    if (word != "EMPTY") read_list(item);
  }

  /// Whether a word announces more than two coordinates, where these are not refused.
  bool announces_third(std::string_view word, std::size_t start) const {
    const bool announces = word == "Z" || word == "M" || word == "ZM";
    if (announces && !source_.drops_third())
      source_.fail(ErrorCode::malformed,
                   "coordinates with " + std::string(word) + " are not planar: only x and y can be read", start);
    return announces;
  }

  double read_coordinate() {
    skip();
    const ScannedNumber number = scan_number(text_.substr(at_));
    if (number.length == 0) fail_expecting("a coordinate");
    if (!std::isfinite(number.value)) {
      source_.fail(ErrorCode::not_finite, "the coordinate " + in_quotes(rest_of_word()) + " is not a finite double",
                   at_);
    }
    const std::size_t end = at_ + number.length;
    if (end < text_.size() && !is_blank(text_[end]) && text_[end] != ',' && text_[end] != ')')
      fail_expecting("a coordinate");
    at_ = end;
    return number.value;
  }

  Point read_point() {
    const double x = read_coordinate();
    const double y = read_coordinate();
    const auto ends = [&] { return at_ >= text_.size() || text_[at_] == ',' || text_[at_] == ')'; };
    skip();
    for (int more = 0; source_.drops_third() && more < 2 && !ends(); ++more) {
      read_coordinate();
      skip();
    }
    if (ends()) return {x, y};
    if (scan_number(text_.substr(at_)).length > 0)
      source_.fail(ErrorCode::malformed,
                   "a third coordinate, " + in_quotes(rest_of_word()) +
                       ": only x and y can be read, WKT with Z or M is not planar",
                   at_);
    fail_expecting("',' or ')' after two coordinates");
  }

  std::vector<Point> read_points() {
    std::vector<Point> points;
    read_list([&] { points.push_back(read_point()); });
    return points;
  }

  Ring read_ring() {
    skip();
    const std::size_t start = at_;
    Ring ring = read_points();
    if (ring.front() != ring.back())
      source_.fail(ErrorCode::malformed, "the ring is not closed: its last vertex differs from its first", start);
    if (ring.size() > 1) ring.pop_back();
    return ring;
  }

  /// The word EMPTY, which is taken then.
  bool take_empty() {
    skip();
    const std::size_t start = at_;
    if (read_word() == "EMPTY") return true;
    at_ = start;
    return false;
  }

  void read_polygon() {
    Part part;
    bool first = true;
    read_list_or_empty([&] {
      if (!first && take_empty()) return;  // no hole
      (first ? part.outer : part.holes.emplace_back()) = read_ring();
      first = false;
    });
    if (first) return;
    orient_rings(part);
    data_->parts.push_back(std::move(part));
  }

  /// A word that announces third coordinates, where these are left out.
  void take_third() {
    skip();
    const std::size_t start = at_;
    if (!announces_third(read_word(), start)) at_ = start;
  }

  /// The points of a CIRCULARSTRING: every other one is on an arc.
  ChordChain read_circular_string() {
    skip();
    const std::size_t start = at_;
    const std::vector<Point> points = read_points();
    if (points.size() < 3 || points.size() % 2 == 0)
      source_.fail(ErrorCode::malformed, "a CIRCULARSTRING has an odd number of points, three or more", start);
    ChordChain chain;
    chain.add(points.front());
    for (std::size_t k = 2; k < points.size(); k += 2)
      append_three_point_arc(chain, points[k - 1], points[k], source_.options.curves);
    curves_ += chain.curves;
    return chain;
  }

  /// A CIRCULARSTRING, a COMPOUNDCURVE, or a line with the word LINESTRING or without; nothing where it is EMPTY.
  ChordChain read_curve(int depth) {
    const std::string kind = read_kind();
    take_third();
    if (take_empty()) return {};
    if (kind == "CIRCULARSTRING") return read_circular_string();
    if (kind == "COMPOUNDCURVE" && depth == 0) return read_compound_curve();
    if (!kind.empty() && kind != "LINESTRING") fail_expecting("LINESTRING, CIRCULARSTRING or COMPOUNDCURVE");
    ChordChain chain;
    for (const Point p : read_points()) chain.add(p);
    return chain;
  }

  ChordChain read_compound_curve() {
    ChordChain whole;
    read_list([&] {
      skip();
      const std::size_t start = at_;
      const ChordChain piece = read_curve(1);
      if (piece.empty()) return;
      if (!whole.empty() && whole.back() != piece.front())
        source_.fail(ErrorCode::malformed, "a piece of a COMPOUNDCURVE does not begin where the one before ends",
                     start);
      whole.append(piece);
    });
    return whole;
  }

  void read_curve_polygon() {
    std::vector<ChordChain> rings;
    read_list_or_empty([&] {
      skip();
      const std::size_t start = at_;
      ChordChain ring = read_curve(0);
      if (ring.empty()) return;
      if (ring.front() != ring.back())
        source_.fail(ErrorCode::malformed, "the ring is not closed: its last vertex differs from its first", start);
      if (ring.on.size() > 1) ring.pop_back();
      rings.push_back(std::move(ring));
    });
    if (!rings.empty()) data_->parts.push_back(part_of_chains(std::move(rings), source_.options.curves.bound));
  }

  void add_polyline(ChordChain chain) {
    if (!chain.empty()) data_->polylines.push_back(std::move(chain.on));
  }

  /// A polygon of a MULTISURFACE.
  void read_surface() {
    const std::string kind = read_kind();
    if (kind == "CURVEPOLYGON") return read_curve_polygon();
    if (!kind.empty() && kind != "POLYGON") fail_expecting("POLYGON or CURVEPOLYGON");
    read_polygon();
  }

  /// A word that is a kind of curve or surface, with what announces third coordinates; else nothing is taken.
  std::string read_kind() {
    skip();
    const std::size_t start = at_;
    const std::string kind = without_third(read_word(), start);
    if (is_kind(kind)) return kind;
    at_ = start;
    return "";
  }

  void read_line_string() {
    std::vector<Point> points;
    read_list_or_empty([&] { points.push_back(read_point()); });
    if (!points.empty()) data_->polylines.push_back(std::move(points));
  }

  bool next_is(char c) {
    skip();
    return at_ < text_.size() && text_[at_] == c;
  }
  Point read_bracketed_point() {
    require('(');
    const Point point = read_point();
    require(')');
    return point;
  }

  void read_single_point() {
    if (next_is('(')) {
      data_->points.push_back(read_bracketed_point());
      return;
    }
    const std::size_t start = at_;
    if (announces_third(read_word(), start)) {
      if (take_empty()) return;
      data_->points.push_back(read_bracketed_point());
      return;
    }
    at_ = start;
    if (!take_empty()) fail_expecting("'(' or EMPTY");
  }

  static bool is_kind(std::string_view word) {
    static constexpr std::string_view kKinds[] = {
        "POINT",        "LINESTRING",         "POLYGON",        "MULTIPOINT",    "MULTILINESTRING", "MULTIPOLYGON",
        "CURVEPOLYGON", "GEOMETRYCOLLECTION", "CIRCULARSTRING", "COMPOUNDCURVE", "MULTICURVE",      "MULTISURFACE"};
    return std::find(std::begin(kKinds), std::end(kKinds), word) != std::end(kKinds);
  }

  /// POLYGONZ is POLYGON Z.
  std::string without_third(std::string kind, std::size_t start) const {
    for (const std::string_view third : {"ZM", "Z", "M"})
      if (kind.ends_with(third) && is_kind(kind.substr(0, kind.size() - third.size())) && announces_third(third, start))
        kind.resize(kind.size() - third.size());
    return kind;
  }

  void read_geometry(int depth) {
    skip();
    const std::size_t start = at_;
    if (depth > kMostNested)
      source_.fail(ErrorCode::malformed, "collections nested deeper than " + std::to_string(kMostNested), start);
    const std::string kind = without_third(read_word(), start);
    if (kind == "POINT") {
      read_single_point();
    } else if (kind == "LINESTRING") {
      read_line_string();
    } else if (kind == "POLYGON") {
      read_polygon();
    } else if (kind == "MULTIPOINT") {
      read_list_or_empty([&] {
        skip();
        if (at_ < text_.size() && (text_[at_] == '(' || upper(text_[at_]) == 'E')) return read_single_point();
        data_->points.push_back(read_point());
      });
    } else if (kind == "CIRCULARSTRING" || kind == "COMPOUNDCURVE") {
      take_third();
      if (take_empty()) return;
      add_polyline(kind == "CIRCULARSTRING" ? read_circular_string() : read_compound_curve());
    } else if (kind == "CURVEPOLYGON") {
      read_curve_polygon();
    } else if (kind == "MULTICURVE") {
      read_list_or_empty([&] { add_polyline(read_curve(0)); });
    } else if (kind == "MULTISURFACE") {
      read_list_or_empty([&] { read_surface(); });
    } else if (kind == "MULTILINESTRING") {
      read_list_or_empty([&] { read_line_string(); });
    } else if (kind == "MULTIPOLYGON") {
      read_list_or_empty([&] { read_polygon(); });
    } else if (kind == "GEOMETRYCOLLECTION") {
      read_list_or_empty([&] { read_geometry(depth + 1); });
    } else {
      at_ = start;
      fail_expecting("a geometry such as POLYGON");
    }
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
  RegionData* data_ = nullptr;
  std::size_t curves_ = 0;
};

}  // namespace

std::vector<NamedShape> read_wkt(const Source& source) { return WktReader(source).read(); }

}  // namespace dymsum::io
