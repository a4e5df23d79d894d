#include "io/reading.h"

namespace dymsum::io_test {
namespace {

constexpr RegionFormat kGeoJson = RegionFormat::geojson;
constexpr RegionFormat kJson = RegionFormat::json;

Evidence refused_json(std::string_view text, ErrorCode code, std::int64_t line, std::string_view words) {
  return expect_refused(text, kJson, code, line, words);
}

TEST(ReadGeoJson, a_polygon_loses_its_closing_vertices_and_gets_its_orientation) {
  const char* text = R"({"type":"Polygon","coordinates":[[[0,0],[0,4],[4,0],[0,0]],[[1,1],[2,1],[1,2],[1,1]]]})";
  EXPECT_EQ(read_one(text, kGeoJson).parts,
            (std::vector<Part>{{{{0, 0}, {4, 0}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 1}}}}}));
}

TEST(ReadGeoJson, every_kind_of_geometry) {
  const RegionData data = read_one(
      R"({"type":"GeometryCollection","geometries":[
      {"type":"Point","coordinates":[1,2]}, {"type":"MultiPoint","coordinates":[[3,4],[5,6]]},
      {"coordinates":[[0,0],[1,1.5]],"type":"LineString"},
      {"type":"MultiLineString","coordinates":[[[7,7],[8,8]],[[9,9],[1e1,10]]]},
      {"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,5],[6,5],[5,6],[5,5]]]]},
      {"type":"Polygon","coordinates":[]}]})",
      kGeoJson);
  const RegionData expected{{{{{0, 0}, {1, 0}, {0, 1}}, {}}, {{{5, 5}, {6, 5}, {5, 6}}, {}}},
                            {{{0, 0}, {1, 1.5}}, {{7, 7}, {8, 8}}, {{9, 9}, {10, 10}}},
                            {{1, 2}, {3, 4}, {5, 6}}};
  EXPECT_EQ(data, expected);
}

TEST(ReadGeoJson, each_feature_is_a_shape_named_by_id_or_name) {
  const auto shapes = read_all(
      R"({"type":"FeatureCollection","features":[
      {"type":"Feature","id":12,"properties":{"name":"ignored"},"geometry":{"type":"Point","coordinates":[1,2]}},
      {"type":"Feature","properties":{"name":"named"},"geometry":null},
      {"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[3,4]}}]})",
      kGeoJson);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].name, "12");
  EXPECT_EQ(shapes[0].data.points, (std::vector<Point>{{1, 2}}));
  EXPECT_EQ(shapes[1].name, "named");
  EXPECT_EQ(shapes[1].data, RegionData{});
  EXPECT_EQ(shapes[2].name, "2");
}

TEST(ReadGeoJson, refuses_what_does_not_follow_the_format) {
  refused_json("{\"type\":\"Circle\",\n\"coordinates\":[0,0]}", ErrorCode::malformed, 1,
               "unknown GeoJSON type 'Circle'");
  refused_json("{\"type\":\n7}", ErrorCode::malformed, 2, "'type' as a string");
  refused_json("{\"type\":\"Polygon\"}", ErrorCode::malformed, 1, "no 'coordinates'");
  refused_json("{\"type\":\"Polygon\",\"coordinates\":[\n[[0,0],[1,0],[0,1]]]}", ErrorCode::malformed, 2, "not closed");
  refused_json("{\"type\":\"Polygon\",\"coordinates\":[\n[[0,0],[1,0],\n[0,1,5],[0,0]]]}", ErrorCode::malformed, 3,
               "two numbers");
  refused_json("{\"type\":\"LineString\",\"coordinates\":[[0,0],\n\n[1,\"0\"]]}", ErrorCode::malformed, 3,
               "two numbers");
  refused_json("{\"type\":\"LineString\",\"coordinates\":[0,0]}", ErrorCode::malformed, 1, "array of positions");
  refused_json("{\"type\":\"Feature\",\"properties\":{}}", ErrorCode::malformed, 1, "no 'geometry'");
  refused_json("{\"type\":\"FeatureCollection\",\"features\":[\n{\"type\":\"Point\",\"coordinates\":[1,2]}]}",
               ErrorCode::malformed, 2, "expected a Feature");
}

TEST(ReadNesting, items_are_shapes_named_by_id_and_kept_as_they_are_but_for_closing_vertices) {
  const auto shapes = read_all(
      R"({"name":"n","items":[
      {"id":3,"demand":1,"shape":{"type":"simple_polygon","data":[[0,0],[0,3],[3,3],[3,3],[0,0]]}},
      {"id":"frame","shape":{"type":"polygon","data":{"outer":[[0,0],[4,0],[4,4],[0,4]],
      "inner":[[[1,1],[2,1],[1,2]]]}}},
      {"shape":{"type":"polygon","outer":[[0,0],[4,0],[4,4]]}},
      {"id":4,"shape":{"type":"rectangle","data":{"x_min":1,"y_min":2,"width":3,"height":4}}},
      {"id":5,"shape":{"type":"multi_polygon","data":[{"outer":[[0,0],[1,0],[0,1]],"inner":null},
      {"outer":[[5,5],[6,5],[5,6]]}]}}]})",
      kJson);
  ASSERT_EQ(shapes.size(), 5u);
  EXPECT_EQ(shapes[0].name, "3");
  EXPECT_EQ(shapes[0].data.parts, (std::vector<Part>{{{{0, 0}, {0, 3}, {3, 3}, {3, 3}}, {}}}));
  EXPECT_EQ(shapes[1].name, "frame");
  EXPECT_EQ(shapes[1].data.parts, (std::vector<Part>{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {2, 1}, {1, 2}}}}}));
  EXPECT_EQ(shapes[2].name, "2");
  EXPECT_EQ(shapes[2].data.parts, (std::vector<Part>{{{{0, 0}, {4, 0}, {4, 4}}, {}}}));
  EXPECT_EQ(shapes[3].data.parts, (std::vector<Part>{{{{1, 2}, {4, 2}, {4, 6}, {1, 6}}, {}}}));
  EXPECT_EQ(shapes[4].data.parts.size(), 2u);
}

TEST(ReadNesting, duplicate_vertices_and_clockwise_rings_are_left_to_repair) {
  const RegionData data =
      read_one(R"({"items":[{"shape":{"type":"simple_polygon","data":[[0,0],[0,3],[3,3],[3,3],[0,0]]}}]})", kJson);
  EXPECT_FALSE(Region::create(data).ok());
  const auto repaired = repair(data);
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(repaired->report.duplicate_vertices, 1u);
  EXPECT_EQ(repaired->report.reversed_rings, 1u);
}

TEST(ReadNesting, refuses_what_does_not_follow_the_format) {
  refused_json("[1, 2]", ErrorCode::malformed, 1, "'items'");
  refused_json("{\"name\":\"x\"}", ErrorCode::malformed, 1, "'items'");
  refused_json("{\"items\":\n7}", ErrorCode::malformed, 2, "array of items");
  refused_json("{\"items\":[\n\n{\"id\":1}]}", ErrorCode::malformed, 3, "no 'shape'");
  refused_json("{\"items\":[\n{\"shape\":\n{\"type\":\"spline\",\"data\":[]}}]}", ErrorCode::malformed, 3,
               "unknown shape type 'spline'");
  refused_json("{\"items\":[{\"shape\":{\"type\":\"simple_polygon\",\"data\":[\n[0,0],\n[1]]}}]}", ErrorCode::malformed,
               3, "two numbers");
  refused_json(
      "{\"items\":[{\"shape\":{\"type\":\"rectangle\",\"data\":{\"x_min\":0,\"y_min\":\"0\",\"width\":1,\"height\":1}}}"
      "]}",
      ErrorCode::malformed, 1, "a number as 'y_min'");
  refused_json(
      "{\"items\":[{\"shape\":{\"type\":\"rectangle\",\"data\":{\"x_min\":1e308,\"y_min\":0,\"width\":1e308,\"height\":"
      "1}}}]}",
      ErrorCode::not_finite, 1, "double range");
}

TEST(ReadJson, broken_text_is_refused_at_its_line) {
  refused_json("{\"items\":[\n1,,2]}", ErrorCode::malformed, 2, "no JSON value");
  refused_json("{\"items\":[\n1 2]}", ErrorCode::malformed, 2, "no JSON value");
  refused_json("{'items':[]}", ErrorCode::malformed, 1, "no JSON value");
  refused_json("{\"items\":[]}\nmore", ErrorCode::malformed, 2, "no JSON value");
  refused_json("{\"items\":\n\"\xFF\"}", ErrorCode::malformed, 2, "no JSON value");
  refused_json("", ErrorCode::truncated, 1, "ends too early");
  refused_json("{\"items\":[\n[1,2],\n", ErrorCode::truncated, 2, "ends too early");
  refused_json("{\"items\":[\n[1,2", ErrorCode::truncated, 2, "ends too early");
}

TEST(ReadJson, blanks_around_the_text_count_lines_alone) {
  refused_json("\n \t\r\n", ErrorCode::truncated, 1, "ends too early");
  refused_json("\n\n{\"items\":\n7}\n\n", ErrorCode::malformed, 4, "array of items");
  refused_json("\n\n{'items':[]}\n", ErrorCode::malformed, 3, "no JSON value at ''items''");
  refused_json(" \n{\"items\":[]}\nmore\n", ErrorCode::malformed, 3, "no JSON value at 'more'");
  refused_json("\n{\"items\":[\n[1,2\n\n", ErrorCode::truncated, 3, "ends too early");
  EXPECT_EQ(read_one("\n {\"type\":\"Point\",\"coordinates\":[1,2]}\n\n", kJson).points, (std::vector<Point>{{1, 2}}));
}

TEST(ReadJson, numbers_must_be_finite) {
  const std::string head = "{\"type\":\"Point\",\n\"coordinates\":[0,\n";
  for (const char* bad : {"1e999", "-1e999", "NaN", "-Infinity", "Infinity", "nan", "inf"}) {
    refused_json(head + bad + "]}", ErrorCode::not_finite, 3, bad);
  }
  EXPECT_EQ(read_one(head + "1e-999]}", kJson).points, (std::vector<Point>{{0, 0}}));
}

TEST(ReadJson, deep_nesting_is_refused_without_recursion) {
  refused_json(std::string(5'000'000, '['), ErrorCode::malformed, 1, "nested deeper than 200");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"items\":";
  refused_json(objects, ErrorCode::malformed, 1, "nested deeper than 200");
}

}  // namespace
}  // namespace dymsum::io_test
