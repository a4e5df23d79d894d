#include "io/reading.h"

namespace dymsum::io_test {
namespace {

constexpr RegionFormat kWkt = RegionFormat::wkt;

Evidence refused_wkt(std::string_view text, ErrorCode code, std::int64_t line, std::string_view words) {
  return expect_refused(text, kWkt, code, line, words);
}

TEST(ReadWkt, closing_vertices_are_dropped) {
  EXPECT_EQ(read_one("POLYGON ((0 0, 4 0, 0 4, 0 0), (1 1, 1 2, 2 1, 1 1))", kWkt).parts,
            (std::vector<Part>{{{{0, 0}, {4, 0}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 1}}}}}));
}

TEST(ReadWkt, rings_are_oriented_by_their_place_and_keep_their_first_vertex) {
  EXPECT_EQ(read_one("POLYGON ((0 0, 0 4, 4 0, 0 0), (1 1, 2 1, 1 2, 1 1))", kWkt).parts,
            (std::vector<Part>{{{{0, 0}, {4, 0}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 1}}}}}));
}

TEST(ReadWkt, every_kind_of_geometry) {
  const auto shapes = read_all(
      "point(1 2)\n"
      "LINESTRING (0 0, 1 1)\n"
      "MULTIPOINT ((1 2), EMPTY, (3 4))\n"
      "MULTIPOINT (1 2, 3 4)\n"
      "MULTILINESTRING ((0 0, 1 1), (2 2, 3 3))\n"
      "MultiPolygon (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5)))\n"
      "GEOMETRYCOLLECTION (POINT (1 1), GEOMETRYCOLLECTION (LINESTRING (0 0, 1 0)), POLYGON ((0 0, 1 0, 0 1, 0 0)))\n",
      kWkt);
  ASSERT_EQ(shapes.size(), 7u);
  const Part corner{{{0, 0}, {1, 0}, {0, 1}}, {}};
  EXPECT_EQ(shapes[0].data, (RegionData{{}, {}, {{1, 2}}}));
  EXPECT_EQ(shapes[1].data, (RegionData{{}, {{{0, 0}, {1, 1}}}, {}}));
  EXPECT_EQ(shapes[2].data, (RegionData{{}, {}, {{1, 2}, {3, 4}}}));
  EXPECT_EQ(shapes[3].data, shapes[2].data);
  EXPECT_EQ(shapes[4].data, (RegionData{{}, {{{0, 0}, {1, 1}}, {{2, 2}, {3, 3}}}, {}}));
  EXPECT_EQ(shapes[5].data, (RegionData{{corner, {{{5, 5}, {6, 5}, {5, 6}}, {}}}, {}, {}}));
  EXPECT_EQ(shapes[6].data, (RegionData{{corner}, {{{0, 0}, {1, 0}}}, {{1, 1}}}));
  EXPECT_EQ(shapes[0].name, "0");
  EXPECT_EQ(shapes[6].name, "6");
}

TEST(ReadWkt, empty_geometries) {
  for (const char* kind :
       {"POINT", "LINESTRING", "POLYGON", "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON", "GEOMETRYCOLLECTION"}) {
    EXPECT_EQ(read_one(std::string(kind) + " EMPTY", kWkt), RegionData{}) << kind;
  }
}

TEST(ReadWkt, a_sole_shape_is_named_after_its_file) {
  const auto shapes = parse_shapes("POINT (1 2)", kWkt, "some/dir/thing.wkt");
  ASSERT_TRUE(shapes.ok());
  EXPECT_EQ(shapes->at(0).name, "thing");
}

TEST(ReadWkt, refuses_what_does_not_follow_the_format) {
  refused_wkt("POINT (1 2)\nCIRCLE (1 2)\n", ErrorCode::malformed, 2, "instead of 'CIRCLE'");
  refused_wkt("POLYGON" + std::string(200, 'A'), ErrorCode::malformed, 1, "instead of 'POLYGONAAAAAAAAAAAAAAAAA...'");
  refused_wkt("POLYGON Z ((0 0 1, 1 0 1, 0 1 1, 0 0 1))", ErrorCode::malformed, 1, "not planar");
  refused_wkt("POLYGON ((0 0,\n1 0 7,\n0 1, 0 0))", ErrorCode::malformed, 2, "a third coordinate");
  refused_wkt("POLYGON ((0 0,\n1 0x,\n0 1, 0 0))", ErrorCode::malformed, 2, "'0x'");
  refused_wkt("POLYGON ((0 0, 1 0, 0 1\n, 0 0.5))", ErrorCode::malformed, 1, "not closed");
  refused_wkt("LINESTRING (0 0; 1 1)", ErrorCode::malformed, 1, "'0;'");
  refused_wkt("\nPOINT (1)", ErrorCode::malformed, 2, "a coordinate");
}

TEST(ReadWkt, coordinates_must_be_finite) {
  refused_wkt("LINESTRING (0 0,\n1 1e999)", ErrorCode::not_finite, 2, "1e999");
  refused_wkt("POINT (nan 0)", ErrorCode::not_finite, 1, "nan");
  refused_wkt("POINT (0 -Infinity)", ErrorCode::not_finite, 1, "-Infinity");
}

TEST(ReadWkt, a_file_that_ends_early_is_truncated) {
  refused_wkt("", ErrorCode::truncated, 1, "first geometry");
  refused_wkt("POLYGON ((0 0, 1 0,\n0 1", ErrorCode::truncated, 2, "',' or ')'");
  refused_wkt("POLYGON ((0 0, 1 0,\n", ErrorCode::truncated, 1, "a coordinate");
  refused_wkt("POLYGON", ErrorCode::truncated, 1, "'('");
}

TEST(ReadWkt, deep_nesting_is_refused) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "GEOMETRYCOLLECTION(";
  refused_wkt(text, ErrorCode::malformed, 1, "nested deeper than 32");
}

TEST(ReadWkt, third_coordinates_are_refused_as_such) {
  for (const char* text : {"POLYGON Z ((0 0 1, 1 0 1, 0 1 1, 0 0 1))", "POLYGONZ((0 0 1, 1 0 1, 0 1 1, 0 0 1))",
                           "POINT Z (1 2 3)", "POINTM (1 2 3)", "MULTIPOINT Z ((1 2 3))",
                           "LineString ZM (0 0 1 1, 1 1 1 1)", "GEOMETRYCOLLECTION Z (POINT Z (1 2 3))"})
    refused_wkt(text, ErrorCode::malformed, 1, "not planar: only x and y can be read");
  for (const char* text :
       {"POLYGON ((0 0 1, 1 0 1, 0 1 1, 0 0 1))", "POINT (1 2 3)", "MULTIPOINT ((1 2 3))", "LINESTRING (0 0, 1 1 1e3)"})
    refused_wkt(text, ErrorCode::malformed, 1, "a third coordinate");
}

TEST(ReadWkt, third_coordinates_are_left_out_on_request) {
  const auto flat = [](const char* text) {
    return parse_shapes(text, RegionFormat::wkt, "text", {ThirdCoordinates::dropped, {}}).value().at(0).data;
  };
  EXPECT_EQ(
      flat("COMPOUNDCURVE Z (CIRCULARSTRING Z (0 0 1, 1 1 1, 2 0 1), LINESTRING Z (2 0 1, 3 0 1), LINESTRING Z EMPTY)"),
      read_one("COMPOUNDCURVE (CIRCULARSTRING (0 0, 1 1, 2 0), LINESTRING (2 0, 3 0))", kWkt));
  EXPECT_EQ(flat("CIRCULARSTRING Z EMPTY"), RegionData{});
  EXPECT_EQ(flat("CURVEPOLYGON Z (LINESTRING Z (0 0 1, 1 0 1, 0 1 1, 0 0 1))"),
            read_one("POLYGON ((0 0, 1 0, 0 1, 0 0))", kWkt));
  EXPECT_EQ(flat("POLYGON Z ((0 0 1, 1 0 2, 0 1 3, 0 0 4), EMPTY)"), read_one("POLYGON ((0 0, 1 0, 0 1, 0 0))", kWkt));
  EXPECT_EQ(flat("POLYGONZM((0 0 1 9,1 0 2 9,0 1 3 9,0 0 4 9))"), flat("POLYGON ((0 0, 1 0, 0 1, 0 0))"));
  EXPECT_EQ(flat("MULTIPOINT M ((1 2 3), EMPTY, (3 4 5))"), flat("MULTIPOINT (1 2, 3 4)"));
  EXPECT_EQ(flat("GEOMETRYCOLLECTION Z (POINT Z (1 2 3), LINESTRING Z EMPTY, POINT ZM EMPTY, LINESTRING (0 0 1, 1 1))"),
            flat("GEOMETRYCOLLECTION (POINT (1 2), LINESTRING (0 0, 1 1))"));
  for (const char* text :
       {"POINT Z", "POINT Z Z (1 2 3)", "POINT (1 2 3 4 5)", "POINT (1 2 x)", "POINT Z (1 2 3", "POINT ZEMPTY"})
    EXPECT_FALSE(parse_shapes(text, RegionFormat::wkt, "text", {ThirdCoordinates::dropped, {}})) << text;
}

TEST(ReadWkt, geometries_may_end_with_a_semicolon) {
  EXPECT_EQ(parse_shapes("POINT (1 2);\nPOINT (3 4) ;\n", RegionFormat::wkt, "text")->size(), 2u);
  for (const char* text : {";", "POINT (1 2);;", "POINT (1 2;)"})
    EXPECT_FALSE(parse_shapes(text, RegionFormat::wkt, "text")) << text;
}

TEST(ReadWkt, holes_may_be_empty) {
  EXPECT_EQ(read_one("POLYGON ((0 0, 9 0, 0 9, 0 0), EMPTY, (1 1, 2 1, 1 2, 1 1), empty)", kWkt),
            read_one("POLYGON ((0 0, 9 0, 0 9, 0 0), (1 1, 2 1, 1 2, 1 1))", kWkt));
  refused_wkt("POLYGON (EMPTY, (1 1, 2 1, 1 2, 1 1))", ErrorCode::malformed, 1, "'('");
}

}  // namespace
}  // namespace dymsum::io_test
