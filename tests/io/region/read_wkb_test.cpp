// WKB against WKT, which another reader reads: random geometries of every kind, in both byte orders, with Z and M.
#include "io/region/read_wkb.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>

#include "io/reading.h"
#include "io/source.h"
#include "oracles/coordinate_kinds.h"

namespace dymsum::io_test {
namespace {

/// Writes numbers in a byte order.
class WkbBytes {
 public:
  WkbBytes& order(std::endian order) {
    order_ = order;
    return bits(order == std::endian::little ? 1 : 0, 1);
  }
  WkbBytes& count(std::uint32_t value) { return bits(value, 4); }
  WkbBytes& number(double value) { return bits(std::bit_cast<std::uint64_t>(value), 8); }
  /// The head of a geometry.
  WkbBytes& head(std::uint32_t type, std::endian of = std::endian::little) { return order(of).count(type); }
  WkbBytes& points(const std::vector<double>& numbers) {
    for (const double value : numbers) number(value);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  WkbBytes& bits(std::uint64_t value, unsigned bytes) {
    for (unsigned k = 0; k < bytes; ++k)
      text_ += static_cast<char>(value >> (8 * (order_ == std::endian::little ? k : bytes - 1 - k)) & 0xff);
    return *this;
  }

  std::endian order_ = std::endian::little;
  std::string text_;
};

/// The same geometry as WKT and as WKB, every piece in a byte order of its own.
class RandomGeometry {
 public:
  RandomGeometry(std::uint64_t seed, CoordinateKind kind, unsigned more)
      : random_(seed),
        kind_(kind),
        more_(more),
        suffix_(more == 0   ? ""
                : more == 1 ? " Z"
                : more == 2 ? " M"
                            : " ZM") {}

  void make() { geometry(1 + below(12), 0); }
  std::string wkt;
  WkbBytes wkb;

 private:
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }

  /// Of a piece, which WKT does not name.
  void nameless_head(std::uint32_t type) {
    wkb.head(type + 1000 * more_, below(2) == 0 ? std::endian::little : std::endian::big);
  }
  void head(std::uint32_t type, const char* name) {
    nameless_head(type);
    wkt += name + suffix_;
  }

  Point position(int x, int y) {
    const Point3 at = of_kind(Point3{double(x), double(y), 0}, kind_, random_);
    return {at.x, at.y};
  }
  void write(Point p) {
    wkb.number(p.x).number(p.y);
    io::append_number(wkt, p.x);
    wkt += ' ';
    io::append_number(wkt, p.y);
    for (unsigned k = 0; k < (more_ == 3 ? 2 : more_ > 0 ? 1 : 0); ++k) {
      wkb.number(double(k) + 0.5);
      wkt += k == 0 ? " 0.5" : " 1.5";
    }
  }
  /// A list of `count` of what `write_one` writes, with its count; with none EMPTY.
  template <class WriteOne>
  void list(std::uint32_t count, WriteOne write_one) {
    wkb.count(count);
    wkt += count == 0 ? " EMPTY" : " (";
    for (std::uint32_t k = 0; k < count; ++k) {
      if (k > 0) wkt += ", ";
      write_one(k);
    }
    if (count > 0) wkt += ')';
  }
  void chain(const std::vector<Point>& points) {
    list(static_cast<std::uint32_t>(points.size()), [&](std::uint32_t k) { write(points[k]); });
  }

  std::vector<Point> some_points(std::uint32_t count) {
    std::vector<Point> points;
    for (; count > 0; --count) points.push_back(position(int(below(20)) - 10, int(below(20)) - 10));
    return points;
  }
  std::vector<Point> ring() {
    std::vector<Point> points = some_points(3 + below(4));
    points.push_back(points.front());
    return points;
  }
  void polygon() {
    list(below(4), [&](std::uint32_t) { chain(ring()); });
  }
  void lines() { chain(some_points(below(3) == 0 ? 0 : 2 + below(4))); }

  /// A curve of the kind, from `from` and back to it where it is a ring.
  void arcs(Point from, Point to) {
    const std::vector<Point> between = some_points(1);
    head(8, "CIRCULARSTRING");
    chain({from, between[0], to});
  }
  void compound(Point from, Point to) {
    head(9, "COMPOUNDCURVE");
    const Point via = some_points(1)[0];
    list(2, [&](std::uint32_t k) {
      if (k == 0) return arcs(from, via);
      head(2, "LINESTRING");
      chain({via, to});
    });
  }
  void curve(bool closed) {
    const std::vector<Point> ends = some_points(2);
    const Point to = closed ? ends[0] : ends[1];
    if (below(3) == 0) return arcs(ends[0], to);
    if (below(2) == 0) return compound(ends[0], to);
    head(2, "LINESTRING");
    closed ? chain(ring()) : chain(ends);
  }
  void curve_polygon() {
    list(1 + below(2), [&](std::uint32_t) { curve(true); });
  }
  void bracketed_point() {
    wkt += " (";
    write(some_points(1)[0]);
    wkt += ')';
  }
  void one_point() {
    head(1, "POINT");
    bracketed_point();
  }

  void geometry(std::uint32_t type, int depth) {
    static constexpr std::array kNames = {"",
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
                                          "MULTISURFACE"};
    const std::vector<Point> ends = some_points(2);
    if (type == 1) return one_point();
    if (type == 8) return arcs(ends[0], ends[1]);
    if (type == 9) return compound(ends[0], ends[1]);
    head(type, kNames[type]);
    if (type == 2) return lines();
    if (type == 3) return polygon();
    if (type == 10) return curve_polygon();
    list(below(4), [&](std::uint32_t) {
      if (type == 7) {
        if (depth < 3) return geometry(1 + below(12), depth + 1);
        return one_point();
      }
      if (type == 11) return curve(false);
      if (type == 12 && below(2) == 0) {
        head(10, "CURVEPOLYGON");
        return curve_polygon();
      }
      nameless_head(type == 12 ? 3 : type - 3);
      if (type == 4) bracketed_point();
      if (type == 5) lines();
      if (type == 6 || type == 12) polygon();
    });
  }

  std::mt19937_64 random_;
  CoordinateKind kind_;
  unsigned more_;
  std::string suffix_;
};

const ReadOptions kDropped{ThirdCoordinates::dropped, {}};

TEST(ReadWkb, random_geometries_of_every_kind_are_those_of_wkt) {
  std::size_t curves = 0, parts = 0, lines = 0, points = 0, failures = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const auto more = static_cast<unsigned>(seed % 4);
      RandomGeometry made(seed, kind, more);
      made.make();
      const std::string what = name_of(kind) + ", seed " + std::to_string(seed) + ": " + made.wkt.substr(0, 2000);
      const auto expected = parse_shapes(made.wkt, RegionFormat::wkt, "wkt", kDropped);
      NamedShape shape;
      bool read = true;
      try {
        io::read_wkb(made.wkb.text(), kDropped, shape);
      } catch (const io::WkbFailure& failure) {
        read = false;
        ++failures;
        ASSERT_FALSE(expected.ok()) << what << "\n" << failure.message;
        ASSERT_EQ(name(failure.code), name(expected.error().code)) << what;
      }
      if (!read) continue;
      ASSERT_TRUE(expected.ok()) << what << "\n" << expected.error().to_string();
      ASSERT_EQ(shape.data, expected->at(0).data) << what;
      ASSERT_EQ(shape.curves, expected->at(0).curves) << what;
      curves += shape.curves;
      parts += shape.data.parts.size();
      lines += shape.data.polylines.size();
      points += shape.data.points.size();
    }
  EXPECT_GT(curves, 500u);
  EXPECT_GT(parts, 500u);
  EXPECT_GT(lines, 500u);
  EXPECT_GT(points, 300u);
  EXPECT_LT(failures, 100u);
}

void expect_refused_wkb(const std::string& bytes, ErrorCode code, std::string_view words,
                        const ReadOptions& options = {}) {
  NamedShape shape;
  try {
    io::read_wkb(bytes, options, shape);
    ADD_FAILURE() << "accepted; expected: " << words;
  } catch (const io::WkbFailure& failure) {
    EXPECT_EQ(name(failure.code), name(code)) << failure.message;
    EXPECT_NE(failure.message.find(words), std::string::npos) << failure.message;
  }
}

TEST(ReadWkb, what_is_wrong_is_named) {
  const std::vector<double> triangle{0, 0, 1, 0, 0, 1, 0, 0};
  const auto bad = [](const WkbBytes& bytes, ErrorCode code, std::string_view words) {
    expect_refused_wkb(bytes.text(), code, words);
  };
  bad(WkbBytes(), ErrorCode::truncated, "ends before its byte order");
  expect_refused_wkb("\x07", ErrorCode::malformed, "0 or 1, not 7");
  expect_refused_wkb("\x01\x03", ErrorCode::truncated, "ends before its type");
  for (const std::uint32_t type : {18U, 999U, 4001U, 0x80000003U})
    bad(WkbBytes().head(type), ErrorCode::malformed, "type " + std::to_string(type) + " are not known");
  bad(WkbBytes().head(0), ErrorCode::malformed, "a GEOMETRY is no point");
  bad(WkbBytes().head(16), ErrorCode::malformed, "a TIN is no point, line or polygon");
  bad(WkbBytes().head(1015), ErrorCode::malformed, "POLYHEDRALSURFACE");
  bad(WkbBytes().head(1001).points({1, 2, 3}), ErrorCode::malformed, "coordinates with Z are not planar");
  bad(WkbBytes().head(2003), ErrorCode::malformed, "coordinates with M are");
  bad(WkbBytes().head(3003), ErrorCode::malformed, "coordinates with ZM are");
  bad(WkbBytes().head(2).count(0xffffffff), ErrorCode::truncated, "announces 4294967295 points, and 0 bytes follow");
  bad(WkbBytes().head(2).count(2).points({0, 0, 1}), ErrorCode::truncated, "announces 2 points, and 24 bytes follow");
  bad(WkbBytes().head(3).count(0x10000000), ErrorCode::truncated, "rings");
  bad(WkbBytes().head(7).count(1), ErrorCode::truncated, "announces 1 geometries");
  bad(WkbBytes().head(1).points({1}), ErrorCode::truncated, "ends before a coordinate");
  bad(WkbBytes().head(3).count(1).count(3).points({0, 0, 1, 0, 0, 1}), ErrorCode::malformed, "a ring is not closed");
  bad(WkbBytes().head(6).count(1).head(2).count(0), ErrorCode::malformed, "a MULTIPOLYGON holds a LINESTRING");
  bad(WkbBytes().head(4).count(1).head(7).count(0).count(0).count(0), ErrorCode::malformed,
      "a MULTIPOINT holds a GEOMETRYCOLLECTION");
  bad(WkbBytes().head(8).count(2).points({0, 0, 1, 0}), ErrorCode::malformed, "odd number of points");
  bad(WkbBytes().head(9).count(2).head(2).count(2).points({0, 0, 1, 0}).head(2).count(2).points({2, 0, 3, 0}),
      ErrorCode::malformed, "does not begin where the one before ends");
  bad(WkbBytes().head(3).count(1).count(4).points(triangle).count(0), ErrorCode::malformed,
      "4 bytes follow the geometry");
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
  bad(WkbBytes().head(1).points({infinite, 0}), ErrorCode::not_finite, "not a finite double");
  bad(WkbBytes().head(1).points({0, nan}), ErrorCode::not_finite, "not a finite double");
  bad(WkbBytes().head(2).count(2).points({0, 0, nan, nan}), ErrorCode::not_finite, "not a finite double");
}

TEST(ReadWkb, collections_are_nested_so_deep_and_no_deeper) {
  for (const int depth : {32, 33, 20000}) {
    WkbBytes bytes;
    for (int k = 0; k < depth; ++k) bytes.head(7).count(1);
    bytes.head(1).points({1, 2});
    if (depth > 32) {
      expect_refused_wkb(bytes.text(), ErrorCode::malformed, "nested deeper than 32");
      continue;
    }
    NamedShape shape;
    io::read_wkb(bytes.text(), {}, shape);
    EXPECT_EQ(shape.data, (RegionData{{}, {}, {{1, 2}}}));
  }
}

TEST(ReadWkb, nothing_is_empty) {
  const double nan = std::nan("");
  for (const WkbBytes& bytes :
       {WkbBytes().head(1).points({nan, nan}), WkbBytes().head(2).count(0), WkbBytes().head(3).count(0),
        WkbBytes().head(3).count(1).count(0), WkbBytes().head(6).count(0), WkbBytes().head(7).count(0),
        WkbBytes().head(8).count(0), WkbBytes().head(10).count(0)}) {
    NamedShape shape;
    io::read_wkb(bytes.text(), {}, shape);
    EXPECT_EQ(shape.data, RegionData{});
  }
}

TEST(ReadWkb, beginnings_are_refused_and_damage_never_crashes) {
  std::mt19937_64 random(7);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomGeometry made(seed, CoordinateKind::decimals, static_cast<unsigned>(seed % 4));
    made.make();
    const std::string& whole = made.wkb.text();
    for (std::size_t length = 0; length < whole.size(); ++length) {
      NamedShape shape;
      EXPECT_THROW(io::read_wkb(std::string_view(whole).substr(0, length), kDropped, shape), io::WkbFailure) << length;
    }
    for (int k = 0; k < 200; ++k) {
      std::string bytes = whole;
      for (int changes = 1 + int(random() % 3); changes > 0; --changes)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      NamedShape shape;
      try {
        io::read_wkb(bytes, {}, shape);
      } catch (const io::WkbFailure& failure) {
        EXPECT_FALSE(failure.message.empty());
      }
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
