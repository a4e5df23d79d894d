// Damaged files of meshes: an error with file and line (or byte), or data; never a crash, a hang, or a changed mesh.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/check_mesh_reader.h"
#include "io/mesh_reading.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

std::string folder_of(MeshFormat format) { return "read_" + std::string(extension(format).substr(1)); }

std::vector<std::string> mesh_seeds_of(MeshFormat format) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(DYMSUM_CORPUS_DIR) / folder_of(format))) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t k = 1 + below(2); k > 0; --k) mutate(text);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void mutate(std::string& text) {
    static const std::string kWords[] = {" nan ",
                                         " -inf ",
                                         " 1e999 ",
                                         " 99999999999999999999 ",
                                         " 4294967296 ",
                                         " -1 ",
                                         " 0 ",
                                         "1.2.3",
                                         "#",
                                         "\n",
                                         "\r\n",
                                         " ",
                                         std::string(1, '\0'),
                                         "\xFF\xFF\xFF\xFF",
                                         "/",
                                         "f 1 2 3\n",
                                         "v 1 2 3\n",
                                         "facet",
                                         "vertex",
                                         "list",
                                         "OFF",
                                         "endsolid"};
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(40, text.size() - at) + 1);
    switch (below(6)) {
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
      default:
        if (at < text.size()) text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << below(8)));
    }
  }

  std::mt19937_64 random_;
};

void damage_mesh(MeshFormat format) {
  const std::vector<std::string> seeds = mesh_seeds_of(format);
  ASSERT_GE(seeds.size(), 3u);
  int refused = 0, accepted = 0;
  for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
    const std::string text = Damage(seed)(seeds[seed % seeds.size()]);
    ASSERT_EQ(fuzz::check_mesh_reader(text, format), "") << extension(format) << ", seed " << seed << "\n" << text;
    ++(parse_mesh(text, format, "damaged").ok() ? accepted : refused);
  }
  // both outcomes occur, or the damage_mesh tests nothing
  EXPECT_GT(refused, 500);
  EXPECT_GT(accepted, 100);
}

TEST(DamagedMeshFiles, off) { damage_mesh(MeshFormat::off); }
TEST(DamagedMeshFiles, obj) { damage_mesh(MeshFormat::obj); }
TEST(DamagedMeshFiles, stl) { damage_mesh(MeshFormat::stl); }
TEST(DamagedMeshFiles, ply) { damage_mesh(MeshFormat::ply); }

TEST(DamagedMeshFiles, every_truncation_of_every_seed) {
  for (const MeshFormat format : kMeshFormats) {
    for (const std::string& text : mesh_seeds_of(format)) {
      for (std::size_t size = 0; size <= text.size(); ++size) {
        ASSERT_EQ(fuzz::check_mesh_reader(text.substr(0, size), format), "") << extension(format) << "\n" << size;
      }
    }
  }
}

TEST(DamagedMeshFiles, a_file_of_one_format_read_as_another) {
  for (const MeshFormat from : kMeshFormats) {
    for (const std::string& text : mesh_seeds_of(from)) {
      for (const MeshFormat format : kMeshFormats) {
        EXPECT_EQ(fuzz::check_mesh_reader(text, format), "") << extension(from) << " as " << extension(format);
      }
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
