// Solids that were turned in doubles, where faces that were plane are plane but for rounding: their sums are the brute
// engine's, and so are those of a solid with itself turned, exactly or in doubles. DYMSUM_FUZZ_ROTATIONS sets the
// number of rotations of each published mesh, DYMSUM_FUZZ_FACES the size of the largest one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "dymsum/mesh_io.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/spatial_sum.h"
#include "oracles/verdict.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

namespace fs = std::filesystem;

fs::path solid_folder() {
  if (const char* named = std::getenv("DYMSUM_DATA")) return fs::path(named) / "solid";
  return fs::path(DYMSUM_SOURCE_DIR) / ".." / "shared" / "data" / "solid";
}

/// About a random axis, by the quaternion of four random numbers.
struct Turn {
  std::array<double, 9> m;
  explicit Turn(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    const double size = std::sqrt(w * w + x * x + y * y + z * z);
    w /= size, x /= size, y /= size, z /= size;
    m = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
         2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
         2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  }
  MeshData operator()(MeshData mesh) const {
    for (Point3& p : mesh.vertices)
      p = {m[0] * p.x + m[1] * p.y + m[2] * p.z, m[3] * p.x + m[4] * p.y + m[5] * p.z,
           m[6] * p.x + m[7] * p.y + m[8] * p.z};
    return mesh;
  }
};

SpatialSum sum_by(const Mesh& p, const Mesh& q, SpatialEngine engine) {
  SpatialOptions options;
  options.engine = engine;
  return minkowski_sum(p, q, options).value();
}

void expect_what_brute_finds(const Mesh& p, const Mesh& q, const std::string& what) {
  const SpatialSum fast = sum_by(p, q, SpatialEngine::fast), all = sum_by(p, q, SpatialEngine::brute);
  EXPECT_EQ(fast.volume_exact(), all.volume_exact()) << what;
  EXPECT_EQ(fast, all) << what;
}

TEST(TurnedMeshes, published_ones_have_the_volume_that_the_brute_engine_finds) {
  if (!fs::exists(solid_folder())) GTEST_SKIP() << "no published meshes here";
  const std::uint64_t rotations = oracles::setting("DYMSUM_FUZZ_ROTATIONS", 1),
                      most = oracles::setting("DYMSUM_FUZZ_FACES", 400);
  const Mesh tetrahedron =
      Mesh::create({{{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
          .value();
  std::mt19937_64 random(20);
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(solid_folder())) {
    const std::string path = entry.path().string();
    if (!mesh_format(path)) continue;
    const Result<MeshData> data = read_mesh(path);
    if (!data) continue;
    const Result<RepairedMesh> solid = repair(*data);
    if (!solid || solid->mesh.faces().size() > most) continue;
    for (std::uint64_t k = 0; k < rotations; ++k) {
      const Result<Mesh> p = Mesh::create(Turn(random)(solid->mesh.data())),
                         q = Mesh::create(Turn(random)(tetrahedron.data()));
      if (!p || !q) continue;  // a plane face of more than three vertices is none
      ++compared;
      expect_what_brute_finds(*p, *q, path + ", rotation " + std::to_string(k));
    }
  }
  EXPECT_GT(compared, 0);
}

TEST(TurnedMeshes, of_a_solid_with_itself) {
  std::mt19937_64 random(77);
  int compared = 0;
  for (int round = 0; round < 12; ++round) {
    const Mesh solid = random_solids::valid_polyhedron(random);
    const Result<Mesh> turned = Mesh::create(Turn(random)(solid.data()));
    if (!turned) continue;
    const std::string what = "round " + std::to_string(round);
    expect_what_brute_finds(solid, *turned, what);
    // By a rotation as it is: with the quaternion's square as a factor all coordinates are small integers.
    const std::int64_t w = 7, x = 1 + round, y = 2, z = 3, square = w * w + x * x + y * y + z * z;
    SolidPose pose;
    pose.rotation = Rotation::of(w, x, y, z).value();
    MeshData large = solid.data(), rotated = solid.data();
    for (Point3& p : large.vertices) p = {p.x * square, p.y * square, p.z * square};
    for (Point3& p : rotated.vertices)
      p = {(w * w + x * x - y * y - z * z) * p.x + 2 * (x * y - w * z) * p.y + 2 * (x * z + w * y) * p.z,
           2 * (x * y + w * z) * p.x + (w * w - x * x + y * y - z * z) * p.y + 2 * (y * z - w * x) * p.z,
           2 * (x * z - w * y) * p.x + 2 * (y * z + w * x) * p.y + (w * w - x * x - y * y + z * z) * p.z};
    const Rational factor(square);
    EXPECT_EQ(posed_sum(solid, solid, {}, pose)->volume_exact() * factor * factor * factor,
              sum_by(Mesh::create(large).value(), Mesh::create(rotated).value(), SpatialEngine::brute).volume_exact())
        << what;
    ++compared;
  }
  EXPECT_GT(compared, 6);
}

}  // namespace
}  // namespace dymsum
