// Damaged files: what the tests of readers of regions and of meshes share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace dymsum::io_test {

/// The files of a folder of the corpus, by name.
inline std::vector<std::string> seeds_of(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(DYMSUM_CORPUS_DIR) / folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// One or two changes of a text: cut off, left out, repeated, a word of the format or a part of another file put in, a
/// bit flipped.
class Damage {
 public:
  Damage(std::uint64_t seed, const std::vector<std::string>& words) : random_(seed), words_(words) {}

  std::string operator()(std::string text, const std::string& other) {
    for (std::size_t k = 1 + below(2); k > 0; --k) change(text, other);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void change(std::string& text, const std::string& other) {
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(40, text.size() - at) + 1);
    switch (below(7)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 3:
        text.insert(at, words_[below(words_.size())]);
        break;
      case 4:
        text.replace(at, length, words_[below(words_.size())]);
        break;
      case 5:
        text.insert(at, other.substr(below(other.size()), 30));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << below(8)));
    }
  }

  std::mt19937_64 random_;
  const std::vector<std::string>& words_;
};

/// Damaged seeds of a folder: `problem` of a text is what is wrong with how it is read, nothing being "", and `accepts`
/// whether it is read at all.
template <class Problem, class Accepts>
void expect_damage_is_reported(const std::string& folder, const std::vector<std::string>& words, Problem problem,
                               Accepts accepts) {
  const std::vector<std::string> seeds = seeds_of(folder);
  ASSERT_GE(seeds.size(), 3u);
  int refused = 0, accepted = 0;
  for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
    const std::string text = Damage(seed, words)(seeds[seed % seeds.size()], seeds[(seed / 7) % seeds.size()]);
    ASSERT_EQ(problem(text), "") << folder << ", seed " << seed << "\n" << text;
    ++(accepts(text) ? accepted : refused);
  }
  // both outcomes occur, or this tests nothing
  EXPECT_GT(refused, 500);
  EXPECT_GT(accepted, 100);
}

/// Every beginning of every seed of a folder.
template <class Problem>
void expect_beginnings_are_reported(const std::string& folder, Problem problem) {
  for (const std::string& text : seeds_of(folder)) {
    for (std::size_t size = 0; size <= text.size(); ++size) {
      ASSERT_EQ(problem(text.substr(0, size)), "") << folder << "\n" << text.substr(0, size);
    }
  }
}

}  // namespace dymsum::io_test
