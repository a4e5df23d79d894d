// `contains` at positions of any size and for parts of any dimension.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum {
namespace {

using oracles::IntegerMap, oracles::LatticeCells, oracles::Voxel;
using Vector = std::array<Rational, 3>;

Vector vector(const SpatialSum& sum, std::uint32_t v) {
  const RationalPoint3 at = sum.exact(v);
  return {at.x, at.y, at.z};
}

/// The centre of a triangle, and places an extremely small step in front of it and behind it.
std::array<RationalPoint3, 3> on_before_and_behind(const Vector& a, const Vector& b, const Vector& c) {
  const Rational third = Rational(1) / Rational(3), step = *Rational::of(0x1p-500);
  std::array<RationalPoint3, 3> positions;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Rational normal = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    const Rational midpoint = (a[i] + b[i] + c[i]) * third;
    const auto set = [&](RationalPoint3& position, const Rational& v) {
      (i == 0 ? position.x : i == 1 ? position.y : position.z) = v;
    };
    set(positions[0], midpoint), set(positions[1], midpoint + step * normal),
        set(positions[2], midpoint - step * normal);
  }
  return positions;
}

/// A small polyhedron with vertices of 40 and more bits.
Mesh fine_polyhedron(std::mt19937_64& random) {
  while (true) {
    MeshData data = random_solids::tiny_polyhedron(random);
    for (Point3& v : data.vertices)
      for (double Point3::*c : {&Point3::x, &Point3::y, &Point3::z})
        v.*c += std::ldexp(static_cast<double>(random() % 1024), -40);
    if (Result<Mesh> mesh = Mesh::create(data); mesh.ok()) return *std::move(mesh);
  }
}

TEST(SolidMembership, at_vertices_with_hundreds_of_digits_and_next_to_faces) {
  std::size_t largest = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    std::mt19937_64 random(seed);
    const Mesh p = fine_polyhedron(random), q = fine_polyhedron(random);
    const SpatialSum sum = minkowski_sum(p, q).value();
    std::vector<RationalPoint3> vertices, on, before, behind;
    for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
      vertices.push_back(sum.exact(v));
      largest = std::max(largest, vertices.back().x.denominator().size());
    }
    for (const auto& [a, b, c] : spatial::triangulated(sum).triangles) {
      const auto positions = on_before_and_behind(vector(sum, a), vector(sum, b), vector(sum, c));
      on.push_back(positions[0]), before.push_back(positions[1]), behind.push_back(positions[2]);
    }
    const auto expect = [&](const std::vector<RationalPoint3>& positions, bool closed, bool open) {
      EXPECT_EQ(contains_each(p, q, positions).value(), std::vector<bool>(positions.size(), closed)) << "seed " << seed;
      EXPECT_EQ(contains_each(p, q, positions, Semantics::open).value(), std::vector<bool>(positions.size(), open))
          << "seed " << seed;
    };
    expect(vertices, true, false), expect(on, true, false), expect(before, false, false), expect(behind, true, true);
  }
  EXPECT_GT(largest, 50u) << "digits of a denominator";
}

TEST(SolidMembership, at_extreme_positions) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  const auto in = [&](double x, Semantics semantics) { return contains(cube, cube, {x, 1, 1}, semantics).value(); };
  for (const double tiny : {0x1p-1074, 1e-200, 1e-30}) {
    EXPECT_TRUE(in(tiny, Semantics::closed) && in(tiny, Semantics::open));
    EXPECT_FALSE(in(-tiny, Semantics::closed) || in(-tiny, Semantics::open));
  }
  EXPECT_TRUE(in(0, Semantics::closed) && !in(0, Semantics::open));
  for (const double far : {-1e308, -3.0, 3.0, 1e308}) EXPECT_FALSE(in(far, Semantics::closed));
}

LatticeCells random_cells(std::mt19937_64& random) {
  LatticeCells cells;
  for (int k = 1 + static_cast<int>(random() % 4); k > 0; --k) {
    Voxel c{};
    for (int& i : c) i = static_cast<int>(random() % 5);
    if (c[0] % 2 + c[1] % 2 + c[2] % 2 < 3 || random() % 2 == 0) cells.insert(c);
  }
  return cells;
}

/// Whether a position in sixths lies in the sum of two closed cells.
bool in_cells(const LatticeCells& p, const LatticeCells& q, const Voxel& sixths) {
  for (const Voxel& a : p)
    for (const Voxel& b : q) {
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const int low = 6 * (a[i] / 2 + b[i] / 2), high = 6 * ((a[i] + 1) / 2 + (b[i] + 1) / 2);
        inside &= low <= sixths[i] && sixths[i] <= high;
      }
      if (inside) return true;
    }
  return false;
}

TEST(SolidMembership, of_points_segments_squares_and_cubes_in_both_operands) {
  int inside = 0, outside = 0, both_thin = 0;
  const IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    std::mt19937_64 random(seed);
    const LatticeCells a = random_cells(random), b = random_cells(random);
    const IntegerMap& map = seed % 2 == 0 ? oracles::kNoShear : shear;
    const Result<Mesh> p = Mesh::with_thin_parts(oracles::lattice_mesh(a, map)),
                       q = Mesh::with_thin_parts(oracles::lattice_mesh(b, map));
    if (!p || !q || p->empty() || q->empty()) continue;  // squares that bound a cube
    both_thin += p->has_thin_parts() && q->has_thin_parts();
    for (int k = 0; k < 60; ++k) {
      Voxel x{};
      const int grain = k % 3 == 0 ? 1 : k % 3 == 1 ? 3 : 6;  // lattice points and centres of cells more often
      for (int& c : x)
        c = grain * static_cast<int>(random() % static_cast<std::uint64_t>(30 / grain)) - 3 * (grain == 1);
      std::array<Rational, 3> at;
      for (std::size_t i = 0; i < 3; ++i)
        at[i] = Rational(map[i][0] * x[0] + map[i][1] * x[1] + map[i][2] * x[2]) / Rational(6);
      const RationalPoint3 z{at[0], at[1], at[2]};
      const bool expected = in_cells(a, b, x);
      EXPECT_EQ(contains_each(*p, *q, std::span(&z, 1)).value()[0], expected) << "seed " << seed;
      EXPECT_EQ(contains_each(*q, *p, std::span(&z, 1)).value()[0], expected) << "seed " << seed;
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(both_thin, 80);
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(SolidMembership, of_wires_that_cross_touch_and_lie_in_line) {
  const auto wire = [](const Point3& a, const Point3& b) { return Mesh::with_thin_parts({{a, b}, {{0, 1}}}).value(); };
  const Mesh point = Mesh::with_thin_parts({{{1, 2, 3}}, {{0}}}).value();
  EXPECT_TRUE(contains(point, point, {2, 4, 6}).value());
  EXPECT_FALSE(contains(point, point, {2, 4, 6.5}).value());
  const Mesh along = wire({0, 0, 0}, {3, 1, 2}), across = wire({0, 1, 0}, {2, 0, 5});
  const auto in = [&](const Mesh& p, const Mesh& q, const RationalPoint3& z) -> bool {
    return contains_each(p, q, std::span(&z, 1)).value()[0];
  };
  const auto part = [](int n, int d) { return Rational(n) / Rational(d); };
  // a third of the one and three sevenths of the other
  EXPECT_TRUE(in(along, across, {1 + part(6, 7), part(1, 3) + part(4, 7), part(2, 3) + part(15, 7)}));
  EXPECT_FALSE(in(along, across, {1 + part(6, 7), part(1, 3) + part(4, 7), part(2, 3) + part(16, 7)}));
  EXPECT_TRUE(in(along, along, {part(9, 2), part(3, 2), 3}));
  EXPECT_TRUE(in(along, along, {6, 2, 4}));
  EXPECT_FALSE(in(along, along, {part(601, 100), part(601, 300), part(601, 150)}));
  EXPECT_TRUE(in(along, point, {2, 2 + part(1, 3), 3 + part(2, 3)}));
  EXPECT_EQ(contains(along, across, {0, 0, 0}, Semantics::regular).error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum
