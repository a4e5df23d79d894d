// What the tests of the readers share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "dymsum/region_io.h"
#include "io/refusal.h"

namespace dymsum::io_test {

inline constexpr RegionFormat kFormats[] = {RegionFormat::poly, RegionFormat::wkt,  RegionFormat::geojson,
                                            RegionFormat::svg,  RegionFormat::json, RegionFormat::dxf};

inline std::string_view extension(RegionFormat format) {
  constexpr std::string_view kNames[] = {".poly", ".wkt", ".geojson", ".svg", ".json", ".dxf"};
  return kNames[static_cast<int>(format)];
}

inline std::vector<NamedShape> read_all(std::string_view text, RegionFormat format) {
  auto shapes = parse_shapes(text, format, "test");
  if (!shapes) {
    ADD_FAILURE() << shapes.error().to_string() << "\n" << text.substr(0, 400);
    return {};
  }
  return std::move(shapes).value();
}

inline RegionData read_one(std::string_view text, RegionFormat format) {
  auto shapes = read_all(text, format);
  if (shapes.size() != 1) {
    ADD_FAILURE() << shapes.size() << " shapes instead of one\n" << text.substr(0, 400);
    return {};
  }
  return std::move(shapes[0].data);
}

/// The reader refuses the text with this code, at this line, and a sentence that contains `words`. Returns the
/// evidence.
inline Evidence expect_refused(std::string_view text, RegionFormat format, ErrorCode code, std::int64_t line,
                               std::string_view words) {
  return expect_refusal(parse_shapes(text, format, kRefusedFile), text, code, line, words);
}

/// A folder of its own that disappears with the test.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("dymsum-" + name + "-" + std::to_string(::getpid()) + "-" +
                                                        std::to_string(reinterpret_cast<std::uintptr_t>(this)))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::size_t file_count() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) count += entry.exists();
    return count;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace dymsum::io_test
