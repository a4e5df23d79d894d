// The version is written once, in version.h: what else names it agrees.
#include "dymsum/version.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace dymsum {
namespace {

static_assert(DYMSUM_VERSION_NUMBER ==
              DYMSUM_VERSION_MAJOR * 10000 + DYMSUM_VERSION_MINOR * 100 + DYMSUM_VERSION_PATCH);
static_assert(DYMSUM_VERSION_MINOR < 100 && DYMSUM_VERSION_PATCH < 100,
              "DYMSUM_VERSION_NUMBER has two digits for each");

TEST(Version, TextHasTheNumbers) {
  EXPECT_EQ(std::string(DYMSUM_VERSION), std::to_string(DYMSUM_VERSION_MAJOR) + "." +
                                             std::to_string(DYMSUM_VERSION_MINOR) + "." +
                                             std::to_string(DYMSUM_VERSION_PATCH));
  EXPECT_STREQ(version(), DYMSUM_VERSION);
}

TEST(Version, TheDebianRecipeIsOfIt) {
  std::ifstream file(DYMSUM_SOURCE_DIR "/debian/changelog");
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_TRUE(line.starts_with("dymsum (" DYMSUM_VERSION ") ")) << line;
}

}  // namespace
}  // namespace dymsum
