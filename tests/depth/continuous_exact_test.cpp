// The exact square of the shortest way out at poses that doubles cannot place: rounded points of the sum's own faces.
// The independent answers are contains (collision of interiors) and SolidDepth's search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <tuple>

#include "dymsum/continuous_depth.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

/// The solid turned and times the rotation's norm: exact for small integers.
Mesh turned_and_scaled(const Mesh& mesh, const Rotation& r) {
  MeshData data = mesh.data();
  const std::array<std::int64_t, 9> m = r.matrix();
  for (Point3& v : data.vertices) {
    const Point3 x = v;
    const auto row = [&](std::size_t k) {
      return static_cast<double>(m[k]) * x.x + static_cast<double>(m[k + 1]) * x.y +
             static_cast<double>(m[k + 2]) * x.z;
    };
    v = {row(0), row(3), row(6)};
  }
  return Mesh::create(data).value();
}

Point3 on_some_face(const SpatialSum& sum, double scale, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::vector<std::uint32_t>& loop = sum.faces[below(sum.faces.size())].loops.front();
  // A corner, or on an edge, or a mean of three corners.
  const std::size_t first = below(loop.size()), kind = below(3);
  Point3 at = sum.vertices[loop[first]];
  double count = 1;
  for (std::size_t k = 1; k <= kind; ++k, ++count) {
    const Point3& v = sum.vertices[loop[(first + k) % loop.size()]];
    at = {at.x + v.x, at.y + v.y, at.z + v.z};
  }
  return {at.x / (count * scale), at.y / (count * scale), at.z / (count * scale)};
}

RationalPoint3 times(const RationalPoint3& v, const Rational& by) { return {v.x * by, v.y * by, v.z * by}; }

/// The ways of solids as they are, and of the same `by` times as large.
void expect_ways(const std::vector<SolidWay>& ways, const Rational& by, const SolidDistance& large) {
  if (large.meeting != Meeting::overlapping) {
    EXPECT_TRUE(ways.empty());
    return;
  }
  ASSERT_EQ(ways.size(), large.ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    EXPECT_EQ(times(ways[k].move, by), large.ways[k].move);
    const Point3 &u = ways[k].direction, &v = large.ways[k].direction;  // rounded each
    EXPECT_LE(std::max({std::abs(u.x - v.x), std::abs(u.y - v.y), std::abs(u.z - v.z)}), 0x1p-50);
    ASSERT_EQ(ways[k].contacts.size(), large.ways[k].contacts.size());
    for (std::size_t c = 0; c < ways[k].contacts.size(); ++c) {
      const SolidTouch &a = ways[k].contacts[c], &b = large.ways[k].contacts[c];
      EXPECT_EQ(std::tie(a.p, a.q, a.dimension, a.patch), std::tie(b.p, b.q, b.dimension, b.patch));
      EXPECT_EQ(times(a.at, by), b.at);
    }
  }
}

TEST(ContinuousDepth, the_exact_square_and_ways_are_those_of_solids_at_rounded_points_of_faces) {
  std::mt19937_64 random(31);
  int positive = 0, zero = 0;
  std::size_t contacts = 0;
  for (int pair = 0; pair < 12; ++pair) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    const Rotation turned = pair % 2 == 0 ? Rotation{} : Rotation::of(3, 1 + pair % 3, 0, 1).value();
    const double norm = static_cast<double>(turned.norm());
    MeshData scaled_p = p.data();
    for (Point3& v : scaled_p.vertices) v = {norm * v.x, norm * v.y, norm * v.z};
    const Mesh p_large = Mesh::create(scaled_p).value(), q_large = turned_and_scaled(q, turned);
    const SpatialSum sum = minkowski_sum(p_large, negated(q_large)).value();
    SolidDepth exact = SolidDepth::create(p_large, q_large).value();
    ContinuousDepthOptions options;
    options.smoothing_length = 0;
    ContinuousDepth depth = ContinuousDepth::create(p, q, options).value();
    for (int k = 0; k < 40; ++k) {
      const Point3 at = on_some_face(sum, norm, random);
      ASSERT_TRUE(depth.query(at, turned));
      const RationalPoint3 large{Rational::of(at.x).value() * Rational::of(norm).value(),
                                 Rational::of(at.y).value() * Rational::of(norm).value(),
                                 Rational::of(at.z).value() * Rational::of(norm).value()};
      const bool inside = contains_each(p_large, negated(q_large), std::span(&large, 1), Semantics::open).value()[0];
      const Rational squared = depth.euclidean_squared();
      EXPECT_EQ(squared.sign() > 0, inside) << pair << " " << k << ": " << squared.to_string();
      (inside ? positive : zero) += 1;
      const SolidDistance d = exact.at(large);
      const Rational by = Rational::of(norm).value();
      EXPECT_EQ(squared * by * by, d.meeting == Meeting::overlapping ? d.squared : Rational(0)) << pair << " " << k;
      expect_ways(depth.euclidean_ways(), by, d);
      contacts += d.ways.front().contacts.size();
    }
  }
  EXPECT_GT(positive, 50);
  EXPECT_GT(zero, 50);
  EXPECT_GT(contacts, 500u);
}

}  // namespace
}  // namespace dymsum::test
