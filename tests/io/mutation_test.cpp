// Damaged files: an error with file and line, or data; never a crash, a hang, or a changed region.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/check_reader.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> seeds_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(DYMSUM_CORPUS_DIR) / folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string text, const std::string& other) {
    for (std::size_t k = 1 + below(2); k > 0; --k) mutate(text, other);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void mutate(std::string& text, const std::string& other) {
    static const std::string kWords[] = {"NaN",        "-inf",
                                         "1e999",      "-1e999",
                                         "1e-999",     "99999999999999999999",
                                         "4294967296", "-1",
                                         "0",          "1.2.3",
                                         "#",          "(",
                                         ")",          "[",
                                         "]",          "{",
                                         "}",          "\"",
                                         "<",          ">",
                                         "'",          ",",
                                         "EMPTY",      "in",
                                         "out",        "open",
                                         "Z",          "M",
                                         "C",          "null",
                                         "\n",         "\r\n",
                                         " ",          std::string(1, '\0'),
                                         "\xFF",       "&#0;",
                                         "<!--",       "<![CDATA["};
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
        text.insert(at, kWords[below(std::size(kWords))]);
        break;
      case 4:
        text.replace(at, length, kWords[below(std::size(kWords))]);
        break;
      case 5:
        text.insert(at, other.substr(below(other.size()), 30));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << below(8)));
    }
  }

  std::mt19937_64 random_;
};

void damage(const std::string& folder, RegionFormat format) {
  const std::vector<std::string> seeds = seeds_of(folder);
  ASSERT_FALSE(seeds.empty());
  int refused = 0, accepted = 0;
  for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
    const std::string text = Mutator(seed)(seeds[seed % seeds.size()], seeds[(seed / 7) % seeds.size()]);
    ASSERT_EQ(fuzz::check_reader(text, format), "") << folder << ", seed " << seed << "\n" << text;
    ++(parse_shapes(text, format, "damaged").ok() ? accepted : refused);
  }
  // both outcomes occur, or the damage tests nothing
  EXPECT_GT(refused, 500);
  EXPECT_GT(accepted, 100);
}

TEST(DamagedFiles, poly) { damage("read_poly", RegionFormat::poly); }
TEST(DamagedFiles, wkt) { damage("read_wkt", RegionFormat::wkt); }
TEST(DamagedFiles, json) { damage("read_json", RegionFormat::json); }
TEST(DamagedFiles, svg) { damage("read_svg", RegionFormat::svg); }

TEST(DamagedFiles, every_truncation_of_every_seed) {
  const std::pair<const char*, RegionFormat> kinds[] = {{"read_poly", RegionFormat::poly},
                                                        {"read_wkt", RegionFormat::wkt},
                                                        {"read_json", RegionFormat::json},
                                                        {"read_svg", RegionFormat::svg}};
  for (const auto& [folder, format] : kinds) {
    for (const std::string& text : seeds_of(folder)) {
      for (std::size_t size = 0; size <= text.size(); ++size) {
        ASSERT_EQ(fuzz::check_reader(text.substr(0, size), format), "") << folder << "\n" << text.substr(0, size);
      }
    }
  }
}

TEST(DamagedFiles, a_file_of_one_format_read_as_another) {
  for (const char* folder : {"read_poly", "read_wkt", "read_json", "read_svg"}) {
    for (const std::string& text : seeds_of(folder)) {
      for (const RegionFormat format : kFormats)
        EXPECT_EQ(fuzz::check_reader(text, format), "") << folder << extension(format);
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
