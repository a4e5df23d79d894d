// The words that the glossary lists as not used: names and comments of the library and the command line hold no more of
// them than allowed.txt grants. Its counts may only fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dymsum {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = DYMSUM_SOURCE_DIR;

/// How often a word stands in names, and in comments.
using Counts = std::map<std::string, std::array<std::size_t, 2>>;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// The words of the glossary's last table, each to the first one of its row, by which the row is counted.
std::map<std::string, std::string> unused_words() {
  std::istringstream lines(text_of(kRoot / "docs/glossary.md"));
  std::map<std::string, std::string> words;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) inside = line == "## Words that are not used";
    if (!inside || !line.starts_with("| ") || line.starts_with("| not used")) continue;
    std::istringstream cell(line.substr(2, line.find(" |", 2) - 2));
    std::string first;
    for (std::string word; std::getline(cell, word, ',');) {
      word.erase(0, word.find_first_not_of(' '));
      if (first.empty()) first = word;
      words[word] = first;
    }
  }
  return words;
}

class Counter {
 public:
  explicit Counter(std::map<std::string, std::string> words) : words_(std::move(words)) {
    for (const auto& [word, row] : words_) counts_[row];
  }

  /// Counts what a source has outside of its strings and characters.
  void read(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
      if (text.substr(at).starts_with("//")) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        count(text.substr(at, end - at), 1);
        at = end;
      } else if (text.substr(at).starts_with("R\"(")) {
        at = std::min(text.find(")\"", at), text.size());
      } else if (text[at] == '"') {
        for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at) at += text[at] == '\\';
        ++at;
      } else {
        const std::size_t end = std::min(text.find_first_of("\"/", at + 1), text.size());
        count(text.substr(at, end - at), 0);
        at = end;
      }
    }
  }

  const Counts& counts() const { return counts_; }

 private:
  /// `SideOfBorder` and `side_of_border` are three words each.
  void count(std::string_view text, std::size_t where) {
    for (std::size_t at = 0; at < text.size();) {
      if (!is_letter(text[at])) {
        ++at;
        continue;
      }
      std::size_t end = at + 1;
      while (end < text.size() && is_letter(text[end]) && !is_upper(text[end])) ++end;
      std::string word(text.substr(at, end - at));
      word[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[0])));
      if (const auto known = words_.find(word); known != words_.end()) ++counts_[known->second][where];
      at = end;
    }
  }

  std::map<std::string, std::string> words_;
  Counts counts_;
};

Counts counted() {
  Counter counter(unused_words());
  for (const char* top : {"include", "src", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".h" || extension == ".cpp") counter.read(text_of(entry.path()));
    }
  }
  return counter.counts();
}

Counts allowed() {
  std::istringstream lines(text_of(kRoot / "tests/vocabulary/allowed.txt"));
  Counts counts;
  std::string word;
  for (std::size_t names = 0, comments = 0; lines >> word >> names >> comments;) counts[word] = {names, comments};
  return counts;
}

TEST(Vocabulary, NoMoreUnusedWordsThanAreAllowed) {
  const Counts found = counted(), most = allowed();
  ASSERT_GT(found.size(), 5U);
  for (const auto& [word, counts] : found) {
    const auto known = most.find(word);
    ASSERT_NE(known, most.end()) << word << " has no line in tests/vocabulary/allowed.txt";
    EXPECT_LE(counts[0], known->second[0]) << "names with \"" << word << "\": docs/glossary.md says what to write";
    EXPECT_LE(counts[1], known->second[1]) << "comments with \"" << word << "\": docs/glossary.md says what to write";
  }
  EXPECT_EQ(found.size(), most.size()) << "allowed.txt has words that the glossary does not list";
}

TEST(Vocabulary, WordsOfNamesAndCommentsAreCountedAndThoseOfStringsAreNot) {
  Counter counter({{"border", "border"}, {"borders", "border"}, {"sure", "sure"}});
  counter.read(
      "int side_of_border = SureBorder(\"a border \\\" border\");  // Borders, borderline and a border\nkSure / x;\n");
  EXPECT_EQ(counter.counts(), (Counts{{"border", {2, 2}}, {"sure", {2, 0}}}));
}

}  // namespace
}  // namespace dymsum
