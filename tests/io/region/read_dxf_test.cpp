// DXF: what is read, how arcs become chords, and what is refused.
#include <cmath>
#include <numbers>

#include "io/reading.h"

namespace dymsum::io_test {
namespace {

std::string groups(const std::vector<std::pair<int, std::string>>& list) {
  std::string text;
  for (const auto& [code, value] : list) text += std::to_string(code) + "\n" + value + "\n";
  return text;
}

std::string drawing(const std::string& entities) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

RegionData drawn(const std::string& entities) { return read_one(drawing(entities), RegionFormat::dxf); }

std::string line(const std::string& a, const std::string& b, const std::string& c, const std::string& d) {
  return groups({{0, "LINE"}, {8, "0"}, {10, a}, {20, b}, {30, "0"}, {11, c}, {21, d}, {31, "0.0"}});
}
std::string arc(const std::string& x, const std::string& y, const std::string& r, const std::string& from,
                const std::string& to) {
  return groups({{0, "ARC"}, {10, x}, {20, y}, {40, r}, {50, from}, {51, to}});
}
std::string polyline(const std::string& flags, const std::vector<std::pair<int, std::string>>& vertices) {
  return groups({{0, "LWPOLYLINE"}, {70, flags}}) + groups(vertices);
}

constexpr const char* kSquare = "10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n2\n10\n0\n20\n2\n";

TEST(ReadDxf, polylines_are_rings_where_they_are_closed) {
  const Ring square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(drawn("0\nLWPOLYLINE\n90\n4\n70\n1\n" + std::string(kSquare)), (RegionData{{{square, {}}}, {}, {}}));
  EXPECT_EQ(drawn("0\nLWPOLYLINE\n70\n0\n" + std::string(kSquare) + "10\n0\n20\n0\n"),
            (RegionData{{{square, {}}}, {}, {}}));
  EXPECT_EQ(drawn("0\nLWPOLYLINE\n" + std::string(kSquare)), (RegionData{{}, {square}, {}}));
  const std::string old =
      "0\nPOLYLINE\n66\n1\n70\n1\n0\nVERTEX\n10\n0\n20\n0\n0\nVERTEX\n10\n2\n20\n0\n0\nVERTEX\n10\n2\n20\n2\n"
      "0\nVERTEX\n10\n0\n20\n2\n0\nSEQEND\n";
  EXPECT_EQ(drawn(old), (RegionData{{{square, {}}}, {}, {}}));
}

TEST(ReadDxf, rings_are_nested_and_oriented) {
  const std::string inner = polyline("1", {{10, "0.5"}, {20, "0.5"}, {10, "1"}, {20, "0.5"}, {10, "0.5"}, {20, "1"}});
  const RegionData data = drawn("0\nLWPOLYLINE\n70\n1\n" + std::string(kSquare) + inner);
  ASSERT_EQ(data.parts.size(), 1u);
  ASSERT_EQ(data.parts[0].holes.size(), 1u);
  EXPECT_TRUE(Region::create(data).ok());
}

// Distance of the chain from the circle, and on which side.
void expect_on_circle(const std::vector<Point>& chain, Point centre, double radius) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Point a = chain[i], b = chain[i + 1];
    EXPECT_NEAR(std::hypot(a.x - centre.x, a.y - centre.y), radius, 1e-13 * radius);
    const double midpoint = std::hypot((a.x + b.x) / 2 - centre.x, (a.y + b.y) / 2 - centre.y);
    EXPECT_LT(midpoint, radius) << "chords lie inside of the circle";
    EXPECT_GT(midpoint, radius * (1 - 1e-3)) << "and within a thousandth of the radius";
  }
}

TEST(ReadDxf, arcs_are_within_a_thousandth_of_their_radius) {
  const RegionData circle = drawn(groups({{0, "CIRCLE"}, {10, "3"}, {20, "4"}, {40, "5"}}));
  Ring ring = circle.parts.at(0).outer;
  EXPECT_EQ(ring.front(), (Point{8, 4}));
  EXPECT_NE(std::find(ring.begin(), ring.end(), Point{3, 9}), ring.end());
  ring.push_back(ring.front());
  expect_on_circle(ring, {3, 4}, 5);
  const RegionData half = drawn(arc("1", "0", "2", "90", "270"));
  EXPECT_EQ(half.polylines.at(0).front(), (Point{1, 2}));
  EXPECT_EQ(half.polylines.at(0).back(), (Point{1, -2}));
  expect_on_circle(half.polylines.at(0), {1, 0}, 2);
  expect_on_circle(drawn(arc("1", "0", "2", "350", "10")).polylines.at(0), {1, 0}, 2);
  expect_on_circle(drawn(arc("1", "0", "2", "-370", "370.5")).polylines.at(0), {1, 0}, 2);
}

TEST(ReadDxf, bulges_are_arcs_between_exact_ends) {
  // Quarter of a circle about (0, 0): tan(22.5 degrees).
  const std::string quarter = "0.41421356237309503";
  const auto chain = [](const std::string& b) {
    return drawn(polyline("0", {{10, "2"}, {20, "0"}, {42, b}, {10, "0"}, {20, "2"}})).polylines.at(0);
  };
  for (const std::string& b : std::vector<std::string>{quarter, "-2.4142135623730949"}) {
    const Polyline bent = chain(b);
    EXPECT_EQ(bent.front(), (Point{2, 0}));
    EXPECT_EQ(bent.back(), (Point{0, 2}));
    EXPECT_GT(bent.size(), 18u);
    expect_on_circle(bent, {0, 0}, 2);  // a quarter counter-clockwise, three quarters clockwise
  }
  EXPECT_GT(chain("-2.4142135623730949").size(), chain(quarter).size());
  // Half a circle, either way.
  for (const std::string& b : std::vector<std::string>{"1", "-1"}) {
    const Polyline half = drawn(polyline("0", {{10, "-3"}, {20, "0"}, {42, b}, {10, "3"}, {20, "0"}})).polylines.at(0);
    expect_on_circle(half, {0, 0}, 3);
    EXPECT_EQ(half[half.size() / 2].y < 0, b == "1") << "counter-clockwise from left to right is below";
  }
  EXPECT_EQ(chain("0").size(), 2u);
  // An arc that is nearly straight keeps its sagitta of a bulge times half the chord.
  const Polyline flat =
      drawn(polyline("0", {{10, "0"}, {20, "0"}, {42, "0.02"}, {10, "10"}, {20, "0"}})).polylines.at(0);
  ASSERT_EQ(flat.size(), 2u) << "0.08 radians are one step";
}

TEST(ReadDxf, lines_and_arcs_are_joined_to_rings) {
  // A stadium, its pieces in any order and direction; the ends of arcs are rounded in the file.
  const std::string pieces = line("0", "0", "4", "0") + arc("4", "1", "1", "270", "90") + line("0", "2", "4", "2") +
                             arc("0", "1", "1", "90.0000001", "269.9999999");
  const RegionData data = drawn(pieces);
  ASSERT_EQ(data.parts.size(), 1u);
  EXPECT_TRUE(data.polylines.empty());
  const Region region = Region::create(data).value();
  EXPECT_NEAR(area(region), 8 + std::numbers::pi, 0.01);
  EXPECT_LT(area(region), 8 + std::numbers::pi) << "convex arcs lose area";
  for (const Point p : {Point{0, 0}, Point{4, 0}, Point{0, 2}, Point{4, 2}})
    EXPECT_EQ(std::count(data.parts[0].outer.begin(), data.parts[0].outer.end(), p), 1) << "coordinates of lines count";
  const RegionData open = drawn(line("0", "0", "1", "0") + line("2", "0", "1", "0") + line("5", "5", "6", "6"));
  EXPECT_EQ(open.polylines, (std::vector<Polyline>{{{0, 0}, {1, 0}, {2, 0}}, {{5, 5}, {6, 6}}}));
  // Lines are joined only where they meet exactly.
  EXPECT_EQ(drawn(line("0", "0", "1", "0") + line("1.0000001", "0", "2", "0")).polylines.size(), 2u);
}

TEST(ReadDxf, what_is_not_drawn_is_not_read) {
  EXPECT_EQ(drawn("0\nTEXT\n10\n1\n20\n1\n1\nhello\n0\nLINE\n60\n1\n10\n0\n0\nLINE\n67\n1\n"), RegionData{});
  EXPECT_EQ(read_one("0\nSECTION\n2\nBLOCKS\n0\nCIRCLE\n0\nENDSEC\n0\nEOF\n", RegionFormat::dxf), RegionData{});
}

std::string layers(const std::string& table) {
  return "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n1\n" + table + "0\nENDTAB\n0\nENDSEC\n";
}

TEST(ReadDxf, hidden_layers_are_not_read) {
  const std::string entities =
      "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n8\nHid\n0\nPOLYLINE\n8\nhid\n70\n64\n0\nVERTEX\n10\n0\n0\nSEQEND\n"
      "0\nPOINT\n8\nseen\n10\n1\n20\n2\n0\nENDSEC\n0\nEOF\n";
  for (const std::string hidden : {"62\n-7\n70\n0\n", "70\n65\n62\n7\n"})
    EXPECT_EQ(read_one(layers("0\nLAYER\n2\nhiD\n" + hidden + "0\nLAYER\n2\nseen\n70\n64\n62\n3\n") + entities,
                       RegionFormat::dxf),
              (RegionData{{}, {}, {{1, 2}}}));
  expect_refused(layers("0\nLAYER\n2\nhid\n62\n7\n70\n2\n") + entities, RegionFormat::dxf, ErrorCode::malformed, 28,
                 "'SPLINE' cannot be read");
  const std::string nothing = layers("0\nLAYER\n2\n0\n62\n-7\n") + "0\nSECTION\n2\nENTITIES\n0\nPOINT\n10\n1\n20\n2\n";
  EXPECT_EQ(read_one(nothing + "0\nENDSEC\n0\nEOF\n", RegionFormat::dxf), RegionData{}) << "layer 0, without a name";
}

// A file of our own that somebody drew in: nothing of it is left out, nothing open is closed.
TEST(ReadDxf, edited_files_of_our_own_are_read_as_others) {
  const Ring square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const auto edited = [](const std::string& more) {
    const std::string own =
        format_region(Region::create({{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}}}, {}, {}}).value(), RegionFormat::dxf);
    std::string text = own;
    return read_one(text.insert(own.rfind("0\nENDSEC"), more), RegionFormat::dxf);
  };
  EXPECT_EQ(edited(""), (RegionData{{{square, {}}}, {}, {}}));
  const RegionData holed = edited("0\nCIRCLE\n8\nouter\n10\n1\n20\n1\n40\n0.5\n");
  ASSERT_EQ(holed.parts.size(), 1u);
  EXPECT_EQ(holed.parts[0].holes.size(), 1u);
  EXPECT_EQ(edited("0\nARC\n10\n9\n20\n9\n40\n1\n50\n0\n51\n90\n").polylines.size(), 1u);
  EXPECT_EQ(edited("0\nLINE\n10\n9\n20\n9\n11\n8\n21\n8\n").polylines.size(), 1u);
  const std::string corner = "10\n5\n20\n5\n10\n6\n20\n5\n10\n6\n20\n6\n";
  EXPECT_EQ(edited("0\nLWPOLYLINE\n8\nouter\n70\n0\n" + corner),
            (RegionData{{{square, {}}}, {{{5, 5}, {6, 5}, {6, 6}}}, {}}));
  EXPECT_EQ(edited("0\nLWPOLYLINE\n8\nline\n70\n1\n" + corner).parts.size(), 2u);
  EXPECT_EQ(edited("0\nLWPOLYLINE\n8\n0\n70\n1\n" + corner).parts.size(), 2u);
  EXPECT_EQ(edited("0\nPOINT\n8\nouter\n10\n9\n20\n9\n").points.size(), 1u);
}

TEST(ReadDxf, lines_without_length_draw_nothing) {
  EXPECT_EQ(drawn(line("1", "0", "1", "0") + line("0", "0", "1", "0")).polylines,
            (std::vector<Polyline>{{{0, 0}, {1, 0}}}));
}

TEST(ReadDxf, texts_as_programs_write_them) {
  std::string text = drawing(line(" 0.0", "0.0 ", "1e0", "+1"));
  std::string dos;
  for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(read_one(dos, RegionFormat::dxf).polylines, (std::vector<Polyline>{{{0, 0}, {1, 1}}}));
  EXPECT_TRUE(begins_like_dxf(text));
  EXPECT_TRUE(begins_like_dxf("  0\r\nSECTION\r\n"));
  EXPECT_TRUE(begins_like_dxf("999\nby hand\n0\nSECTION"));
  for (const char* const other : {"", "0", "0\n", "1\n4 out\n", "999\n4 out\n0 0", "POINT (0 0)", "{", "0\n4 out"})
    EXPECT_FALSE(begins_like_dxf(other)) << other;
}

void refused(const std::string& entities, std::int64_t entity_line, std::string_view words,
             ErrorCode code = ErrorCode::malformed) {
  constexpr std::int64_t kBefore = 14;  // lines of the header, and of the section's beginning
  expect_refused(drawing(entities), RegionFormat::dxf, code, kBefore + entity_line, words);
}

TEST(ReadDxf, what_cannot_be_read_is_told) {
  refused("0\nSPLINE\n", 2, "'SPLINE' cannot be read");
  refused("0\nINSERT\n2\nA\n", 2, "explode blocks");
  refused("0\nLINE\n10\n0\n20\n0\n11\n1\n", 2, "no y coordinate");
  refused("0\nCIRCLE\n10\n0\n20\n0\n40\n0\n", 2, "radius has to be positive");
  refused("0\nCIRCLE\n10\n0\n20\n0\n", 2, "no radius");
  refused("0\nCIRCLE\n10\n0\n20\nx\n40\n1\n", 6, "expected a number instead of 'x'");
  refused("0\nCIRCLE\n10\n1e999\n20\n0\n40\n1\n", 4, "not a finite", ErrorCode::not_finite);
  refused("0\nCIRCLE\n10\n1e308\n20\n0\n40\n1e308\n", 2, "leaves the range", ErrorCode::not_finite);
  refused(arc("0", "0", "1", "30", "390"), 2, "same direction");
  refused(groups({{0, "LINE"}, {10, "0"}, {20, "0"}, {30, "1"}, {11, "1"}, {21, "0"}}), 8, "plane z = 0");
  refused("0\nLWPOLYLINE\n38\n2\n" + std::string(kSquare), 4, "plane z = 0");
  refused("0\nCIRCLE\n10\n0\n20\n0\n40\n1\n230\n-1\n", 10, "seen from above");
  refused("0\nLWPOLYLINE\n90\n5\n70\n1\n" + std::string(kSquare), 4, "there are 4 vertices");
  refused("0\nLWPOLYLINE\n42\n1\n", 4, "a bulge without vertex");
  refused("0\nLWPOLYLINE\n10\n0\n10\n1\n20\n0\n", 6, "without y");
  refused("0\nLWPOLYLINE\n20\n0\n", 4, "without x");
  refused("0\nLWPOLYLINE\n70\n1\n", 2, "without vertices");
  refused("0\nLWPOLYLINE\n70\n-1\n", 4, "whole number");
  refused("0\nPOLYLINE\n70\n64\n0\nSEQEND\n", 2, "meshes");
  refused("0\nPOLYLINE\n0\nLINE\n", 2, "not ended by SEQEND");
  refused("0\nPOLYLINE\n0\nVERTEX\n10\n0\n20\n0\n", 2, "not ended by SEQEND");
  refused(line("0", "0", "1", "0") + line("0", "0", "2", "0") + line("0", "0", "3", "0"), 34,
          "more than two lines or arcs end at 0 0");
  const auto bad = [](std::string_view text, std::int64_t at, ErrorCode code, std::string_view words) {
    expect_refused(text, RegionFormat::dxf, code, at, words);
  };
  bad("", 1, ErrorCode::truncated, "before its EOF");
  bad("0\nSECTION\n2\nENTITIES\n", 4, ErrorCode::truncated, "before its EOF");
  bad("0\nSECTION\n2\nENTITIES\n0\nEOF\n", 2, ErrorCode::malformed, "not ended");
  bad("0\nSECTION\n0\nSECTION\n0\nEOF\n", 4, ErrorCode::malformed, "inside another");
  bad("hello\n", 1, ErrorCode::malformed, "the code of a group instead of 'hello'");
  bad("AutoCAD Binary DXF\r\n\x1a", 1, ErrorCode::malformed, "binary");
}

}  // namespace
}  // namespace dymsum::io_test
