// Meshes: every planted fault is found, a mesh without faults is one that Mesh::create takes, and one with faults is
// not.
#include "dymsum/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"

namespace dymsum::oracles {
namespace {

std::vector<ErrorCode> codes_of(const MeshCheck& check) {
  std::vector<ErrorCode> codes;
  for (const Error& fault : check.faults) codes.push_back(fault.code);
  return codes;
}

MeshData joined(MeshData a, const MeshData& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += first;
    a.faces.push_back(std::move(face));
  }
  return a;
}

TEST(MeshCheck, RightMeshesPass) {
  const MeshData box = solids::box(0, 0, 0, 1, 2, 3).data();
  const MeshCheck check = check_mesh(box);
  EXPECT_TRUE(check.valid());
  EXPECT_EQ(check.shells, 1u);
  EXPECT_EQ(check.volume, Rational(6));
  EXPECT_TRUE(check_mesh({}).valid());
}

TEST(MeshCheck, EveryPlantedFaultIsFound) {
  MeshData data = solids::box(0, 0, 0, 1, 1, 1).data();
  data.faces.erase(data.faces.begin());  // a hole with four open edges
  EXPECT_EQ(check_mesh(data).open_edges, 4u);
  EXPECT_EQ(codes_of(check_mesh(data)), std::vector<ErrorCode>(4, ErrorCode::not_closed));
  data = solids::box(0, 0, 0, 1, 1, 1).data();
  std::reverse(data.faces[2].begin(), data.faces[2].end());
  EXPECT_EQ(codes_of(check_mesh(data)), std::vector<ErrorCode>(4, ErrorCode::wrong_orientation));
  data = solids::box(0, 0, 0, 1, 1, 1).data();
  data.faces.push_back(data.faces[3]);
  const MeshCheck twice = check_mesh(data);
  ASSERT_EQ(codes_of(twice), std::vector<ErrorCode>{ErrorCode::faces_cross});
  EXPECT_EQ(twice.faults[0].evidence.face, 3);
  EXPECT_EQ(twice.faults[0].evidence.other_face, 6);
  data = solids::box(0, 0, 0, 1, 1, 1).data();
  data.vertices.push_back({5, 5, 5});
  EXPECT_EQ(codes_of(check_mesh(data)), std::vector<ErrorCode>{ErrorCode::bad_index});
  data.vertices.back().x = NAN;
  EXPECT_EQ(codes_of(check_mesh(data)), std::vector<ErrorCode>{ErrorCode::not_finite});
  data.faces.push_back({0, 1, 99});
  EXPECT_EQ(codes_of(check_mesh(data)), (std::vector<ErrorCode>{ErrorCode::not_finite, ErrorCode::bad_index}));
  data = solids::box(0, 0, 0, 1, 1, 1).data();
  for (Face& face : data.faces) std::reverse(face.begin(), face.end());
  EXPECT_EQ(codes_of(check_mesh(data)), std::vector<ErrorCode>{ErrorCode::wrong_orientation});
  EXPECT_EQ(check_mesh(data).volume, Rational(-1));
  data.faces.push_back({});
  data.faces.push_back({0, 1});
  data.faces.push_back({0, 1, 0});
  EXPECT_EQ(codes_of(check_mesh(data)),
            (std::vector<ErrorCode>{ErrorCode::too_few_vertices, ErrorCode::too_few_vertices,
                                    ErrorCode::repeated_vertex, ErrorCode::wrong_orientation}));
}

TEST(MeshCheck, CrossingsAreListedInPairs) {
  const MeshData two = joined(solids::box(0, 0, 0, 2, 2, 2).data(), solids::box(1, 1, 1, 3, 3, 3).data());
  const MeshCheck check = check_mesh(two);
  EXPECT_EQ(check.crossings, 6u);  // three sides of each at the corner of the other, of which each crosses two
  EXPECT_EQ(check.volume, Rational(16));
  for (const Error& fault : check.faults) {
    EXPECT_EQ(fault.code, ErrorCode::faces_cross);
    EXPECT_LT(*fault.evidence.face, 6);
    EXPECT_GE(*fault.evidence.other_face, 6);
    for (const auto& c : {fault.evidence.x, fault.evidence.y, fault.evidence.z}) EXPECT_TRUE(*c >= 1 && *c <= 2);
  }
  MeshCheckOptions few;
  few.listed = 2;
  EXPECT_EQ(check_mesh(two, few).faults.size(), 2u);
  EXPECT_EQ(check_mesh(two, few).count, 6u);
  // The same at one position: both are there twice.
  EXPECT_EQ(check_mesh(joined(two, two)).crossings, 12u + 6u);
}

TEST(MeshCheck, AgreesWithMeshCreateOnBrokenSolids) {
  std::mt19937_64 random(20261130);
  int right = 0, wrong = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int round = 0; round < rounds(40); ++round) {
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(round));
      MeshData data =
          triangulated(round % 2 == 0 ? solids::geodesic_sphere(1, 3) : solids::box(0, 0, 0, 2, 3, 1)).mesh.data();
      for (Point3& p : data.vertices) p = of_kind(p, kind, random);
      const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
      switch (random() % 6) {
        case 0:
          data.faces.erase(data.faces.begin() + static_cast<std::ptrdiff_t>(any(data.faces.size())));
          break;
        case 1:
          std::swap(data.faces[any(data.faces.size())][0], data.faces.back()[1]);
          break;
        case 2:
          data.vertices[any(data.vertices.size())].x += 5;
          break;
        case 3:
          data.vertices[any(data.vertices.size())] = data.vertices[any(data.vertices.size())];
          break;
        case 4:
          data.faces[any(data.faces.size())][0] = static_cast<std::uint32_t>(any(data.vertices.size()));
          break;
        default:
          break;
      }
      const bool valid = Mesh::create(data).ok();
      EXPECT_EQ(check_mesh(data).valid(), valid);
      ++(valid ? right : wrong);
    }
  EXPECT_GT(right, 10);
  EXPECT_GT(wrong, 10);
}

}  // namespace
}  // namespace dymsum::oracles
