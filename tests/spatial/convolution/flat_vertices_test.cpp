// Operands without the vertices inside their faces and edges: the same solids, and the same sums.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "dymsum/solids.h"
#include "oracles/voxel_solids.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using spatial::FlatFeatures;
using spatial::solid_operand;
using spatial::SolidOperand;

MeshData data_of(const SolidOperand& solid) {
  MeshData data;
  data.vertices = solid.vertices;
  for (const spatial::Triangle& t : solid.triangles) data.faces.push_back({t[0], t[1], t[2]});
  return data;
}

/// As a mesh of its own, with the vertices that are used.
Mesh mesh_of(const SolidOperand& solid) {
  const Result<RepairedMesh> mesh = repair(data_of(solid));
  EXPECT_TRUE(mesh.ok());
  return mesh->mesh;
}

/// Bars across as many others, of unit squares.
MeshData grate(int bars) {
  oracles::Voxels voxels;
  const int n = 2 * bars - 1;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < 2; ++z)
        if ((z == 0 ? x : y) % 2 == 0) voxels.insert({x, y, z});
  return oracles::voxel_mesh(voxels);
}

TEST(FlatVertices, are_left_out_and_the_solid_stays) {
  EXPECT_EQ(solid_operand(solids::tessellated_cube(4, 2, solids::kDemoSnap).data()).triangles.size(), 12u);
  const SolidOperand coarse = solid_operand(grate(3));
  const SolidOperand whole_grate = solid_operand(grate(3), {}, FlatFeatures::kept);
  EXPECT_LT(3 * coarse.triangles.size(), 2 * whole_grate.triangles.size());
  for (int k = 0; k < 200; ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
    const MeshData data =
        oracles::voxel_mesh(oracles::random_voxels(3, random)[0], k % 2 == 0 ? oracles::kNoShear : shear);
    const SolidOperand solid = solid_operand(data);
    const Result<Mesh> whole = Mesh::create(data);
    if (!whole) continue;
    const Mesh mesh = mesh_of(solid);
    EXPECT_EQ(volume(mesh), volume(*whole)) << k;
    EXPECT_NEAR(surface_area(mesh), surface_area(*whole), 1e-12 * surface_area(mesh)) << k;
    EXPECT_EQ(solid_operand(data_of(solid)).triangles.size(), solid.triangles.size()) << "nothing flat is left, " << k;
  }
}

TEST(FlatVertices, make_no_difference_to_sums_and_few_facets) {
  const MeshData data = grate(2);
  const SpatialSum fast = spatial::sum_of_solids(data, data, {}).value();
  SpatialOptions brute;
  brute.engine = SpatialEngine::brute;
  const SpatialSum all = spatial::sum_of_solids(data, data, brute).value();
  EXPECT_TRUE(fast == all);
  EXPECT_FALSE(fast.tight_faces.empty());
  EXPECT_LT(fast.stats.face_vertex, all.stats.face_vertex);
  EXPECT_LT(2 * fast.stats.cells, all.stats.cells) << "triangles of one face are not cut apart";
  const MeshData cube = moved(solids::tessellated_cube(1, 4, solids::kDemoSnap).data(), 0.25, 0, 0);
  EXPECT_TRUE(spatial::sum_of_solids(data, cube, {}).value() == spatial::sum_of_solids(cube, data, brute).value());
}

}  // namespace
}  // namespace dymsum
