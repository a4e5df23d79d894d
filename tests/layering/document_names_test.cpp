// What the documents name is there: links lead to files, paths to files and folders, names in code type to something in
// the sources; and the map knows every room.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "layering.h"

namespace dymsum::layering {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = DYMSUM_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every page, by its path below the root; docs/results is written by the benchmarks and names their inputs.
std::vector<std::string> pages() {
  std::vector<std::string> found = {"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    const std::string page = fs::relative(entry.path(), kRoot).generic_string();
    if (entry.path().extension() == ".md" && !page.starts_with("docs/results/")) found.push_back(page);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// A page without its blocks of code.
std::string prose(const std::string& page) {
  std::istringstream lines(text_of(kRoot / page));
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) inside = !inside;
    else if (!inside) text += line + "\n";
  }
  return text;
}

/// What matches in a text: the first group of each match.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

std::vector<std::string> in_code_type(const std::string& text) {
  static const std::regex kCode("`([^`\n]+)`");
  return all_matches(text, kCode);
}

/// A file, a folder, or a stem with a header or a source file.
bool is_there(const fs::path& path) {
  return fs::exists(path) || fs::exists(path.string() + ".h") || fs::exists(path.string() + ".cpp");
}

/// The files of the project by which a name in a document is checked.
const std::vector<fs::path>& sources() {
  static const std::vector<fs::path> kSources = [] {
    std::vector<fs::path> found = {kRoot / "run",
                                   kRoot / "CMakeLists.txt",
                                   kRoot / "CMakePresets.json",
                                   kRoot / "pyproject.toml",
                                   kRoot / "docs/guide/report.schema.json",
                                   kRoot / "web/package/index.d.ts"};
    for (const char* top : {"include", "src", "cli", "adapters", "examples", "python", "tests", "bench", "cmake",
                            "web/wasm", "web/package/tests"})
      for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
        if (entry.is_regular_file()) found.push_back(entry.path());
    return found;
  }();
  return kSources;
}

TEST(Documents, LinksLeadToFiles) {
  static const std::regex kLink(R"(\]\(([^)#\s]+)[^)]*\))");
  std::size_t links = 0;
  for (const std::string& page : pages())
    for (const std::string& target : all_matches(prose(page), kLink)) {
      if (target.starts_with("http")) continue;
      ++links;
      EXPECT_TRUE(fs::exists((kRoot / page).parent_path() / target)) << page << ": " << target;
    }
  EXPECT_GE(links, 80U);
}

TEST(Documents, TheReadmeLeadsToEveryGuideAndDesignPage) {
  const std::string readme = text_of(kRoot / "README.md");
  for (const std::string& page : pages()) {
    if (page.starts_with("docs/")) {
      EXPECT_NE(readme.find("(" + page + ")"), std::string::npos) << page;
    }
  }
}

TEST(Documents, PathsAreThere) {
  static const std::set<std::string> kTops = {"base",     "exact", "planar", "cspace",  "spatial", "depth",
                                              "fit",      "io",    "src",    "cli",     "dymsum",  "docs",
                                              "examples", "tests", "bench",  "include", "adapters"};
  static const std::string kEntryOfPackage = "dymsum/live";  // of web/package, by the name that programs import
  static const std::regex kPath("[a-z0-9_./-]+");
  static const std::regex kFile(R"([A-Za-z0-9_-]+\.(h|cpp))");
  std::set<std::string> files;
  for (const fs::path& source : sources()) files.insert(source.filename());
  std::size_t paths = 0;
  for (const std::string& page : pages())
    for (const std::string& name : in_code_type(prose(page))) {
      if (std::regex_match(name, kFile)) {
        EXPECT_TRUE(files.contains(name)) << page << ": " << name;
      } else if (const std::size_t slash = name.find('/'); slash != std::string::npos &&
                                                           kTops.contains(name.substr(0, slash)) &&
                                                           std::regex_match(name, kPath) && name != kEntryOfPackage) {
        EXPECT_TRUE(is_there(kRoot / name) || is_there(kRoot / "src" / name) || is_there(kRoot / "include" / name) ||
                    is_there(kRoot / "adapters/ompl" / name))
            << page << ": " << name;
      } else {
        continue;
      }
      ++paths;
    }
  EXPECT_GE(paths, 100U);
}

TEST(Documents, PagesThatCommentsNameAreThere) {
  static const std::regex kPage(R"(([A-Za-z0-9_/-]+\.md)\b)");
  std::set<std::string> known;
  for (const std::string& page : pages()) known.insert(fs::path(page).filename());
  std::size_t named = 0;
  for (const fs::path& source : sources()) {
    const std::string file = fs::relative(source, kRoot).generic_string();
    if (file.find("tests/") != std::string::npos || file.starts_with("bench/")) continue;
    for (const std::string& page : all_matches(text_of(source), kPage)) {
      ++named;
      const bool whole = page.find('/') != std::string::npos;
      EXPECT_TRUE(whole ? fs::exists(kRoot / page) : known.contains(page)) << file << ": " << page;
    }
  }
  EXPECT_GE(named, 20U);
}

/// The tables of design pages whose last column is headed "file (`FOLDER`)" name files below that folder, or in
/// `tests/`.
TEST(Documents, OutlinesNameFiles) {
  static const std::regex kHead(R"(\|[^|]*file[^|]*\(`([a-z_/]+)/`\) \|$)");
  std::size_t names = 0;
  for (const std::string& page : pages()) {
    std::istringstream lines(text_of(kRoot / page));
    std::string folder;
    for (std::string line; std::getline(lines, line);) {
      std::smatch head;
      if (!line.starts_with("|")) folder.clear();
      else if (std::regex_search(line, head, kHead)) folder = head[1];
      else if (!folder.empty())
        for (const std::string& name : in_code_type(line.substr(line.rfind('|', line.size() - 2)))) {
          ++names;
          EXPECT_TRUE(is_there(kRoot / (name.starts_with("tests/") ? "" : folder) / name))
              << page << ": " << name << " in " << folder;
        }
    }
  }
  EXPECT_GE(names, 120U);
}

/// On the pages in docs/: names with an underscore or an inner capital, qualified or not, are words of the sources or
/// names of their files.
TEST(Documents, NamesInCodeTypeOccurInTheSources) {
  static const std::regex kWord("([A-Za-z_][A-Za-z0-9_]*)");
  static const std::regex kName(R"([A-Za-z_][A-Za-z0-9_]*(::[A-Za-z0-9_]+)*(\(\))?)");
  static const std::regex kSpecific("[a-z0-9]_[a-zA-Z0-9]|[a-z][A-Z]");
  std::set<std::string> words;
  for (const fs::path& source : sources()) {
    words.insert(source.stem());
    const std::string text = text_of(source);
    std::string word;
    for (const char c : text + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
        word += c;
      } else if (!word.empty()) {
        words.insert(word);
        word.clear();
      }
    }
  }
  std::size_t names = 0;
  for (const std::string& page : pages()) {
    if (!page.starts_with("docs/")) continue;
    for (const std::string& name : in_code_type(prose(page))) {
      if (!std::regex_match(name, kName) || !std::regex_search(name, kSpecific)) continue;
      for (const std::string& word : all_matches(name, kWord)) {
        ++names;
        EXPECT_TRUE(words.contains(word)) << page << ": " << name;
      }
    }
  }
  EXPECT_GE(names, 200U);
}

TEST(Documents, TheMapKnowsEveryRoom) {
  std::set<std::string> named;
  for (const std::string& name : in_code_type(text_of(kRoot / "docs/map.md"))) named.insert(name);
  for (const std::string& room : rooms()) EXPECT_TRUE(named.contains(room + "/")) << room;
  for (const std::string& room : other_rooms()) EXPECT_TRUE(named.contains(room + "/")) << room;
}

}  // namespace
}  // namespace dymsum::layering
