// Laws of sums of solids, compared exactly, and membership by definition.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using oracles::Voxel;
using oracles::Voxels;

Mesh mesh_of(const SpatialSum& s) { return as_mesh(s).value(); }
Mesh voxel_solid(const Voxels& voxels) { return Mesh::create(oracles::voxel_mesh(voxels)).value(); }

/// A right prism between z = 0 and the height over a ring, with a hole where there is one: top and bottom have a bridge
/// from the first vertex to the hole's, and are split by the repair.
Mesh prism(const Ring& outer, const Ring& hole, double height) {
  MeshData data;
  for (const double z : {0.0, height}) {
    for (const Point& p : outer) data.vertices.push_back({p.x, p.y, z});
    for (const Point& p : hole) data.vertices.push_back({p.x, p.y, z});
  }
  const auto n = static_cast<std::uint32_t>(outer.size()), m = static_cast<std::uint32_t>(hole.size()), up = n + m;
  Face bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    data.faces.push_back({i, (i + 1) % n, up + (i + 1) % n, up + i});
    top.push_back(up + i);
  }
  for (std::uint32_t i = 0; i < m; ++i)
    data.faces.push_back({n + i, n + (i + 1) % m, up + n + (i + 1) % m, up + n + i});
  if (m > 0) {
    top.push_back(up);
    for (std::uint32_t i = 0; i <= m; ++i) top.push_back(up + n + i % m);
  }
  bottom.assign(top.rbegin(), top.rend());
  for (std::uint32_t& v : bottom) v -= up;
  data.faces.push_back(bottom);
  data.faces.push_back(top);
  if (m == 0) return Mesh::create(data).value();
  const Result<RepairedMesh> repaired = repair(data);
  EXPECT_EQ(repaired->report.split_faces, 2u);
  return repaired->mesh;
}

/// A star about the origin with even coordinates, and half of it, clockwise.
std::pair<Ring, Ring> random_star(std::mt19937_64& random, double scale) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  Ring outer, hole;
  for (const auto& [x, y] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
    const double r = 2 * scale * (1 + below(3));
    outer.push_back({x * r, y * r});
    hole.push_back({x * r / 2, y * r / 2});
  }
  std::reverse(hole.begin() + 1, hole.end());
  return {outer, hole};
}

TEST(SolidLaws, of_extruded_polygons_is_the_extruded_sum_of_polygons) {
  int tight = 0, holes = 0;
  for (int k = 0; k < fuzz_pairs(24, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const auto [ring, hole] = random_star(random, 4);
    const auto [small, smaller] = random_star(random, k % 3 == 0 ? 2 : 1);
    const bool fits = k % 4 == 0;  // the hole itself, reflected: it fits exactly
    Ring part = small;
    if (fits) {
      part = hole;
      for (Point& p : part) p = {-p.x, -p.y};
      std::reverse(part.begin(), part.end());
    }
    const Region flat_p = Region::create({{{ring, {hole}}}, {}, {}}).value(),
                 flat_q = Region::create({{{part, {}}}, {}, {}}).value();
    const PlanarSum flat = minkowski_sum(flat_p, flat_q).value();
    const SpatialSum s = sum(prism(ring, hole, 3), prism(part, {}, 2));
    EXPECT_EQ(s.volume_exact(), flat.area_exact() * *Rational::of(5.0)) << "seed " << k;
    EXPECT_EQ(s.tight_faces.size(), flat.tight_segments.size()) << "seed " << k;
    EXPECT_EQ(s.tight_segments.size(), flat.tight_points.size()) << "seed " << k;
    tight += !flat.tight_points.empty() || !flat.tight_segments.empty();
    holes += !flat.parts.empty() && !flat.parts[0].holes.empty();
    // a polyline in the plane instead of the second polygon
    const Polyline line{part[0], part[2], part[5], part[1]};
    const Region wire = Region::create({{}, {line}, {}}).value();
    MeshData bent;
    for (const Point& p : line) bent.vertices.push_back({p.x, p.y, 0});
    bent.faces = {{0, 1}, {1, 2}, {2, 3}};
    const SpatialSum swept = sum(prism(ring, hole, 3), Mesh::with_thin_parts(bent).value());
    const PlanarSum flat_swept = minkowski_sum(flat_p, wire).value();
    EXPECT_EQ(swept.volume_exact(), flat_swept.area_exact() * *Rational::of(3.0)) << "seed " << k;
    EXPECT_EQ(swept.tight_faces.size(), flat_swept.tight_segments.size()) << "seed " << k;
    EXPECT_EQ(swept.tight_segments.size(), flat_swept.tight_points.size()) << "seed " << k;
  }
  EXPECT_GT(tight, 3);
  EXPECT_GT(holes, 3);
}

TEST(SolidLaws, move_reflect_scale_and_associate) {
  for (int k = 0; k < fuzz_pairs(12, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(300 + k));
    const auto [a, b] = oracles::random_voxels(2, random);
    const Mesh p = voxel_solid(a), q = voxel_solid(b), r = voxel_solid(oracles::random_voxels(2, random)[0]);
    const SpatialSum s = sum(p, q);
    const std::string seed = "seed " + std::to_string(300 + k);
    EXPECT_TRUE(s == sum(q, p)) << seed;
    EXPECT_TRUE(sum(translated(p, 5, -3, 0.5).value(), q) == sum(p, translated(q, 5, -3, 0.5).value())) << seed;
    EXPECT_TRUE(mesh_of(sum(negated(p), negated(q))) == negated(mesh_of(s))) << seed;
    EXPECT_TRUE(mesh_of(sum(scaled(p, 2, 0.5, -4).value(), scaled(q, 2, 0.5, -4).value())) ==
                scaled(mesh_of(s), 2, 0.5, -4).value())
        << seed;
    EXPECT_TRUE(sum(mesh_of(s), r) == sum(p, mesh_of(sum(q, r)))) << seed;
    const std::vector<Mesh> three{p, q, r};
    EXPECT_TRUE(minkowski_sum(three).value() == sum(mesh_of(s), r)) << seed;
  }
}

TEST(SolidLaws, the_sum_of_several_is_exact) {
  EXPECT_FALSE(minkowski_sum(std::vector<Mesh>{}).ok());
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  EXPECT_EQ(minkowski_sum(std::vector<Mesh>{cube}).value().volume_exact(), 1);
  int fractions = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    // Two stars in different planes: where they cross, positions are no doubles, or are.
    std::mt19937_64 random(seed);
    const Mesh p = prism(random_star(random, 4).first, {}, 3);
    MeshData turned = prism(random_star(random, 1).first, {}, 3).data();
    for (Point3& v : turned.vertices) v = {v.y, v.z, v.x};
    const Mesh q = Mesh::create(turned).value();
    const Result<SpatialSum> three = minkowski_sum(std::vector<Mesh>{p, cube, q});
    const Result<Mesh> grown = as_mesh(sum(cube, p)), two = as_mesh(sum(p, q));
    ASSERT_TRUE(three.ok()) << three.error().to_string();
    fractions += grown.ok() ? 0 : 1;
    EXPECT_EQ(three->volume(), three->volume_exact().to_double()) << "seed " << seed;
    if (two.ok()) {
      EXPECT_TRUE(sum(*two, cube) == *three) << "seed " << seed;
    }
  }
  EXPECT_GT(fractions, 0) << "the box, which is convex, comes first";
}

TEST(SolidLaws, sums_that_touch_themselves_are_operands) {
  // Over a slab hang a wedge, with its edge down, and a tip: an octahedron makes them touch its top inside.
  const MeshData slab = solids::box(-9, -9, -1, 9, 9, 0).data();
  const Mesh octahedron = solids::dipyramid(4, 1, 1, solids::kDemoSnap);
  double height = 0;
  for (const Point3& v : octahedron.vertices()) height = std::max(height, v.z);
  const double low = 2 * height;
  const std::vector<std::vector<Point3>> above{
      {{-3, 0, low}, {3, 0, low}, {-3, -2, 5}, {3, -2, 5}, {-3, 2, 5}, {3, 2, 5}},
      {{0, 0, low}, {-3, -2, 5}, {3, -2, 5}, {0, 3, 5}},
      {{1, 1, low}, {-3, -2, 5}, {3, -2, 5}, {0, 3, 5}, {1, -0.5, low}, {-0.5, 0, low + 0.5}}};
  for (const std::vector<Point3>& points : above) {
    MeshData data = slab;
    const auto count = static_cast<std::uint32_t>(data.vertices.size());
    const Mesh hanging = convex_hull(points).value();
    data.vertices.insert(data.vertices.end(), hanging.vertices().begin(), hanging.vertices().end());
    for (Face f : hanging.faces()) {
      for (std::uint32_t& v : f) v += count;
      data.faces.push_back(f);
    }
    const SpatialSum s = sum(Mesh::create(data).value(), octahedron);
    const Result<SpatialSum::Rounded> rounded = s.rounded();
    ASSERT_TRUE(rounded.ok()) << rounded.error().to_string();
    const Result<Mesh> mesh = Mesh::create(rounded->mesh);
    ASSERT_TRUE(mesh.ok()) << mesh.error().to_string();
    EXPECT_NEAR(volume(*mesh), s.volume(), 1e-9);
    EXPECT_GT(sum(*mesh, solids::box(0, 0, 0, 1, 1, 1)).volume(), s.volume());
  }
}

TEST(SolidLaws, known_volumes) {
  MeshData ell;
  for (const double z : {0.0, 10.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {4.0, 4.0}, {4.0, 10.0}, {0.0, 10.0}})
      ell.vertices.push_back({x, y, z});
  ell.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) ell.faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  const Mesh large = Mesh::create(ell).value(), small = scaled(large, 0.05, 0.05, 0.05).value();
  EXPECT_NEAR(sum(large, small).volume(), 777.735, 1e-9);
  EXPECT_TRUE(sum(large, small) == sum(small, large));

  const auto torus = [](double large_radius, double small_radius, double a, double b, double c) {
    MeshData data;
    const double pi = std::acos(-1.0);
    for (std::uint32_t i = 0; i < 8; ++i) {
      for (std::uint32_t j = 0; j < 6; ++j) {
        const double u = 2 * pi * i / 8, w = 2 * pi * j / 6, r = large_radius + small_radius * std::cos(w);
        double x = r * std::cos(u), y = r * std::sin(u), z = small_radius * std::sin(w);
        const auto turn = [](double& s, double& t, double angle) {
          const double s0 = s, t0 = t;
          s = std::cos(angle) * s0 - std::sin(angle) * t0;
          t = std::sin(angle) * s0 + std::cos(angle) * t0;
        };
        turn(y, z, a), turn(z, x, b), turn(x, y, c);
        data.vertices.push_back({x, y, z});
        const std::uint32_t p = 6 * i + j, q = 6 * ((i + 1) % 8) + j, s = 6 * ((i + 1) % 8) + (j + 1) % 6,
                            t = 6 * i + (j + 1) % 6;
        data.faces.push_back({p, q, s});
        data.faces.push_back({p, s, t});
      }
    }
    return Mesh::create(data).value();
  };
  const SpatialSum tori = sum(torus(2, 0.6, 0, 0, 0), torus(1.3, 0.35, 0.7, 0.4, 0.3));
  EXPECT_NEAR(tori.volume(), 117.173, 5e-4);
}

/// By lattice cells: the open sum is a union of open cubes of size 2.
bool in_cubes(const Voxels& p, const Voxels& q, const Voxel& doubled, bool closed) {
  for (const Voxel& a : p) {
    for (const Voxel& b : q) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        const int low = 2 * (a[i] + b[i]), x = doubled[i];
        inside &= closed ? low <= x && x <= low + 4 : low < x && x < low + 4;
      }
      if (inside) return true;
    }
  }
  return false;
}

TEST(SolidLaws, contains_is_membership_by_definition) {
  int inside = 0, touching = 0;
  for (int k = 0; k < fuzz_pairs(12, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(400 + k));
    const auto [a, b] = oracles::random_voxels(2, random);
    Voxels half;
    for (const Voxel& v : b)
      if (half.empty() || random() % 2 == 0) half.insert(v);
    const Mesh p = voxel_solid(a), q = voxel_solid(b), part = voxel_solid(half);
    for (int j = 0; j < 60; ++j) {
      Voxel x{};
      for (int& c : x) c = static_cast<int>(random() % 9) - 1;
      const Point3 at{x[0] / 2.0, x[1] / 2.0, x[2] / 2.0};
      const bool open = contains(p, q, at, Semantics::open).value(), closed = contains(p, q, at).value();
      EXPECT_EQ(open, in_cubes(a, b, x, false)) << "seed " << 400 + k;
      EXPECT_EQ(closed, in_cubes(a, b, x, true)) << "seed " << 400 + k;
      EXPECT_TRUE(!contains(p, part, at, Semantics::open).value() || open) << "monotone, seed " << 400 + k;
      EXPECT_TRUE(!contains(p, part, at).value() || closed) << "monotone, seed " << 400 + k;
      inside += open, touching += closed && !open;
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(touching, 50);
  EXPECT_FALSE(contains(Mesh{}, solids::box(0, 0, 0, 1, 1, 1), {}).value());
  EXPECT_FALSE(contains(solids::box(0, 0, 0, 1, 1, 1), solids::box(0, 0, 0, 1, 1, 1), {NAN, 0, 0}).value());
}

/// Whether z, off all planes of triangles and their edges seen along x, is inside a closed surface.
bool inside_surface(const MeshData& mesh, const Point3& z) {
  double turns = 0;  // the solid angle, in units of the whole sphere
  for (const Face& f : mesh.faces) {
    double v[3][3], length[3];
    for (int k = 0; k < 3; ++k) {
      const Point3& p = mesh.vertices[f[static_cast<std::size_t>(k)]];
      v[k][0] = p.x - z.x, v[k][1] = p.y - z.y, v[k][2] = p.z - z.z;
      length[k] = std::hypot(v[k][0], v[k][1], v[k][2]);
    }
    const auto dot = [&](int i, int j) { return v[i][0] * v[j][0] + v[i][1] * v[j][1] + v[i][2] * v[j][2]; };
    const double det = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                       v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                       v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    turns += std::atan2(
        det, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] + dot(2, 0) * length[1]);
  }
  return turns > std::acos(-1.0);
}

/// Points, segments and triangles that may share vertices and cross each other.
Mesh random_parts(std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  while (true) {
    MeshData data;
    for (int k = 2 + below(5); k >= 0; --k) data.vertices.push_back({below(9) - 4.0, below(9) - 4.0, below(9) - 4.0});
    const int n = static_cast<int>(data.vertices.size());
    std::vector<bool> used(data.vertices.size());
    for (int k = below(4); k >= 0 || std::find(used.begin(), used.end(), false) != used.end(); --k) {
      Face face;
      for (int c = 1 + below(3); c > 0; --c) {
        const auto v = static_cast<std::uint32_t>(below(n));
        if (std::find(face.begin(), face.end(), v) == face.end()) face.push_back(v), used[v] = true;
      }
      data.faces.push_back(face);
    }
    if (Result<Mesh> mesh = Mesh::with_thin_parts(data); mesh && mesh->shell_count() == 0) return *mesh;
  }
}

TEST(SolidLaws, sums_with_parts_without_volume_are_the_union_of_those_with_each_part) {
  int inside = 0, outside = 0;
  for (int k = 0; k < fuzz_pairs(40, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(600 + k));
    const Mesh solid = k % 2 == 0 ? solids::cone(5, 2, 3, solids::kDemoSnap) : solids::box(0, 0, 0, 1, 2, 3);
    const Mesh parts = random_parts(random);
    const SpatialSum s = sum(solid, parts);
    EXPECT_TRUE(s == sum(parts, solid)) << "seed " << 600 + k;
    EXPECT_TRUE(s == sum(solid, parts, SpatialEngine::brute)) << "seed " << 600 + k;
    std::vector<Mesh> hulls;  // of the sums with each part, which are convex
    for (const Face& face : parts.faces()) {
      std::vector<Point3> points;
      for (const std::uint32_t v : face)
        for (const Point3& p : solid.vertices())
          points.push_back({p.x + parts.vertices()[v].x, p.y + parts.vertices()[v].y, p.z + parts.vertices()[v].z});
      hulls.push_back(triangulated(convex_hull(points).value()).mesh);
    }
    const Result<SpatialSum::Rounded> surface = s.rounded();
    for (int j = 0; j < 40; ++j) {
      const auto coordinate = [&] { return static_cast<double>(random() % 1000) / 128 - 4.0 + 0x1p-12; };
      const Point3 z{coordinate(), coordinate(), coordinate()};
      const bool expected =
          std::any_of(hulls.begin(), hulls.end(), [&](const Mesh& h) { return inside_surface(h.data(), z); });
      if (surface) {
        EXPECT_EQ(inside_surface(surface->mesh, z), expected) << "seed " << 600 + k;
      }
      EXPECT_EQ(contains(solid, parts, z, Semantics::open).value(), expected) << "seed " << 600 + k;
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST(SolidLaws, sums_of_parts_without_volume_are_the_union_of_those_of_their_pairs) {
  int inside = 0, outside = 0;
  for (int k = 0; k < fuzz_pairs(40, 20); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(800 + k));
    const Mesh p = random_parts(random), q = random_parts(random);
    std::vector<Mesh> hulls;
    for (const Face& a : p.faces()) {
      for (const Face& b : q.faces()) {
        std::vector<Point3> points;
        for (const std::uint32_t v : a)
          for (const std::uint32_t w : b)
            points.push_back({p.vertices()[v].x + q.vertices()[w].x, p.vertices()[v].y + q.vertices()[w].y,
                              p.vertices()[v].z + q.vertices()[w].z});
        const Result<Mesh> hull = convex_hull(points);
        if (hull) hulls.push_back(triangulated(*hull).mesh);
      }
    }
    const Result<SpatialSum> s = minkowski_sum(p, q);
    ASSERT_TRUE(s.ok()) << "seed " << 800 + k;
    EXPECT_EQ(s->faces.empty(), hulls.empty()) << "seed " << 800 + k;
    EXPECT_TRUE(*s == minkowski_sum(q, p).value()) << "seed " << 800 + k;
    const Result<SpatialSum::Rounded> surface = s->rounded();
    for (int j = 0; j < 40 && surface; ++j) {
      const auto coordinate = [&] { return static_cast<double>(random() % 1500) / 128 - 6.0 + 0x1p-12; };
      const Point3 z{coordinate(), coordinate(), coordinate()};
      const bool expected =
          std::any_of(hulls.begin(), hulls.end(), [&](const Mesh& h) { return inside_surface(h.data(), z); });
      EXPECT_EQ(inside_surface(surface->mesh, z), expected) << "seed " << 800 + k;
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(inside, 30);
  EXPECT_GT(outside, 100);
}

}  // namespace
}  // namespace dymsum
