// Meshes from elsewhere, where they are at hand: in the folder that DYMSUM_DATA names, or in shared/data beside the
// checkout.
#include <cstdio>
#include <cstdlib>

#include "io/mesh_reading.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

fs::path solid_folder() {
  if (const char* named = std::getenv("DYMSUM_DATA")) return fs::path(named) / "solid";
  return fs::path(DYMSUM_SOURCE_DIR) / ".." / "shared" / "data" / "solid";
}

TEST(RealMeshes, EveryOneIsReadAndComesBack) {
  if (!fs::exists(solid_folder())) GTEST_SKIP() << "no real meshes here";
  int valid = 0;
  for (const auto& entry : fs::directory_iterator(solid_folder())) {
    const std::string path = entry.path().string();
    if (!mesh_format(path)) continue;
    const Result<MeshData> data = read_mesh(path);
    ASSERT_TRUE(data.ok()) << data.error().to_string();
    const Result<RepairedMesh> mesh = repair(*data);
    std::printf("%s: %zu vertices, %zu faces, %s\n", entry.path().filename().c_str(), data->vertices.size(),
                data->faces.size(), mesh ? mesh->report.to_string().c_str() : mesh.error().to_string().c_str());
    if (!mesh) continue;
    ++valid;
    const Mesh& solid = mesh->mesh;
    for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
      EXPECT_EQ(read_mesh_text(format_mesh(solid, format), format), solid.data()) << path;
    }
    const Mesh canonical = solid.canonical();
    EXPECT_EQ(canonical.canonical().data(), canonical.data()) << path;
    EXPECT_EQ(volume(canonical), volume(solid)) << path;
    const Result<Mesh> hull = convex_hull(solid.vertices());
    ASSERT_TRUE(hull.ok()) << path;
    EXPECT_EQ(convexity_error(*hull), std::nullopt) << path;
    EXPECT_GE(volume(*hull), volume(solid)) << path;
    EXPECT_EQ(!convexity_error(solid).has_value(), *hull == solid) << path;
  }
  EXPECT_GE(valid, 10);
}

}  // namespace
}  // namespace dymsum::io_test
