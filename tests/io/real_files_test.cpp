// The thesis's polygons and real nesting instances, where they are at hand: in the folder that DYMSUM_DATA names, or in
// shared/data beside the checkout.
#include <cstdlib>
#include <map>

#include "io/reading.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  if (const char* named = std::getenv("DYMSUM_DATA")) return named;
  return fs::path(DYMSUM_SOURCE_DIR) / ".." / "shared" / "data";
}

class RealFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(data_folder() / "planar")) GTEST_SKIP() << "no real files here";
  }
  static RegionData read(const std::string& name) {
    auto data = read_region_data((data_folder() / name).string());
    if (!data) {
      ADD_FAILURE() << data.error().to_string();
      return {};
    }
    return std::move(data).value();
  }
};

TEST_F(RealFiles, glued_numbers_agree_with_the_repaired_file) {
  EXPECT_EQ(read("planar/bird_glued_numbers.poly"), read("planar/bird.poly"));
}

TEST_F(RealFiles, every_polygon_is_a_valid_region_of_its_known_size) {
  struct Size {
    std::size_t vertices, holes;
  };
  const std::map<std::string, Size> known = {
      {"beetle", {1285, 0}}, {"bird", {275, 0}},     {"dog", {145, 0}},   {"dragon", {62, 0}},
      {"egg", {64, 0}},      {"fisheye", {816, 3}},  {"hole3", {496, 3}}, {"mammoth", {403, 0}},
      {"monkey", {1204, 0}}, {"neuron", {1815, 18}}, {"star", {44, 0}},   {"star5", {2560, 0}},
      {"texas", {139, 0}},   {"torus1", {96, 1}},    {"torus2", {80, 1}}, {"wierd1", {100, 0}}};
  for (const auto& [file, size] : known) {
    const auto region = Region::create(read("planar/" + file + ".poly"));
    ASSERT_TRUE(region.ok()) << file << ": " << region.error().to_string();
    EXPECT_EQ(region->vertex_count(), size.vertices) << file;
    EXPECT_EQ(region->hole_count(), size.holes) << file;
    for (const RegionFormat format : kFormats) {
      EXPECT_EQ(read_one(format_region(*region, format), format), region->data()) << file << extension(format);
    }
  }
}

TEST_F(RealFiles, nesting_instances_open_as_they_are) {
  const std::map<std::string, std::size_t> known = {{"shirts", 8}, {"swim", 10}, {"trousers", 17}};
  for (const auto& [file, count] : known) {
    const auto shapes = read_shapes((data_folder() / "nesting" / (file + ".json")).string());
    ASSERT_TRUE(shapes.ok()) << shapes.error().to_string();
    EXPECT_EQ(shapes->size(), count) << file;
    for (std::size_t i = 0; i < shapes->size(); ++i) {
      EXPECT_EQ(shapes->at(i).name, std::to_string(i));
      const auto region = Region::create(shapes->at(i).data);  // these files repeat the first vertex
      EXPECT_TRUE(region.ok()) << file << " " << i << ": " << region.error().to_string();
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
