// Where circles leave cells, in floats: what doubles say, or nothing.
#include "spatial/gauss/ring_bounds.h"

#include <limits>

#include "spatial/convex/convex_cases.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::test {
namespace {

using spatial::Polytope;
using spatial::RingOfEight;
using spatial::Vec3;

Vec3 random_vector(std::mt19937_64& random) {
  std::uniform_real_distribution<double> c(-1, 1);
  const double x = c(random), y = c(random), z = c(random);
  return {x, y, z};
}

TEST(RingOfEight, sides_are_the_same_one_by_one) {
  std::mt19937_64 random(61);
  const float error = static_cast<float>(spatial::kFloatError);
  int proved = 0, left = 0;
  for (int k = 0; k < 2000; ++k) {
    RingOfEight ring{};
    const std::array<float, 3> along = spatial::in_floats(random_vector(random));
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 n = random_vector(random);
      ring.x[i] = static_cast<float>(n.x);
      ring.y[i] = static_cast<float>(n.y);
      ring.z[i] = static_cast<float>(n.z);
    }
    const std::size_t odd = random() % 16;
    if (odd < 8) ring.x[odd] = ring.y[odd] = ring.z[odd] = 1e-7F;
    const spatial::EightSides sides = spatial::eight_sides(ring, along, error);
    ASSERT_EQ(sides, spatial::eight_sides_one_by_one(ring, along, error));
    ASSERT_EQ(sides.proved, odd >= 8) << odd;
    ++proved;
    left += std::popcount(sides.left);
  }
  EXPECT_GT(left, 3 * proved);
  EXPECT_LT(left, 5 * proved);
}

TEST(RingOfEight, edges_are_those_that_doubles_find) {
  std::mt19937_64 random(62);
  const float error = static_cast<float>(spatial::kFloatError);
  std::array<int, 32> found{};
  const std::vector<Mesh> meshes{cube(1),    spindle(7),  spindle(8),
                                 spindle(9), spindle(20), random_round_polytope(random, 200)};
  for (const Mesh& mesh : meshes) {
    const Polytope p = *spatial::make_polytope(mesh);
    for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
      const std::uint32_t begin = p.ring_start[v], size = p.ring_start[v + 1] - begin;
      for (int k = 0; k < 20; ++k) {
        // A circle through a direction inside the cell.
        Vec3 inside;
        for (std::uint32_t i = 0; i < size; ++i)
          inside = inside + (0.1 + 0.01 * static_cast<double>(random() % 90)) * p.ring_normal[begin + i];
        const Vec3 some = cross(inside, random_vector(random)), along = (1 / length(some)) * some;
        const auto value = [&](std::uint32_t slot) { return dot(p.ring_normal[slot], along); };
        const auto sign = [&](std::uint32_t slot) { return value(slot) > 0 ? 1 : -1; };
        const std::uint32_t edge = leaving_edge(p.eight[v], spatial::in_floats(along), error);
        if (edge == spatial::kNoEdge) continue;
        ASSERT_EQ(edge, p.ring[leaving_slot(p, v, along, 1e-12, value, sign)]) << "vertex " << v;
        ++found[size];
      }
      // Through a normal: floats are not asked.
      const Vec3 level = cross(p.ring_normal[begin], random_vector(random)), through = (1 / length(level)) * level;
      ASSERT_EQ(leaving_edge(p.eight[v], spatial::in_floats(through), error), spatial::kNoEdge);
    }
  }
  for (std::size_t size = 3; size <= 8; ++size) EXPECT_GT(found[size], 30) << size;
  for (std::size_t size = 9; size < found.size(); ++size) EXPECT_EQ(found[size], 0) << size;
}

}  // namespace
}  // namespace dymsum::test
