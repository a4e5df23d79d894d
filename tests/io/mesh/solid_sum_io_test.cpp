// Exact results of solids that are read back: the same sets and the same text, and what is none is refused.
#include "dymsum/solid_sum_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "io/damage.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

constexpr std::uint64_t kSolidSumSeed = 20261203;

bool has_tight(const SpatialSum& sum) {
  return !sum.tight_faces.empty() || !sum.tight_segments.empty() || !sum.tight_points.empty();
}

/// Read, written and read: the same text, set, provenance and edges.
SpatialSum expect_read_back(const SpatialSum& sum) {
  const std::string text = solid_sum_to_json(sum);
  EXPECT_TRUE(begins_like_solid_sum(text));
  const Result<SpatialSum> read = parse_solid_sum(text, "x.json");
  if (!read) {
    ADD_FAILURE() << read.error().to_string() << "\n" << text;
    return {};
  }
  EXPECT_TRUE(*read == sum);
  EXPECT_EQ(solid_sum_to_json(*read), text);
  EXPECT_EQ(read->vertex_contacts, sum.vertex_contacts);
  EXPECT_EQ(read->tight_point_contacts, sum.tight_point_contacts);
  return *read;
}

/// Turned, moved by decimals, and in single precision.
Mesh off_the_grid(const Mesh& mesh, int kind) {
  if (kind % 3 == 0) return mesh;
  MeshData data = triangulated(mesh).mesh.data();
  for (Point3& v : data.vertices) {
    v = {0.8 * v.x - 0.6 * v.y + 0.1, 0.6 * v.x + 0.8 * v.y, v.z + 0.01 * v.x};
    if (kind % 3 == 2) v = {double(float(v.x)), double(float(v.y)), double(float(v.z))};
  }
  const Result<Mesh> moved = Mesh::create(data);
  return moved ? *moved : mesh;
}

TEST(SolidSumIo, gives_back_what_was_written) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSolidSumSeed));
  std::mt19937_64 random(kSolidSumSeed);
  int fractions = 0;
  for (int k = 0; k < oracles::rounds(9); ++k) {
    SCOPED_TRACE(k);
    const Mesh a = random_solids::valid_polyhedron(random), b = random_solids::valid_polyhedron(random);
    for (const Result<SpatialSum>& sum : {minkowski_sum(a, b), erode(a, b), difference(a, b)}) {
      const SpatialSum read = expect_read_back(sum.value());
      if (read.faces.empty() || as_mesh(read)) continue;
      ++fractions;
      const Mesh tool = solids::box(0, 0, 0, 1, 1, 1);
      EXPECT_TRUE(minkowski_sum(read, tool).value() == minkowski_sum(*sum, tool).value());
    }
  }
  EXPECT_GT(fractions, oracles::rounds(3));
}

TEST(SolidSumIo, results_that_touch_themselves_and_empty_ones_are_read_back) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  for (const Point3 by : {Point3{1, 1, 0}, Point3{1, 1, 1}, Point3{1, 0.5, 0.25}, Point3{1, 1, 0.5}, Point3{3, 0, 0}})
    expect_read_back(united(std::vector{cube, translated(cube, by.x, by.y, by.z).value()}).value());
  expect_read_back(difference(solids::box(0, 0, 0, 3, 3, 3), solids::box(1, 1, 1, 2, 2, 2)).value());
  expect_read_back(difference(cube, cube).value());
}

TEST(SolidSumIo, results_off_the_grid_are_read_back) {
  const Mesh ell = solids::prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 1);
  for (const int kind : {1, 2}) {
    const Mesh turned = off_the_grid(ell, kind);
    ASSERT_FALSE(turned == ell);
    const SpatialSum sum = minkowski_sum(turned, solids::prism({{0, 0}, {1, 0.3}, {0.2, 0.7}}, 0.4)).value();
    EXPECT_FALSE(as_mesh(expect_read_back(sum)).ok());
  }
}

TEST(SolidSumIo, sums_of_convex_solids_are_read_back) {
  const Mesh ball = solids::geodesic_sphere(2, 1), tool = solids::prism({{0, 0}, {1, 0.3}, {0.2, 0.7}}, 0.4);
  const SpatialSum sum = minkowski_sum(ball, tool).value();
  EXPECT_TRUE(sum.is_convex());
  EXPECT_FALSE(expect_read_back(sum).is_convex());
}

TEST(SolidSumIo, tight_features_are_read_back) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  int tight = 0;
  for (const double x : {0.25, 0.5, 1.0, 2.0})
    for (const double y : {0.25, 1.0})
      for (const double z : {0.1, 1.0})
        tight += has_tight(expect_read_back(erode(cube, solids::box(0, 0, 0, x, y, z)).value()));
  const Mesh slotted = solids::prism({{0, 0}, {7, 0}, {7, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {0, 3}}, 2);
  tight += has_tight(expect_read_back(minkowski_sum(slotted, solids::box(0, 0, 0, 1, 1, 1)).value()));
  EXPECT_EQ(tight, 11);
}

TEST(SolidSumIo, a_result_in_fractions_is_opened_closed_and_offset_as_it_is) {
  const Mesh ell = solids::prism({{0, 0}, {3, 0.1}, {3, 1}, {1.1, 1.3}, {1, 3}, {0, 3}}, 1);
  const SpatialSum sum = minkowski_sum(ell, solids::prism({{0, 0}, {1, 0.3}, {0.2, 0.7}}, 0.4)).value();
  ASSERT_FALSE(as_mesh(sum).ok());
  const SpatialSum read = expect_read_back(sum);
  const Mesh tool = solids::box(0, 0, 0, 0.25, 0.5, 0.25);
  EXPECT_TRUE(opening(read, tool)->solid == minkowski_sum(erode(sum, tool).value(), tool).value());
  EXPECT_TRUE(closing(read, tool)->solid == erode(minkowski_sum(sum, tool).value(), tool).value());
  const SolidOffset grown = offset(read, 0.5, 0.1).value();
  EXPECT_TRUE(grown.solid == minkowski_sum(sum, tessellated_ball(0.5, 0.1)->mesh).value());
  EXPECT_GT(grown.solid.volume(), sum.volume());
}

/// A text with one part in place of another one.
std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), other);
}
std::string replaced(std::string text, const std::string& part, const std::string& other) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += other.size())
    text.replace(at, part.size(), other);
  return text;
}
void refuses_sum(const std::string& text, ErrorCode code, const std::string& words) {
  const Result<SpatialSum> read = parse_solid_sum(text, "x.json");
  ASSERT_FALSE(read.ok()) << text;
  EXPECT_EQ(read.error().code, code) << read.error().to_string();
  EXPECT_NE(read.error().to_string().find(words), std::string::npos) << read.error().to_string();
  EXPECT_EQ(read.error().evidence.file, "x.json");
}

TEST(SolidSumIo, refuses_what_is_no_result_with_its_position) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  const std::string text = solid_sum_to_json(minkowski_sum(cube, cube).value());
  const auto refuses = [&](const std::string& part, const std::string& other, const std::string& words) {
    refuses_sum(with(text, part, other), ErrorCode::malformed, words);
  };
  refuses_sum("", ErrorCode::truncated, "");
  refuses_sum(text.substr(0, text.size() / 2), ErrorCode::truncated, "");
  refuses("\"vertex_list\"", "\"vertices_\"", "no 'vertex_list'");
  refuses("\"exact\":[\"0/1\",\"0/1\",\"0/1\"]", "\"exact\":[\"0/1\",\"0/1\"]", "not 3");
  refuses("\"exact\":[\"0/1\",\"0/1\",\"0/1\"]", "\"exact\":[\"-1/3\",\"0/1\",\"0/1\"]", "is not plane");
  refuses("\"exact\":[\"0/1\",\"0/1\",\"0/1\"]", "\"exact\":[\"3/1\",\"0/1\",\"0/1\"]", "order of x, y, z");
  refuses("\"exact\":[\"0/1\",\"0/1\",\"0/1\"]", "\"exact\":[\"0/0\",\"0/1\",\"0/1\"]", "no exact coordinate");
  refuses("\"exact\":[\"0/1\",\"0/1\",\"0/1\"]", "\"exact\":[\"" + std::string(30000, '1') + "\",\"0/1\",\"0/1\"]",
          "30000 characters");
  refuses_sum(with(text, "\"exact\":[\"2/1\",\"2/1\",\"2/1\"]", "\"exact\":[\"1e400\",\"2/1\",\"2/1\"]"),
              ErrorCode::unsupported_operand, "larger than 2^1000");
  refuses("\"shells\":1", "\"shells\":2", "1 shells, not 2");
  refuses("\"shell\":0,\"loops\":[[0,", "\"shell\":1,\"loops\":[[0,", "the index of a shell");
  refuses("\"loops\":[[0,", "\"loops\":[[8,", "vertices below 8");
  refuses("\"loops\":[[0,", "\"loops\":[[0.5,", "vertices below 8");
  refuses("\"edge_list\":[\n{\"vertices\":[0,1]", "\"edge_list\":[\n{\"vertices\":[0,3]", "those of the faces");
  EXPECT_FALSE(begins_like_solid_sum("{\"parts\":[]}"));
  EXPECT_EQ(read_solid_sum("/nowhere/x.json").error().code, ErrorCode::cannot_open);
}

TEST(SolidSumIo, refuses_surfaces_that_bound_no_solid) {
  const Mesh cube = solids::box(0, 0, 0, 2, 2, 2);
  const SpatialSum one = united(std::vector{cube}).value();
  SpatialSum turned = one;
  for (SpatialFace& face : turned.faces)
    for (auto& loop : face.loops) std::reverse(loop.begin() + 1, loop.end());
  refuses_sum(solid_sum_to_json(turned), ErrorCode::malformed, "none of a result");
  SpatialSum swapped = one;
  std::swap(swapped.faces[0], swapped.faces[1]);
  refuses_sum(solid_sum_to_json(swapped), ErrorCode::malformed, "face 0");
  // Two cubes apart; moved so that they overlap, the lists are still in their order.
  const SpatialSum apart = united(std::vector{cube, solids::box(1, 10, 10, 3, 12, 12)}).value();
  const std::string text = solid_sum_to_json(apart);
  ASSERT_TRUE(parse_solid_sum(text, "x.json").ok());
  const std::string overlapping = replaced(replaced(text, "\"10/1\"", "\"1/1\""), "\"12/1\"", "\"3/1\"");
  refuses_sum(overlapping, ErrorCode::malformed, "none of a result");
}

TEST(SolidSumIo, damaged_texts_are_refused_or_results) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSolidSumSeed));
  const Mesh cube = solids::box(0, 0, 0, 3, 3, 3), peg = solids::box(0, 0, 0, 1, 1, 3);
  const std::string text = solid_sum_to_json(erode(cube, peg).value()),
                    other = solid_sum_to_json(difference(cube, solids::box(1, 1, -1, 2, 2, 4)).value());
  const std::vector<std::string> words{"[", "]", "null", "\"1/3\"", "{\"face\":0}", "-1", "7", "\"loops\"", "[0,1,2]"};
  io_test::Damage damage(kSolidSumSeed, words);
  int refused = 0;
  for (int k = 0; k < oracles::rounds(600); ++k) {
    const Result<SpatialSum> read = parse_solid_sum(k % 2 ? damage(text, other) : damage(other, text), "x.json");
    refused += !read;
    if (!read) continue;
    EXPECT_TRUE(parse_solid_sum(solid_sum_to_json(*read), "y.json").value() == *read);
  }
  EXPECT_GT(refused, oracles::rounds(400));
}

}  // namespace
}  // namespace dymsum
