// Euler numbers of shells that touch themselves or each other.
#include "spatial/moving/sum_shape.h"

#include <gtest/gtest.h>

#include "dymsum/solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

using Numbers = std::vector<std::int64_t>;

Mesh two_boxes(double dx, double dy, double dz) {
  MeshData mesh = box(1);
  const MeshData other = moved(box(1), dx, dy, dz);
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Face f : other.faces) {
    for (std::uint32_t& v : f) v += 8;
    mesh.faces.push_back(std::move(f));
  }
  return Mesh::create(std::move(mesh)).value();
}
Numbers numbers(const Mesh& p, const Mesh& q) { return spatial::shell_euler_numbers(minkowski_sum(p, q).value()); }

TEST(ShellEuler, BallsThatTouchInAVertexAreTwo) {
  const Mesh cube = Mesh::create(box(1)).value();
  EXPECT_EQ(numbers(two_boxes(5, 5, 5), cube), (Numbers{2, 2}));
  EXPECT_EQ(numbers(two_boxes(4, 4, 4), cube), (Numbers{2, 2}));
}

/// Around the edge each two faces bound one wedge of the outside, one of either ball.
TEST(ShellEuler, BallsThatTouchAlongAnEdgeAreOneBall) {
  const Mesh cube = Mesh::create(box(1)).value();
  for (const auto& [dx, dy, dz] : {std::array{4.0, 4.0, 0.0}, {4.0, -4.0, 1.0}, {0.0, 4.0, 4.0}, {-4.0, 0.0, 4.0}})
    EXPECT_EQ(numbers(two_boxes(dx, dy, dz), cube), (Numbers{2})) << dx << " " << dy << " " << dz;
}

/// A bent bar whose ends come together along an edge of the sum, or overlap there.
TEST(ShellEuler, AHandleThatClosesAlongAnEdgeIsATunnel) {
  const Mesh cube = Mesh::create(box(0.5)).value();
  const auto bar = [](double gap) {
    return solids::prism({{0, -3},
                          {8, -3},
                          {8, 5},
                          {2 + gap, 5},
                          {2 + gap, 2},
                          {3 + gap, 2},
                          {3 + gap, 4},
                          {7, 4},
                          {7, -2},
                          {1, -2},
                          {1, 1},
                          {0, 1}},
                         1);
  };
  EXPECT_EQ(numbers(bar(0.25), cube), (Numbers{2}));
  EXPECT_EQ(numbers(bar(0), cube), (Numbers{0}));
  EXPECT_EQ(numbers(bar(-0.25), cube), (Numbers{0}));
}

TEST(ShellEuler, TunnelsAndCavities) {
  const Mesh cube = Mesh::create(box(0.5)).value();
  EXPECT_EQ(numbers(Mesh::create(tunnel()).value(), cube), (Numbers{0}));
  EXPECT_EQ(numbers(Mesh::create(cavity()).value(), cube), (Numbers{2, 2}));
}

}  // namespace
}  // namespace dymsum
