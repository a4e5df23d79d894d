#include "io/region/read_wkb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "io/bytes.h"
#include "io/region/curves.h"
#include "io/region/ring_order.h"

namespace dymsum::io {

namespace {

class WkbReader {
 public:
  WkbReader(std::string_view bytes, const ReadOptions& options, NamedShape& shape)
      : bytes_(bytes), options_(options), shape_(shape) {}

  void read() try {
    read_body(read_head(), 0);
    if (left() > 0) fail(ErrorCode::malformed, std::to_string(left()) + " bytes follow the geometry");
  } catch (const CurveFailure& failure) {
    fail(failure.trouble == CurveTrouble::not_finite ? ErrorCode::not_finite : ErrorCode::malformed, text_of(failure));
  }

 private:
  /// By the numbers of OGC and ISO. The names of all, for messages, are in kNames.
  enum class Kind : std::uint32_t {
    point = 1,
    line_string,
    polygon,
    multi_point,
    multi_line_string,
    multi_polygon,
    collection,
    circular_string,
    compound_curve,
    curve_polygon,
    multi_curve,
    multi_surface,
  };
  static constexpr std::array<std::string_view, 18> kNames = {"GEOMETRY",
                                                              "POINT",
                                                              "LINESTRING",
                                                              "POLYGON",
                                                              "MULTIPOINT",
                                                              "MULTILINESTRING",
                                                              "MULTIPOLYGON",
                                                              "GEOMETRYCOLLECTION",
                                                              "CIRCULARSTRING",
                                                              "COMPOUNDCURVE",
                                                              "CURVEPOLYGON",
                                                              "MULTICURVE",
                                                              "MULTISURFACE",
                                                              "CURVE",
                                                              "SURFACE",
                                                              "POLYHEDRALSURFACE",
                                                              "TIN",
                                                              "TRIANGLE"};
  static constexpr int kMostNested = 32;
  static constexpr std::size_t kLeastGeometry = 9;  ///< bytes: its order, its kind, a count

  [[noreturn]] static void fail(ErrorCode code, std::string message) { throw WkbFailure{code, std::move(message)}; }
  static std::string name_of(Kind kind) { return std::string(kNames[static_cast<std::size_t>(kind)]); }

  std::size_t left() const { return bytes_.size() - at_; }

  template <class T>
  T take(const char* what) {
    if (left() < sizeof(T)) fail(ErrorCode::truncated, std::string("the geometry ends before ") + what);
    const T value = from_bytes<T>(bytes_, at_, order_);
    at_ += sizeof(T);
    return value;
  }

  /// A count of what takes so many bytes each, at least.
  std::size_t take_count(const char* what, std::size_t bytes_each) {
    const auto count = take<std::uint32_t>(what);
    if (count > left() / bytes_each)
      fail(ErrorCode::truncated, "the geometry announces " + std::to_string(count) + " " + what + ", and " +
                                     std::to_string(left()) + " bytes follow");
    return count;
  }

  /// The byte order, which holds up to the next head, and the kind with its ordinates.
  Kind read_head() {
    const auto order = take<std::uint8_t>("its byte order");
    if (order > 1) fail(ErrorCode::malformed, "the byte order of a geometry is 0 or 1, not " + std::to_string(order));
    order_ = order == 1 ? std::endian::little : std::endian::big;
    const auto code = take<std::uint32_t>("its type");
    const std::uint32_t more = code / 1000, kind = code % 1000;
    if (more > 3 || kind >= kNames.size())
      fail(ErrorCode::malformed, "geometries of the type " + std::to_string(code) + " are not known");
    if (kind < static_cast<std::uint32_t>(Kind::point) || kind > static_cast<std::uint32_t>(Kind::multi_surface))
      fail(ErrorCode::malformed, "a " + std::string(kNames[kind]) + " is no point, line or polygon");
    if (more > 0 && options_.third == ThirdCoordinates::refused)
      fail(ErrorCode::malformed, std::string("coordinates with ") +
                                     (more == 1   ? "Z"
                                      : more == 2 ? "M"
                                                  : "ZM") +
                                     " are not planar: only x and y can be read");
    ordinates_ = more == 0 ? 2 : more == 3 ? 4 : 3;
    return static_cast<Kind>(kind);
  }

  /// The head of a piece, which has to be one of these kinds.
  Kind read_head_among(std::initializer_list<Kind> kinds, Kind whole) {
    const Kind kind = read_head();
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      fail(ErrorCode::malformed, "a " + name_of(whole) + " holds a " + name_of(kind));
    return kind;
  }

  /// What may be NaN: so a point is written that is empty.
  Point take_position() {
    const auto x = take<double>("a coordinate"), y = take<double>("a coordinate");
    for (unsigned k = 2; k < ordinates_; ++k) take<double>("a coordinate");
    return {x, y};
  }

  Point read_point() {
    const Point point = take_position();
    if (!std::isfinite(point.x) || !std::isfinite(point.y))
      fail(ErrorCode::not_finite, "a coordinate is not a finite double");
    return point;
  }

  std::vector<Point> read_points() {
    const std::size_t count = take_count("points", std::size_t{8} * ordinates_);
    std::vector<Point> points;
    points.reserve(count);
    for (std::size_t k = 0; k < count; ++k) points.push_back(read_point());
    return points;
  }

  void read_single_point() {
    const std::size_t start = at_;
    const Point point = take_position();
    if (std::isnan(point.x) && std::isnan(point.y)) return;
    at_ = start;
    shape_.data.points.push_back(read_point());
  }

  template <class Chain>
  static void require_closed(const Chain& ring) {
    if (ring.front() != ring.back())
      fail(ErrorCode::malformed, "a ring is not closed: its last vertex differs from its first");
  }

  void read_polygon() {
    Part part;
    bool first = true;
    for (std::size_t rings = take_count("rings", 4); rings > 0; --rings) {
      Ring ring = read_points();
      if (ring.empty()) continue;  // no hole, or with none but this no polygon
      require_closed(ring);
      if (ring.size() > 1) ring.pop_back();
      (first ? part.outer : part.holes.emplace_back()) = std::move(ring);
      first = false;
    }
    if (first) return;
    orient_rings(part);
    shape_.data.parts.push_back(std::move(part));
  }

  /// The points of a CIRCULARSTRING: every other one is on an arc.
  ChordChain read_circular_string() {
    const std::vector<Point> points = read_points();
    ChordChain chain;
    if (points.empty()) return chain;
    if (points.size() < 3 || points.size() % 2 == 0)
      fail(ErrorCode::malformed,
           "a CIRCULARSTRING has an odd number of points, three or more, not " + std::to_string(points.size()));
    chain.add(points.front());
    for (std::size_t k = 2; k < points.size(); k += 2)
      append_three_point_arc(chain, points[k - 1], points[k], options_.curves);
    shape_.curves += chain.curves;
    return chain;
  }

  ChordChain read_compound_curve() {
    ChordChain whole;
    for (std::size_t pieces = take_count("pieces", kLeastGeometry); pieces > 0; --pieces) {
      const ChordChain piece =
          read_curve(read_head_among({Kind::line_string, Kind::circular_string}, Kind::compound_curve));
      if (piece.empty()) continue;
      if (!whole.empty() && whole.back() != piece.front())
        fail(ErrorCode::malformed, "a piece of a COMPOUNDCURVE does not begin where the one before ends");
      whole.append(piece);
    }
    return whole;
  }

  ChordChain read_curve(Kind kind) {
    if (kind == Kind::circular_string) return read_circular_string();
    if (kind == Kind::compound_curve) return read_compound_curve();
    ChordChain chain;
    for (const Point p : read_points()) chain.add(p);
    return chain;
  }

  void read_curve_polygon() {
    std::vector<ChordChain> rings;
    for (std::size_t left_over = take_count("rings", kLeastGeometry); left_over > 0; --left_over) {
      ChordChain ring = read_curve(
          read_head_among({Kind::line_string, Kind::circular_string, Kind::compound_curve}, Kind::curve_polygon));
      if (ring.empty()) continue;
      require_closed(ring);
      if (ring.on.size() > 1) ring.pop_back();
      rings.push_back(std::move(ring));
    }
    if (!rings.empty()) shape_.data.parts.push_back(part_of_chains(std::move(rings), options_.curves.bound));
  }

  void add_polyline(std::vector<Point> points) {
    if (!points.empty()) shape_.data.polylines.push_back(std::move(points));
  }

  void read_several(Kind whole, std::initializer_list<Kind> kinds, int depth) {
    for (std::size_t pieces = take_count("geometries", kLeastGeometry); pieces > 0; --pieces)
      read_body(read_head_among(kinds, whole), depth);
  }

  void read_collection(int depth) {
    if (depth == kMostNested)
      fail(ErrorCode::malformed, "collections nested deeper than " + std::to_string(kMostNested));
    for (std::size_t pieces = take_count("geometries", kLeastGeometry); pieces > 0; --pieces)
      read_body(read_head(), depth + 1);
  }

  /// What follows the head.
  void read_body(Kind kind, int depth) {
    switch (kind) {
      case Kind::point:
        return read_single_point();
      case Kind::line_string:
        return add_polyline(read_points());
      case Kind::polygon:
        return read_polygon();
      case Kind::multi_point:
        return read_several(kind, {Kind::point}, depth);
      case Kind::multi_line_string:
        return read_several(kind, {Kind::line_string}, depth);
      case Kind::multi_polygon:
        return read_several(kind, {Kind::polygon}, depth);
      case Kind::collection:
        return read_collection(depth);
      case Kind::circular_string:
      case Kind::compound_curve:
        return add_polyline(read_curve(kind).on);
      case Kind::curve_polygon:
        return read_curve_polygon();
      case Kind::multi_curve:
        return read_several(kind, {Kind::line_string, Kind::circular_string, Kind::compound_curve}, depth);
      case Kind::multi_surface:
        return read_several(kind, {Kind::polygon, Kind::curve_polygon}, depth);
    }
  }

  std::string_view bytes_;
  const ReadOptions& options_;
  NamedShape& shape_;
  std::size_t at_ = 0;
  std::endian order_ = std::endian::little;
  unsigned ordinates_ = 2;
};

}  // namespace

void read_wkb(std::string_view bytes, const ReadOptions& options, NamedShape& shape) {
  WkbReader(bytes, options, shape).read();
}

}  // namespace dymsum::io
