// No two types of the sources have one full name. Of functions that two such types instantiate alike, as push_back of
// their vectors, the linker takes one: what the other type's callers then do depends on what the compiler has inlined.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace dymsum::layering {
namespace {

namespace fs = std::filesystem;

using Positions = std::map<std::string, std::set<std::string>>;

/// The types that a file defines in namespaces with names, as the sources are laid out: namespaces are not indented,
/// and end with a comment.
void add_types(const std::string& text, const std::string& file, Positions& positions) {
  static const std::regex kNamespace("^namespace ?([a-z_:]*) ?\\{"), kEnd("^\\}  // namespace.*"),
      kType(
          "^(?:struct|class|enum class|enum) (?:alignas\\([^)]*\\) )?([A-Za-z0-9_:]+)(?: final)?(?: : [^;{]*)?(?: "
          "\\{.*)?$");
  std::vector<std::string> inside;
  std::istringstream lines(text);
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, found, kNamespace) && line.find('}') == std::string::npos) {
      inside.push_back(found[1]);
    } else if (std::regex_match(line, kEnd)) {
      if (!inside.empty()) inside.pop_back();
    } else if (std::regex_match(line, found, kType)) {
      std::string name;
      bool named = true;
      for (const std::string& part : inside) {
        named = named && !part.empty();
        name += part + "::";
      }
      if (named) positions[name + found[1].str()].insert(file);
    }
  }
}

Positions types_below(const std::vector<std::string>& folders) {
  const fs::path root = DYMSUM_SOURCE_DIR;
  Positions positions;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path(), std::ios::binary);
      std::stringstream text;
      text << in.rdbuf();
      add_types(text.str(), fs::relative(entry.path(), root).generic_string(), positions);
    }
  return positions;
}

TEST(OneDefinition, TypesAreFoundWithTheirNamespaces) {
  Positions positions;
  add_types(
      "namespace a::b {\nstruct S {\n};\nnamespace {\nclass T : public S {\n};\n}  // namespace\nenum class E : int { "
      "x };\nclass F;\n}  // namespace a::b\n",
      "f.h", positions);
  add_types("namespace a::b {\nstruct S {};\n}  // namespace a::b\nnamespace a {\nstruct S {\n};\n}  // namespace a\n",
            "g.h", positions);
  EXPECT_EQ(positions, (Positions{{"a::S", {"g.h"}}, {"a::b::S", {"f.h", "g.h"}}, {"a::b::E", {"f.h"}}}));
}

TEST(OneDefinition, NoTwoTypesOfTheSourcesHaveOneName) {
  const Positions positions = types_below({"include", "src", "cli", "web/wasm", "adapters", "python/src"});
  EXPECT_GT(positions.size(), 800U);
  for (const auto& [name, files] : positions) {
    std::string all;
    for (const std::string& file : files) all += " " + file;
    EXPECT_EQ(files.size(), 1U) << name << " is defined in" << all;
  }
}

}  // namespace
}  // namespace dymsum::layering
