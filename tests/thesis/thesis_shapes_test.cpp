#include "thesis/thesis_shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "planar/region/plain_rings.h"
#include "planar/shapes/shape_looks.h"

namespace dymsum::shapes {
namespace {

TEST(ThesisShapes, has_the_sizes_of_figure_3_3) {
  const std::map<std::string, std::size_t> sizes{
      {"airplane", 51}, {"bar", 4},    {"bird", 275},   {"blob", 18},  {"dog", 145},  {"G1", 30},
      {"G2", 34},       {"G3", 24},    {"G4", 43},      {"hand1", 57}, {"hand2", 84}, {"insignia", 4},
      {"sewing", 10},   {"fence", 10}, {"pentagon", 5}, {"star", 44},  {"U", 8}};
  const std::vector<Named> set = thesis_like_set();
  ASSERT_EQ(set.size(), sizes.size());
  std::map<std::string, std::size_t> got;
  for (const Named& shape : set) got[std::string(shape.name)] = shape.region.vertex_count();
  EXPECT_EQ(got, sizes);
}

TEST(ThesisShapes, is_non_convex_but_for_bar_and_pentagon) {
  for (const Named& shape : thesis_like_set()) {
    const int reflex = reflex_count(shape.region.parts().at(0).outer);
    if (shape.name == "bar" || shape.name == "pentagon") {
      EXPECT_EQ(reflex, 0) << shape.name;
    } else {
      EXPECT_GT(reflex, 0) << shape.name;
    }
  }
}

TEST(ThesisShapes, mixes_short_and_full_doubles) {
  int full = 0;
  for (const Named& shape : thesis_like_set()) full += !lies_on_grid(shape.region, 40);
  EXPECT_EQ(full, 4);
}

TEST(ThesisShapes, have_the_same_bits_everywhere) {
  std::map<std::string, std::uint64_t> got;
  for (const Named& shape : thesis_like_set()) got[std::string(shape.name)] = fingerprint(shape.region);
  EXPECT_EQ(got["bird"], 0x826c7ef2eafba96u);
  EXPECT_EQ(got["dog"], 0xc8a4b5a26f0ad092u);
  EXPECT_EQ(got["star"], 0xf9947f985204528du);
}

TEST(ThesisShapes, need_no_sweep) {
  for (const Named& shape : thesis_like_set()) EXPECT_TRUE(planar::plainly_valid(shape.region.data())) << shape.name;
}

}  // namespace
}  // namespace dymsum::shapes
