// The order of the rooms holds in this checkout, and a tree that breaks it in every way is caught.
#include "layering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace dymsum::layering {
namespace {

std::string text_of(const Violation& v) {
  return v.file + ":" + std::to_string(v.line) + ": " + v.include + ": " + v.why;
}

TEST(Layering, RoomsUseOnlyWhatStandsBeforeThem) {
  const Reading reading = read_tree(DYMSUM_SOURCE_DIR);
  EXPECT_GT(reading.files, 30U);
  for (const Violation& violation : reading.violations) ADD_FAILURE() << text_of(violation);
}

TEST(Layering, EveryKindOfViolationIsFound) {
  const Reading reading = read_tree(DYMSUM_SOURCE_DIR "/tests/layering/fixture");
  std::vector<std::string> found;
  for (const Violation& violation : reading.violations) found.push_back(text_of(violation));
  const std::vector<std::string> expected = {
      "cli/reaches_inside.cpp:3: \"exact/number.h\": only public headers may be used here",
      "examples/reaches_inside.cpp:2: \"exact/number.h\": only public headers may be used here",
      "include/dymsum/uses_a_room.h:4: \"exact/number.h\": public headers include only the standard library and each "
      "other",
      "include/dymsum/uses_boost.h:3: <boost/multiprecision/cpp_int.hpp>: a foreign header that this room may not use",
      "src/exact/looks_up.cpp:3: \"planar/region/shape.h\": room planar/region stands after room exact",
      "src/exact/looks_up.cpp:4: <gmpxx.h>: a foreign header that this room may not use",
      "src/exact/looks_up.cpp:5: \"planar/region/missing.h\": no such file",
      "src/exact/looks_up.cpp:6: \"dymsum/missing.h\": no such public header",
      "src/exact/looks_up.cpp:7: \"../planar/shape.h\": no such room",
      "src/planar/arrangement/hears_of_convolutions.cpp:2: \"planar/convolution/turns.h\": room planar/arrangement "
      "knows "
      "nothing of room planar/convolution",
      "src/planar/in_no_room.cpp:0: : no such room",
      "src/planar/region/looks_down.cpp:2: \"planar/window/window.h\": room planar/window stands after room "
      "planar/region",
      "src/utils/anything.h:0: : no such room",
  };
  EXPECT_EQ(found, expected);
}

TEST(Layering, WhatIsAllowedIsNotReported) {
  const Reading reading = read_tree(DYMSUM_SOURCE_DIR "/tests/layering/fixture");
  const auto mentions = [&](const std::string& file) {
    return std::any_of(reading.violations.begin(), reading.violations.end(),
                       [&](const Violation& v) { return v.file == file; });
  };
  EXPECT_FALSE(mentions("src/planar/region/shape.h"));
  EXPECT_FALSE(mentions("src/planar/window/window.h"));
  EXPECT_EQ(reading.files, 15U);
}

// What the standard library of Debian 12's emscripten lacks, and the others here do not: base has what is needed.
TEST(Layering, SourcesUseWhatEveryStandardLibraryHas) {
  std::size_t read = 0;
  for (const char* folder : {"include", "src", "cli", "web/wasm"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(DYMSUM_SOURCE_DIR "/" + std::string(folder))) {
      const std::string name = entry.path().string();
      if (!entry.is_regular_file() || !(name.ends_with(".h") || name.ends_with(".cpp"))) continue;
      std::ifstream file(name);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      for (const char* lacking :
           {"std::bit_cast<", "std::format(", "std::jthread", "std::ranges::", "std::execution::"})
        EXPECT_EQ(text.find(lacking), std::string::npos) << name << ": " << lacking;
      ++read;
    }
  EXPECT_GT(read, 900U);
}

TEST(Layering, OneHeaderHasAllPublicOnes) {
  const std::string folder = DYMSUM_SOURCE_DIR "/include/dymsum/";
  std::ifstream file(folder + "dymsum.h");
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_list = name == "names.h" || name == "field.h" || name.ends_with("fields.h");
    if (is_list || name == "dymsum.h") continue;
    EXPECT_NE(all.find("#include \"dymsum/" + name + "\"\n"), std::string::npos) << name;
    ++found;
  }
  EXPECT_GT(found, 50U);
}

}  // namespace
}  // namespace dymsum::layering
