// Damaged files of meshes: an error with file and line (or byte), or data; never a crash, a hang, or a changed mesh.
#include "fuzz/check_mesh_reader.h"
#include "io/damage.h"
#include "io/mesh_reading.h"

namespace dymsum::io_test {
namespace {

std::string folder_of(MeshFormat format) { return "read_" + std::string(extension(format).substr(1)); }

void damage_mesh(MeshFormat format) {
  static const std::vector<std::string> kWords = {" nan ",
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
  expect_damage_is_reported(
      folder_of(format), kWords, [&](const std::string& text) { return fuzz::check_mesh_reader(text, format); },
      [&](const std::string& text) { return parse_mesh(text, format, "damaged").ok(); });
}

TEST(DamagedMeshFiles, off) { damage_mesh(MeshFormat::off); }
TEST(DamagedMeshFiles, obj) { damage_mesh(MeshFormat::obj); }
TEST(DamagedMeshFiles, stl) { damage_mesh(MeshFormat::stl); }
TEST(DamagedMeshFiles, ply) { damage_mesh(MeshFormat::ply); }

TEST(DamagedMeshFiles, every_truncation_of_every_seed) {
  for (const MeshFormat format : kMeshFormats) {
    expect_beginnings_are_reported(folder_of(format),
                                   [&](const std::string& text) { return fuzz::check_mesh_reader(text, format); });
  }
}

TEST(DamagedMeshFiles, a_file_of_one_format_read_as_another) {
  for (const MeshFormat from : kMeshFormats) {
    for (const std::string& text : seeds_of(folder_of(from))) {
      for (const MeshFormat format : kMeshFormats) {
        EXPECT_EQ(fuzz::check_mesh_reader(text, format), "") << extension(from) << " as " << extension(format);
      }
    }
  }
}

}  // namespace
}  // namespace dymsum::io_test
