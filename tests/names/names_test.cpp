// The names of enumerators are those that the public headers declare, all of them and in their order.
#include "dymsum/names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "dymsum/mesh_io.h"
#include "dymsum/planar_sum.h"
#include "names/enumerations.h"

namespace dymsum::names {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// What the headers declare. An enumerator with a value of its own is kept as it is written, which no name equals.
std::vector<Enumerators> declared() {
  std::vector<Enumerators> all;
  const std::regex declaration("enum class (\\w+)[^{;]*\\{([^}]*)\\}"), enumerator("\\w[^,]*[^,\\s]|\\w");
  for (const auto& entry : std::filesystem::directory_iterator(DYMSUM_SOURCE_DIR "/include/dymsum")) {
    const std::string text = std::regex_replace(text_of(entry.path()), std::regex("//[^\\n]*"), "");
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
      const std::string list = (*at)[2];
      Enumerators& made = all.emplace_back((*at)[1], std::vector<std::string>{});
      for (std::sregex_iterator one(list.begin(), list.end(), enumerator); one != end; ++one)
        made.second.push_back(one->str());
    }
  }
  return all;
}

TEST(Names, AreThoseOfTheDeclarations) {
  std::vector<Enumerators> read = declared(), named = enumerations();
  std::sort(read.begin(), read.end());
  std::sort(named.begin(), named.end());
  EXPECT_EQ(named, read);
}

TEST(Names, LeadBack) {
  for (const std::string_view text : names_of<ErrorCode>())
    EXPECT_EQ(name<ErrorCode>(parse<ErrorCode>(text).value()), text);
  EXPECT_EQ(parse<Semantics>("regular"), Semantics::regular);
  EXPECT_EQ(parse<Semantics>("Regular"), std::nullopt);
  EXPECT_EQ(parse<Semantics>(""), std::nullopt);
  static_assert(parse<MeshFormat>("three_mf") == MeshFormat::three_mf && name(MeshFormat::off) == "off");
}

TEST(Names, ThereIsNoneForOtherValues) {
  EXPECT_THROW(static_cast<void>(name(static_cast<Semantics>(3))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(name(static_cast<ErrorCode>(-1))), std::invalid_argument);
}

}  // namespace
}  // namespace dymsum::names
