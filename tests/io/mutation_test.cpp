// Damaged files: an error with file and line, or data; never a crash, a hang, or a changed region.
#include "fuzz/check_reader.h"
#include "io/damage.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

constexpr std::pair<const char*, RegionFormat> kFolders[] = {{"read_poly", RegionFormat::poly},
                                                             {"read_wkt", RegionFormat::wkt},
                                                             {"read_json", RegionFormat::json},
                                                             {"read_svg", RegionFormat::svg},
                                                             {"read_dxf", RegionFormat::dxf}};

void damage(const std::string& folder, RegionFormat format) {
  static const std::vector<std::string> kWords = {"NaN",        "-inf",
                                                  "1e999",      "-1e999",
                                                  "1e-999",     "99999999999999999999",
                                                  "4294967296", "-1",
                                                  "0",          "1.2.3",
                                                  "#",          "(",
                                                  ")",          "[",
                                                  "]",          "{",
                                                  "}",          "\"",
                                                  "<",          ">",
                                                  "'",          ",",
                                                  "EMPTY",      "in",
                                                  "out",        "open",
                                                  "Z",          "M",
                                                  "C",          "null",
                                                  "\n",         "\r\n",
                                                  " ",          std::string(1, '\0'),
                                                  "\xFF",       "&#0;",
                                                  "<!--",       "<![CDATA["};
  expect_damage_is_reported(
      folder, kWords, [&](const std::string& text) { return fuzz::check_reader(text, format); },
      [&](const std::string& text) { return parse_shapes(text, format, "damaged").ok(); });
}

TEST(DamagedFiles, poly) { damage("read_poly", RegionFormat::poly); }
TEST(DamagedFiles, wkt) { damage("read_wkt", RegionFormat::wkt); }
TEST(DamagedFiles, json) { damage("read_json", RegionFormat::json); }
TEST(DamagedFiles, svg) { damage("read_svg", RegionFormat::svg); }
TEST(DamagedFiles, dxf) { damage("read_dxf", RegionFormat::dxf); }

TEST(DamagedFiles, every_truncation_of_every_seed) {
  for (const auto& [folder, format] : kFolders) {
    expect_beginnings_are_reported(folder,
                                   [format = format](const std::string& t) { return fuzz::check_reader(t, format); });
  }
}

TEST(DamagedFiles, a_file_of_one_format_read_as_another) {
  for (const auto& [folder, own] : kFolders) {
    for (const std::string& text : seeds_of(folder)) {
      for (const RegionFormat format : kFormats)
        EXPECT_EQ(fuzz::check_reader(text, format), "") << folder << extension(format);
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
