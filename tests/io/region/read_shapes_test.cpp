// Paths, extensions and selection.
#include <fstream>

#include "io/reading.h"

namespace dymsum::io_test {
namespace {

void save(const std::string& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

Error error_of(const std::string& path) {
  const auto data = read_region_data(path);
  if (data) {
    ADD_FAILURE() << path << " was read";
    return {};
  }
  return data.error();
}

constexpr std::string_view kTwoItems =
    R"({"items":[{"id":5,"shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]}},
                 {"id":"hook","shape":{"type":"simple_polygon","data":[[5,5],[6,5],[5,6]]}}]})";

TEST(RegionFormatOfPath, the_extension_decides) {
  for (const RegionFormat format : kFormats) {
    EXPECT_EQ(region_format("some.dir/a" + std::string(extension(format))).value(), format);
    EXPECT_EQ(region_format("a" + std::string(extension(format)) + "#3").value(), format);
  }
  EXPECT_EQ(region_format("A.POLY").value(), RegionFormat::poly);
  EXPECT_EQ(region_format(".wkt").value(), RegionFormat::wkt);
}

TEST(RegionFormatOfPath, other_extensions_are_unsupported) {
  for (const char* path : {"a.off", "a", "", "-", "dir.poly/a", "a.json/b", "a.poly.xz", "a.txt#b"}) {
    const auto format = region_format(path);
    ASSERT_FALSE(format.ok()) << path;
    EXPECT_EQ(format.error().code, ErrorCode::unsupported_format) << path;
    EXPECT_EQ(format.error().evidence.file, path);
  }
}

TEST(ReadShapes, a_file_by_its_path) {
  const Folder folder("read");
  save(folder / "tri.wkt", "POLYGON ((0 0, 1 0, 0 1, 0 0))");
  const auto shapes = read_shapes(folder / "tri.wkt");
  ASSERT_TRUE(shapes.ok()) << shapes.error().to_string();
  ASSERT_EQ(shapes->size(), 1u);
  EXPECT_EQ(shapes->at(0).name, "tri");
  EXPECT_EQ(read_region_data(folder / "tri.wkt").value(), shapes->at(0).data);
}

TEST(ReadShapes, one_shape_is_selected_by_name_or_place) {
  const Folder folder("select");
  save(folder / "two.json", kTwoItems);
  EXPECT_EQ(read_shapes(folder / "two.json").value().size(), 2u);
  const Ring first{{0, 0}, {1, 0}, {0, 1}}, second{{5, 5}, {6, 5}, {5, 6}};
  EXPECT_EQ(read_region_data(folder / "two.json#hook").value().parts.at(0).outer, second);
  EXPECT_EQ(read_region_data(folder / "two.json#5").value().parts.at(0).outer, first);
  EXPECT_EQ(read_region_data(folder / "two.json#1").value().parts.at(0).outer, second);
}

TEST(ReadShapes, a_selection_must_name_one_shape) {
  const Folder folder("select");
  save(folder / "two.json", kTwoItems);
  save(folder / "same.json",
       R"({"items":[{"id":1,"shape":{"type":"multi_polygon","data":[]}},
                 {"id":1,"shape":{"type":"multi_polygon","data":[]}}]})");
  save(folder / "none.json", R"({"items":[]})");
  const Error several = error_of(folder / "two.json");
  EXPECT_EQ(several.code, ErrorCode::malformed);
  EXPECT_EQ(several.evidence.file, folder / "two.json");
  EXPECT_NE(several.message.find("holds 2 shapes"), std::string::npos);
  for (const char* wrong : {"two.json#2", "two.json#eye", "two.json#", "same.json#1", "none.json"}) {
    EXPECT_EQ(error_of(folder / wrong).code, ErrorCode::malformed) << wrong;
  }
  EXPECT_NE(error_of(folder / "same.json#1").message.find("2 shapes are named"), std::string::npos);
}

TEST(ReadShapes, a_file_with_a_number_sign_in_its_name) {
  const Folder folder("sign");
  save(folder / "part#7.wkt", "POINT (1 2)");
  EXPECT_EQ(read_region_data(folder / "part#7.wkt").value().points, (std::vector<Point>{{1, 2}}));
}

TEST(ReadShapes, files_that_cannot_be_opened) {
  const Folder folder("open");
  const Error missing = error_of(folder / "missing.poly");
  EXPECT_EQ(missing.code, ErrorCode::cannot_open);
  EXPECT_EQ(missing.evidence.file, folder / "missing.poly");
  EXPECT_NE(missing.message.find("No such file"), std::string::npos);
  std::filesystem::create_directory(folder / "dir.poly");
  const Error directory = error_of(folder / "dir.poly");
  EXPECT_EQ(directory.code, ErrorCode::cannot_open);
  EXPECT_NE(directory.message.find("directory"), std::string::npos);
  EXPECT_EQ(error_of(folder / "picture.png").code, ErrorCode::unsupported_format);
}

TEST(ReadShapes, errors_name_the_file_as_it_was_given) {
  const Folder folder("errors");
  save(folder / "bad.poly", "1\n3 out\n0 0\n1 x\n");
  const Error error = error_of(folder / "bad.poly");
  EXPECT_EQ(error.code, ErrorCode::malformed);
  EXPECT_EQ(error.evidence.file, folder / "bad.poly");
  EXPECT_EQ(error.evidence.line, 4);
  EXPECT_EQ(error.to_string().rfind((folder / "bad.poly") + ":4: ", 0), 0u) << error.to_string();
}

TEST(ReadShapes, long_lists_in_every_text_format) {
  for (const RegionFormat format : {RegionFormat::poly, RegionFormat::wkt, RegionFormat::geojson, RegionFormat::json}) {
    std::string text = format == RegionFormat::poly  ? "1\n200000 points\n"
                       : format == RegionFormat::wkt ? "MULTIPOINT ("
                                                     : R"({"type":"MultiPoint","coordinates":[)";
    const bool json = format == RegionFormat::geojson || format == RegionFormat::json;
    for (int k = 0; k < 200000; ++k) {
      const std::string x = std::to_string(k), y = std::to_string(-k);
      if (k > 0) text += format == RegionFormat::poly ? "\n" : ",";
      text += json ? "[" + x + "," + y + "]" : x + " " + y;
    }
    text += json ? "]}" : format == RegionFormat::wkt ? ")" : "\n";
    const RegionData read = read_one(text, format);
    ASSERT_EQ(read.points.size(), 200000u) << extension(format);
    EXPECT_EQ(read.points.back(), (Point{199999, -199999}));
  }
}

}  // namespace
}  // namespace dymsum::io_test
