// Curves of files as chords: within the error that was asked for, and on the side. Distances are compared exactly, as
// fractions; what a curve is meant to be is known: circles by their equations, Bezier curves at fractions of the
// parameter.
#include <algorithm>
#include <cmath>
#include <random>

#include "dymsum/rational.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

Rational exact(double x) { return Rational::of(x).value(); }
RationalPoint exact(Point p) { return {exact(p.x), exact(p.y)}; }
RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) { return {a.x - b.x, a.y - b.y}; }
Rational dot(const RationalPoint& a, const RationalPoint& b) { return a.x * b.x + a.y * b.y; }
Rational cross(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }

/// The square of the distance to a segment.
Rational squared_distance(const RationalPoint& p, const RationalPoint& a, const RationalPoint& b) {
  const RationalPoint d = b - a, w = p - a;
  const Rational along = dot(w, d), whole = dot(d, d);
  if (along <= Rational(0)) return dot(w, w);
  if (along >= whole) return dot(p - b, p - b);
  const Rational off = cross(d, w);
  return off * off / whole;
}

Rational squared_distance(const RationalPoint& p, const std::vector<Point>& chain) {
  Rational least = dot(p - exact(chain[0]), p - exact(chain[0]));
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const Rational one = squared_distance(p, exact(chain[k]), exact(chain[k + 1]));
    if (one < least) least = one;
  }
  return least;
}

RegionData read(const std::string& text, RegionFormat format, double error, CurveBound bound) {
  const auto shapes = parse_shapes(text, format, "test", {ThirdCoordinates::refused, {error, bound}});
  if (!shapes) ADD_FAILURE() << shapes.error().to_string();
  return shapes ? shapes->at(0).data : RegionData{};
}

std::string svg_of(const std::string& elements) { return "<svg>" + elements + "</svg>"; }

/// Rounding of vertices: a few units in the last place of coordinates up to 16.
const Rational kRounding = exact(0x1p-46);

// The ring of a circle about the origin, its edges on the side of `bound`: the squares of the nearest and the furthest
// distance of an edge from the centre are at its foot, and at its ends.
void expect_circle(Ring ring, double radius, double error, CurveBound bound) {
  ring.push_back(ring.front());
  const Rational r = exact(radius), e = exact(error);
  const Rational least = bound == CurveBound::outside ? r - kRounding : r - e - kRounding;
  const Rational most = bound == CurveBound::outside ? r + e + kRounding : r + kRounding;
  const RationalPoint origin{Rational(0), Rational(0)};
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const RationalPoint a = exact(ring[k]), b = exact(ring[k + 1]);
    EXPECT_GE(squared_distance(origin, a, b), least * least) << k;
    EXPECT_LE(dot(a, a), most * most) << k;
  }
}

TEST(Curves, circles_are_within_the_error_on_the_side_of_the_bound) {
  for (const double error : {1.0, 0.1, 1e-3, 1e-5})
    for (const CurveBound bound : {CurveBound::nearest, CurveBound::inside, CurveBound::outside}) {
      const RegionData drawn = read(svg_of("<circle r='3'/>"), RegionFormat::svg, error, bound);
      expect_circle(drawn.parts.at(0).outer, 3, error, bound);
      EXPECT_TRUE(Region::create(drawn).ok());
      const std::string dxf = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n0\n20\n0\n40\n3\n0\nENDSEC\n0\nEOF\n";
      EXPECT_EQ(read(dxf, RegionFormat::dxf, error, bound), drawn);
      const RegionData wkt = read("CURVEPOLYGON (CIRCULARSTRING (3 0, -3 0, 3 0))", RegionFormat::wkt, error, bound);
      expect_circle(wkt.parts.at(0).outer, 3, error, bound);
    }
}

// A hole is bound on its other side: what is inside of the region is outside of the hole.
TEST(Curves, holes_are_bound_on_their_other_side) {
  const std::string path = "<path fill-rule='evenodd' d='M-9 -9H9V9H-9Z M2 0 A2 2 0 0 1 -2 0 A2 2 0 0 1 2 0Z'/>";
  for (const auto& [bound, of_hole] :
       {std::pair{CurveBound::inside, CurveBound::outside}, std::pair{CurveBound::outside, CurveBound::inside}}) {
    const RegionData drawn = read(svg_of(path), RegionFormat::svg, 0.01, bound);
    ASSERT_EQ(drawn.parts.at(0).holes.size(), 1u);
    expect_circle(drawn.parts[0].holes[0], 2, 0.01, of_hole);
    EXPECT_TRUE(Region::create(drawn).ok());
  }
}

// The ellipse (x / 4)^2 + y^2 = 1, turned by a quarter: vertices on it, and chords within the error of its largest
// axis.
TEST(Curves, ellipses_lie_on_their_equation) {
  for (const CurveBound bound : {CurveBound::nearest, CurveBound::inside, CurveBound::outside}) {
    const RegionData drawn =
        read(svg_of("<g transform='rotate(90)'><ellipse rx='4' ry='1'/></g>"), RegionFormat::svg, 1e-4, bound);
    for (const Point p : drawn.parts.at(0).outer) {
      const Rational value = exact(p.y) * exact(p.y) / Rational(16) + exact(p.x) * exact(p.x) - Rational(1);
      EXPECT_GE(value, -kRounding);
      if (bound != CurveBound::outside) {
        EXPECT_LE(value, kRounding);
      }
    }
  }
}

RationalPoint bezier(const std::vector<Point>& control, const Rational& t) {
  std::vector<RationalPoint> points;
  for (const Point p : control) points.push_back(exact(p));
  for (; points.size() > 1; points.pop_back())
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      points[k] = {points[k].x + t * (points[k + 1].x - points[k].x),
                   points[k].y + t * (points[k + 1].y - points[k].y)};
  return points[0];
}

// At 33 parameters the curve is within the error of the chords; and every vertex, of all versions, of the curve: it is
// near one of 4096 of its points, which are nearer to each other than 2^-8.
TEST(Curves, bezier_curves_are_within_the_error) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-8, 8);
  for (int round = 0; round < 6; ++round) {
    std::vector<Point> control(round % 2 == 0 ? 4 : 3);
    for (Point& p : control) p = {coordinate(random), coordinate(random)};
    std::string d = "M" + std::to_string(control[0].x) + " " + std::to_string(control[0].y);
    d += control.size() == 4 ? " C" : " Q";
    for (std::size_t k = 1; k < control.size(); ++k)
      d += std::to_string(control[k].x) + " " + std::to_string(control[k].y) + " ";
    for (Point& p : control) p = {std::stod(std::to_string(p.x)), std::stod(std::to_string(p.y))};
    const double error = round < 3 ? 0.05 : 1e-4;
    const Polyline chain =
        read(svg_of("<path d='" + d + "'/>"), RegionFormat::svg, error, CurveBound::nearest).polylines.at(0);
    EXPECT_EQ(chain.front(), control.front());
    EXPECT_EQ(chain.back(), control.back());
    for (int k = 0; k <= 32; ++k) {
      const Rational most = exact(error) + kRounding;
      EXPECT_LE(squared_distance(bezier(control, Rational(k) / Rational(32)), chain), most * most) << round << " " << k;
    }
  }
}

// The quarter of the parabola y = x^2 between 0 and 2 is the curve of degree two over (0, 0), (1, 0), (2, 4). It bounds
// a region from below: chords above it are inside, corners below it outside.
TEST(Curves, bezier_curves_are_on_the_side_of_the_bound) {
  const std::string path = "<path d='M0 0 Q1 0 2 4 H0 Z'/>";
  for (const CurveBound bound : {CurveBound::nearest, CurveBound::inside, CurveBound::outside}) {
    const RegionData drawn = read(svg_of(path), RegionFormat::svg, 1e-3, bound);
    Ring ring = drawn.parts.at(0).outer;
    EXPECT_GT(ring.size(), 10u);
    ring.push_back(ring.front());
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
      const Point a = ring[k], b = ring[k + 1];
      if (a.x == 0 && b.x == 0) continue;
      if (a.y == 4 && b.y == 4) continue;
      for (const int part : {0, 1, 2, 3}) {
        const Rational t = Rational(part) / Rational(4);
        const Rational x = exact(a.x) + t * (exact(b.x) - exact(a.x)), y = exact(a.y) + t * (exact(b.y) - exact(a.y));
        const Rational above = y - x * x;
        const Rational into = bound == CurveBound::outside ? -above : above;
        EXPECT_GE(into, -kRounding) << a.x;
        // The parabola is at most sqrt(17) times as steep as that: 0.005 above is within 1e-3 or more.
        EXPECT_LE(above * above, exact(5e-3) * exact(5e-3)) << a.x;
      }
    }
    EXPECT_TRUE(Region::create(drawn).ok());
  }
}

std::string dxf(const std::string& entities, const std::string& before = "") {
  return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

// The same curve as SVG's cubic, as a spline of one span; and a circle as a spline with weights.
TEST(Curves, splines_are_the_curves_of_their_control_points) {
  const std::string ends = "40\n0\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n40\n1\n";
  const std::string points = "10\n0\n20\n0\n10\n1\n20\n4\n10\n3\n20\n-4\n10\n4\n20\n0\n";
  const RegionData spline =
      read(dxf("0\nSPLINE\n70\n8\n71\n3\n" + ends + points), RegionFormat::dxf, 1e-3, CurveBound::nearest);
  EXPECT_EQ(spline, read(svg_of("<path d='M0 0C1 4 3 -4 4 0'/>"), RegionFormat::svg, 1e-3, CurveBound::nearest));
  // Half of the unit circle: three points to a quarter, the middle ones with the weight sqrt(1/2).
  const std::string w = "0.70710678118654757";
  const std::string half =
      "0\nSPLINE\n70\n12\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n2\n40\n2\n40\n2\n41\n1\n41\n" + w +
      "\n41\n1\n41\n" + w + "\n41\n1\n10\n1\n20\n0\n10\n1\n20\n1\n10\n0\n20\n1\n10\n-1\n20\n1\n10\n-1\n20\n0\n";
  const RegionData closed =
      read(dxf(half + "0\nLINE\n10\n-1\n20\n0\n11\n1\n21\n0\n"), RegionFormat::dxf, 1e-4, CurveBound::nearest);
  ASSERT_EQ(closed.parts.size(), 1u);
  for (const Point p : closed.parts[0].outer) EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-15);
  EXPECT_GT(closed.parts[0].outer.size(), 60u);
}

// A spline of two spans without repeated knots: at the knots it is the mean of three control points with the weights
// 1, 4, 1, and in the centre of a span it is known, too.
TEST(Curves, splines_with_simple_knots) {
  std::string text = "0\nSPLINE\n70\n8\n71\n3\n";
  for (int k = 0; k < 9; ++k) text += "40\n" + std::to_string(k) + "\n";
  for (const auto& [x, y] : {std::pair{"0", "0"}, {"6", "0"}, {"6", "6"}, {"12", "6"}, {"12", "12"}})
    text += std::string("10\n") + x + "\n20\n" + y + "\n";
  const Polyline chain = read(dxf(text), RegionFormat::dxf, 1e-3, CurveBound::nearest).polylines.at(0);
  const auto near = [](Point p, Point q) { return std::hypot(p.x - q.x, p.y - q.y) < 1e-14; };
  EXPECT_TRUE(near(chain.front(), {5, 1}));
  EXPECT_TRUE(near(chain.back(), {11, 7}));
  EXPECT_TRUE(std::any_of(chain.begin(), chain.end(), [&](Point p) { return near(p, {7, 5}); }));
  // (1 * P0 + 23 P1 + 23 P2 + P3) / 48 half-way through the first span.
  const RationalPoint half{Rational(288) / Rational(48), Rational(144) / Rational(48)};
  EXPECT_LE(squared_distance(half, chain), exact(1e-3) * exact(1e-3));
}

TEST(Curves, blocks_are_drawn_where_they_are_inserted) {
  const std::string blocks =
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nTab\n10\n1\n20\n1\n0\nLWPOLYLINE\n70\n1\n10\n1\n20\n1\n10\n3\n20\n1\n10\n3\n"
      "20\n2\n0\nENDBLK\n0\nBLOCK\n2\nTwice\n10\n0\n20\n0\n0\nINSERT\n2\nTAB\n10\n0\n20\n0\n0\nINSERT\n2\ntab\n10\n9\n"
      "20\n0\n50\n90\n0\nENDBLK\n0\nENDSEC\n";
  const auto drawn = [&](const std::string& entities) { return read_one(dxf(entities, blocks), RegionFormat::dxf); };
  EXPECT_EQ(drawn("0\nINSERT\n2\ntab\n10\n10\n20\n0\n").parts.at(0).outer, (Ring{{10, 0}, {12, 0}, {12, 1}}));
  EXPECT_EQ(drawn("0\nINSERT\n2\ntab\n10\n10\n20\n0\n41\n2\n42\n-1\n").parts.at(0).outer,
            (Ring{{10, 0}, {14, -1}, {14, 0}}));
  const RegionData twice = drawn("0\nINSERT\n2\nTwice\n66\n1\n10\n0\n20\n0\n0\nATTRIB\n1\nx\n0\nSEQEND\n");
  ASSERT_EQ(twice.parts.size(), 2u);
  EXPECT_EQ(twice.parts[1].outer, (Ring{{9, 0}, {9, 2}, {8, 2}}));
  EXPECT_EQ(drawn("0\nINSERT\n2\ntab\n10\n0\n20\n0\n70\n3\n71\n2\n44\n5\n45\n7\n").parts.size(), 6u);
}

TEST(Curves, what_blocks_cannot_be_is_refused) {
  const auto refused = [](const std::string& blocks, const std::string& entities, const std::string& words) {
    const auto read = parse_shapes(dxf(entities, blocks), RegionFormat::dxf, "test");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().to_string();
  };
  const std::string loop =
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n0\nINSERT\n2\nB\n0\nENDBLK\n0\nBLOCK\n2\nB\n0\nINSERT\n2\nA\n0\nENDBLK\n"
      "0\nENDSEC\n";
  refused(loop, "0\nINSERT\n2\nA\n", "in a circle");
  refused("", "0\nINSERT\n2\nA\n", "there is none of");
  refused("", "0\nINSERT\n", "there is none of");
  // Ten blocks, each of ten copies of the next one: 10^10 lines.
  std::string bomb = "0\nSECTION\n2\nBLOCKS\n";
  for (int k = 0; k < 10; ++k)
    bomb += "0\nBLOCK\n2\n" + std::to_string(k) + "\n0\nINSERT\n2\n" + std::to_string(k + 1) + "\n70\n10\n0\nENDBLK\n";
  bomb += "0\nBLOCK\n2\n10\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n0\nENDBLK\n0\nENDSEC\n";
  refused(bomb, "0\nINSERT\n2\n0\n", "more than 1000000 entities");
}

TEST(Curves, use_draws_what_it_names) {
  const auto parts = [](const std::string& elements) { return read_one(svg_of(elements), RegionFormat::svg).parts; };
  const std::string tile = "<defs><rect id='t' width='2' height='1'/><g id='g'><use href='#t' x='1'/></g></defs>";
  EXPECT_EQ(parts(tile + "<use href='#t' x='5' y='6'/>").at(0).outer, (Ring{{5, 6}, {7, 6}, {7, 7}, {5, 7}}));
  EXPECT_EQ(parts(tile + "<use xlink:href='#g' transform='scale(2)'/>").at(0).outer,
            (Ring{{2, 0}, {6, 0}, {6, 2}, {2, 2}}));
  EXPECT_EQ(parts("<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol>"
                  "<use href='#s' width='5' height='5'/>")
                .at(0)
                .outer,
            (Ring{{0, 0}, {5, 0}, {5, 5}, {0, 5}}));
  EXPECT_TRUE(parts(tile).empty());
  // What is used inherits from where it is used.
  EXPECT_TRUE(parts(tile + "<g visibility='hidden'><use href='#t'/></g>").empty());
  const auto refused = [](const std::string& elements, const std::string& words) {
    const auto read = parse_shapes(svg_of(elements), RegionFormat::svg, "test");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().to_string();
  };
  refused("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>", "in a circle");
  refused("<use href='#none'/>", "there is none of");
  refused("<use href='other.svg#a'/>", "of this file");
}

TEST(Curves, smooth_curves_go_on) {
  // S and T mirror the control point before them; after other commands they have none.
  const auto line = [](const std::string& d) { return read_one(svg_of("<path d='" + d + "'/>"), RegionFormat::svg); };
  EXPECT_EQ(line("M0 0C0 1 1 2 2 2S4 1 4 0"), line("M0 0C0 1 1 2 2 2C3 2 4 1 4 0"));
  EXPECT_EQ(line("M0 0q1 2 2 0t2 0"), line("M0 0Q1 2 2 0Q3 -2 4 0"));
  EXPECT_EQ(line("M0 0L2 2S4 1 4 0"), line("M0 0L2 2C2 2 4 1 4 0"));
  EXPECT_EQ(line("M0 0A0 1 0 0 1 2 2"), line("M0 0L2 2"));
  EXPECT_EQ(line("M0 0A5 1 0 0 1 0 0L1 1"), line("M0 0L1 1"));
}

TEST(Curves, round_corners_of_rectangles) {
  const RegionData drawn =
      read(svg_of("<rect x='-4' y='-3' width='8' height='6' rx='1'/>"), RegionFormat::svg, 1e-4, CurveBound::nearest);
  EXPECT_TRUE(Region::create(drawn).ok());
  const double pi = 3.14159265358979;
  EXPECT_NEAR(area(Region::create(drawn).value()), 48 - 4 + pi, 1e-3);
}

TEST(Curves, errors_that_are_too_small_and_curves_that_are_too_large) {
  const auto refused = [](const std::string& elements, double error, ErrorCode code) {
    const auto read =
        parse_shapes(svg_of(elements), RegionFormat::svg, "test", {ThirdCoordinates::refused, {error, {}}});
    ASSERT_FALSE(read);
    EXPECT_EQ(name(read.error().code), name(code)) << read.error().to_string();
  };
  refused("<circle r='1'/>", 1e-15, ErrorCode::malformed);
  refused("<path d='M0 0C1 4 3 -4 4 0'/>", 1e-13, ErrorCode::malformed);
  refused("<circle r='1e308' cx='1.7e308'/>", 1e300, ErrorCode::not_finite);
}

TEST(Curves, arcs_of_well_known_text) {
  const auto read_wkt = [](const std::string& text) { return read_one(text, RegionFormat::wkt); };
  const RegionData arc = read_wkt("CIRCULARSTRING (0 0, 1 1, 2 0, 3 -1, 4 0)");
  const Polyline& line = arc.polylines.at(0);
  for (const Point p : std::vector<Point>{{0, 0}, {1, 1}, {2, 0}, {3, -1}, {4, 0}})
    EXPECT_NE(std::find(line.begin(), line.end(), p), line.end()) << p.x;
  EXPECT_GT(line.size(), 60u);
  EXPECT_EQ(read_wkt("CIRCULARSTRING (0 0, 1 0, 2 0)").polylines.at(0), (Polyline{{0, 0}, {1, 0}, {2, 0}}));
  const RegionData slot = read_wkt(
      "CURVEPOLYGON (COMPOUNDCURVE ((0 0, 4 0), CIRCULARSTRING (4 0, 5 1, 4 2), (4 2, 0 2), CIRCULARSTRING (0 2, -1 1, "
      "0 "
      "0)), (1 0.5, 2 0.5, 2 1.5, 1 0.5))");
  EXPECT_EQ(slot.parts.at(0).holes.size(), 1u);
  EXPECT_TRUE(Region::create(slot).ok());
  EXPECT_EQ(read_wkt("MULTISURFACE (((0 0, 1 0, 1 1, 0 0)), CURVEPOLYGON ((2 0, 3 0, 3 1, 2 0)))").parts.size(), 2u);
  EXPECT_EQ(read_wkt("MULTICURVE ((0 0, 1 0), CIRCULARSTRING EMPTY, CIRCULARSTRING (2 0, 3 1, 4 0))").polylines.size(),
            2u);
  EXPECT_EQ(read_wkt("CURVEPOLYGON EMPTY"), RegionData{});
  const auto refused = [](const std::string& text, const std::string& words) {
    expect_refused(text, RegionFormat::wkt, ErrorCode::malformed, 1, words);
  };
  refused("CIRCULARSTRING (0 0, 1 0)", "odd number");
  refused("CURVEPOLYGON (CIRCULARSTRING (0 0, 1 1, 2 0))", "not closed");
  refused("COMPOUNDCURVE ((0 0, 1 0), (2 0, 3 0))", "does not begin where");
  refused("COMPOUNDCURVE (COMPOUNDCURVE ((0 0, 1 0)))", "LINESTRING");
}

TEST(Curves, units_and_numbers_of_curves_are_kept) {
  const auto first = [](const std::string& text, RegionFormat format) {
    return parse_shapes(text, format, "t").value().at(0);
  };
  const std::string header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
  const NamedShape drawing = first(dxf("0\nCIRCLE\n10\n0\n20\n0\n40\n3\n", header), RegionFormat::dxf);
  EXPECT_EQ(drawing.unit, "mm");
  EXPECT_EQ(drawing.curves, 1u);
  EXPECT_EQ(first(dxf(""), RegionFormat::dxf).unit, "");
  EXPECT_EQ(first("<svg width='20mm' viewBox='0 0 20 10'/>", RegionFormat::svg).unit, "mm");
  EXPECT_EQ(first("<svg width='20mm' viewBox='0 0 200 10'/>", RegionFormat::svg).unit, "");
  EXPECT_EQ(first("<svg width='20'/>", RegionFormat::svg).unit, "");
  EXPECT_EQ(first("CIRCULARSTRING (0 0, 1 1, 2 0, 3 -1, 4 0)", RegionFormat::wkt).curves, 2u);
}

}  // namespace
}  // namespace dymsum::io_test
