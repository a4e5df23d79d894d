// Solids that touch themselves along edges and at vertices are solids; what overlaps there is not.
#include <gtest/gtest.h>

#include <map>

#include "dymsum/mesh_io.h"
#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

Mesh valid(const MeshData& data) {
  const Result<Mesh> mesh = Mesh::create(data);
  EXPECT_TRUE(mesh.ok()) << (mesh.ok() ? "" : mesh.error().to_string());
  return mesh.ok() ? *mesh : Mesh{};
}

/// Two tetrahedra with a common edge.
MeshData at_an_edge() {
  MeshData data = tetrahedron();
  data.vertices.insert(data.vertices.end(), {{-1, 0, 0}, {0, -1, 0}});
  for (const Face& face : std::vector<Face>{{0, 5, 4}, {0, 4, 3}, {0, 3, 5}, {4, 5, 3}}) data.faces.push_back(face);
  return data;
}

/// Vertices at one position become one.
MeshData merged(const MeshData& data) {
  MeshData result;
  std::map<std::array<double, 3>, std::uint32_t> index;
  for (Face face : data.faces) {
    for (std::uint32_t& v : face) {
      const Point3& p = data.vertices[v];
      const auto [at, added] = index.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(index.size()));
      if (added) result.vertices.push_back(p);
      v = at->second;
    }
    result.faces.push_back(std::move(face));
  }
  return result;
}

MeshData moved(MeshData data, double x, double y, double z) {
  for (Point3& p : data.vertices) p = {p.x + x, p.y + y, p.z + z};
  return data;
}

TEST(MeshTouch, at_an_edge_is_a_solid_of_two_shells) {
  const Mesh mesh = valid(at_an_edge());
  EXPECT_EQ(mesh.shell_count(), 2u);
  EXPECT_EQ(volume(mesh), 1.0 / 3);
  EXPECT_EQ(convexity_error(mesh)->code, ErrorCode::not_convex);
  EXPECT_TRUE(mesh == mesh.canonical());
  EXPECT_EQ(negated(mesh).shell_count(), 2u);
}

TEST(MeshTouch, at_a_vertex_is_a_solid_of_two_shells) {
  const Mesh mesh = valid(merged(joined(cube(), cube(1, {1, 1, 1}))));
  EXPECT_EQ(mesh.vertices().size(), 15u);
  EXPECT_EQ(mesh.shell_count(), 2u);
  EXPECT_EQ(convexity_error(mesh)->code, ErrorCode::not_convex);
}

TEST(MeshTouch, of_one_shell_with_itself) {
  // a ring of cubes in which two neighbours meet in an edge only
  oracles::Voxels ring;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1) ring.insert({x, y, 0});
  ring.erase({0, 0, 0});
  ring.insert({0, 0, 1});
  ring.insert({1, 0, 1});
  const Mesh mesh = valid(oracles::voxel_mesh(ring));
  EXPECT_EQ(mesh.shell_count(), 1u);
  EXPECT_EQ(volume(mesh), 9);
}

TEST(MeshTouch, of_a_cavity_with_the_outside) {
  // along an edge: outside and cavity are one shell; at a vertex alike, but for the fans
  for (const auto& [x, y] : {std::pair{0, 0}, {0, 1}}) {
    oracles::Voxels block;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) block.insert({i, j, k});
    block.erase({1, 1, 1});
    block.erase({x, y, 0});  // seen from the cavity across an edge or a corner
    if (x == 0 && y == 0) block.erase({0, 0, 0});
    const Mesh mesh = valid(oracles::voxel_mesh(block));
    EXPECT_EQ(volume(mesh), 62);
    MeshData reversed = mesh.data();
    for (Face& face : reversed.faces) std::reverse(face.begin(), face.end());
    EXPECT_EQ(Mesh::create(reversed).error().code, ErrorCode::wrong_orientation);
  }
}

/// A tetrahedron that touches another one at each of its vertices: no vertex is its own.
MeshData surrounded(double size) {
  MeshData data = tetrahedron();
  for (Point3& p : data.vertices) p = {size * p.x, size * p.y, size * p.z};
  const MeshData inner = data;
  for (const Point3& at : inner.vertices) {
    // its image under the reflection in the vertex
    MeshData image = turned_inside_out(inner);
    for (Point3& p : image.vertices) p = {2 * at.x - p.x, 2 * at.y - p.y, 2 * at.z - p.z};
    data = joined(data, image);
  }
  return merged(data);
}

TEST(MeshTouch, with_every_vertex_is_nested_right) {
  const Mesh mesh = valid(surrounded(1));
  EXPECT_EQ(mesh.shell_count(), 5u);
  // inside a cavity of a cube, and, turned over, in the solid
  const MeshData around = cube(20, {-10, -10, -10}), hollow = turned_inside_out(cube(16, {-8, -8, -8}));
  EXPECT_EQ(valid(joined(joined(around, hollow), surrounded(1))).shell_count(), 7u);
  EXPECT_EQ(valid(joined(around, turned_inside_out(surrounded(1)))).shell_count(), 6u);
  const Result<Mesh> wrong = Mesh::create(joined(around, surrounded(1)));
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().code, ErrorCode::wrong_orientation);
  EXPECT_EQ(wrong.error().evidence.face, 6);
}

TEST(MeshTouch, that_goes_further_is_refused) {
  // the same vertex, but one tetrahedron reaches through the other's face
  MeshData data = tetrahedron();
  data.vertices.insert(data.vertices.end(), {{0.25, 0.125, 2}, {0.125, 0.25, 2}, {0.5, 0.5, 2}});
  for (const Face& face : std::vector<Face>{{0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}}) data.faces.push_back(face);
  const Result<Mesh> mesh = Mesh::create(data);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::faces_cross);
}

TEST(MeshTouch, of_random_unions_of_cubes) {
  const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
  int touching = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::mt19937_64 random(seed);
    const auto [p, q] = oracles::random_voxels(4, random);
    for (const oracles::Voxels& voxels : {p, q}) {
      const MeshData data = oracles::voxel_mesh(voxels, seed % 2 == 0 ? oracles::kNoShear : shear);
      const Mesh mesh = valid(data);
      EXPECT_EQ(volume(mesh), static_cast<double>(voxels.size())) << "seed " << seed;
      EXPECT_EQ(volume(mesh.canonical()), static_cast<double>(voxels.size())) << "seed " << seed;
      EXPECT_TRUE(valid(mesh.canonical().data()) == mesh) << "seed " << seed;
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces_of_edges;
      for (const Face& f : data.faces)
        for (std::size_t k = 0; k < f.size(); ++k) ++faces_of_edges[std::minmax(f[k], f[(k + 1) % f.size()])];
      touching += std::any_of(faces_of_edges.begin(), faces_of_edges.end(), [](const auto& e) { return e.second > 2; });
      // turned over, no shell is right
      EXPECT_FALSE(Mesh::create(turned_inside_out(data)).ok()) << "seed " << seed;
      EXPECT_TRUE(repair(turned_inside_out(data)).ok()) << "seed " << seed;
      EXPECT_TRUE(repair(turned_inside_out(data))->mesh == mesh) << "seed " << seed;
    }
  }
  EXPECT_GT(touching, 8);
}

TEST(MeshTouch, is_written_and_read_back) {
  const Mesh mesh = valid(merged(joined(at_an_edge(), moved(cube(), 1, 0, 0))));
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl}) {
    EXPECT_FALSE(rounding_error(mesh, format));
    const Result<MeshData> back = parse_mesh(format_mesh(mesh, format), format);
    ASSERT_TRUE(back.ok());
    EXPECT_TRUE(valid(*back) == mesh);
  }
  EXPECT_FALSE(rounding_error(mesh, MeshFormat::glb));
}

TEST(MeshTouch, glb_holds_a_solid_with_a_cavity) {
  EXPECT_FALSE(rounding_error(valid(joined(cube(4), turned_inside_out(cube(1, {1, 1, 1})))), MeshFormat::glb));
}

}  // namespace
}  // namespace dymsum::spatial_test
