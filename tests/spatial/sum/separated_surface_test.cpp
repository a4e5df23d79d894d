// Meshes of sums whose nearest doubles, or single precision, cross: valid, and as near to the exact set as is reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dymsum/mesh_io.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/separated_surface.h"

namespace dymsum {
namespace {

/// Twice the digits: the normal of a triangle whose height is 2^-40 of its length has none in doubles.
__extension__ using Quad = __float128;
struct Vec {
  Quad x, y, z;
};
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(Quad s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
Quad dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

Vec vector_of(const Point3& p) { return {p.x, p.y, p.z}; }

/// Squares of distances.
Quad to_segment(Vec p, Vec a, Vec b) {
  const Quad square = dot(b - a, b - a), t = square > 0 ? dot(p - a, b - a) / square : Quad(0);
  const Vec off = p - (a + (t < 0 ? Quad(0) : t > 1 ? Quad(1) : t) * (b - a));
  return dot(off, off);
}

Quad to_triangle(Vec p, Vec a, Vec b, Vec c) {
  const Quad sides = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  const Vec n = cross(b - a, c - a);
  const bool over =
      dot(cross(b - a, p - a), n) > 0 && dot(cross(c - b, p - b), n) > 0 && dot(cross(a - c, p - c), n) > 0;
  const Quad height = dot(p - a, n);
  return over ? std::min(sides, height * height / dot(n, n)) : sides;
}

/// How far the centre of a triangle or a corner of `from` is from `to`, at most.
double farthest(const MeshData& from, const MeshData& to) {
  Quad most = 0;
  const auto at = [](const MeshData& m, std::uint32_t v) { return vector_of(m.vertices[v]); };
  for (const Face& f : from.faces) {
    const Vec a = at(from, f[0]), b = at(from, f[1]), c = at(from, f[2]);
    for (const Vec p : {a, b, c, (Quad(1) / 3) * (a + b + c)}) {
      Quad least = INFINITY;
      for (const Face& g : to.faces) least = std::min(least, to_triangle(p, at(to, g[0]), at(to, g[1]), at(to, g[2])));
      most = std::max(most, least);
    }
  }
  return std::sqrt(double(most));
}

double largest(const MeshData& mesh) {
  double most = 0;
  for (const Point3& p : mesh.vertices) most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return most;
}

/// Written, and what is said about it holds. Returns whether it took more than the nearest coordinates.
bool expect_written(const SpatialSum& sum, Precision precision) {
  const Result<SpatialSum::Rounded> rounded = sum.rounded(precision);
  EXPECT_TRUE(rounded.ok()) << rounded.error().to_string();
  if (!rounded) return false;
  const Result<Mesh> mesh = Mesh::create(rounded->mesh);
  EXPECT_TRUE(mesh.ok()) << mesh.error().to_string();
  const MeshData drawn = sum.drawn().mesh;
  const bool single = precision == Precision::singles;
  const double size = largest(drawn), unit = size * (single ? 0x1p-23 : 0x1p-52);
  EXPECT_LE(rounded->distance, 4 * size * (single ? 0x1p-20 : 0x1p-40) + unit);
  EXPECT_LE(farthest(rounded->mesh, drawn), (rounded->nearest ? unit : rounded->distance) + 4 * size * 0x1p-52);
  for (const Point3& p : rounded->mesh.vertices)
    if (single) {
      EXPECT_EQ(p, (Point3{double(float(p.x)), double(float(p.y)), double(float(p.z))}));
    }
  if (rounded->nearest) {
    EXPECT_EQ(rounded->merged_vertices + rounded->collapsed_edges + rounded->bends + rounded->lost_faces, 0u);
    EXPECT_EQ(rounded->distance, 0);
    EXPECT_TRUE(rounded->topology_kept);
  }
  if (mesh) {
    const double within = (rounded->nearest ? unit : rounded->distance) * sum.area() + size * size * size * 0x1p-48;
    EXPECT_NEAR(volume(*mesh), sum.volume(), 2 * within);
    if (!rounded->nearest) {
      EXPECT_LE(std::abs(volume(*mesh) - sum.volume()), rounded->volume_change);
    }
    // Read back, and written again: the same bytes.
    const std::string bytes = format_mesh(*mesh, MeshFormat::off);
    EXPECT_EQ(format_mesh(Mesh::create(parse_mesh(bytes, MeshFormat::off).value()).value(), MeshFormat::off), bytes);
  }
  return !rounded->nearest;
}

TEST(SeparatedSurface, sums_and_erosions_in_all_kinds_of_coordinates) {
  std::mt19937_64 random(41);
  std::size_t merged = 0;
  for (int k = 0; k < 3; ++k) {
    for (const CoordinateKind kind : kCoordinateKinds) {
      const Result<Mesh> p = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), kind, random)),
                         q = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), kind, random));
      if (!p || !q) continue;
      SCOPED_TRACE(name_of(kind) + ", round " + std::to_string(k));
      const Result<SpatialSum> sum = minkowski_sum(*p, *q);
      ASSERT_TRUE(sum.ok());
      const Result<SpatialSum> inner = erode(*p, solids::box(0, 0, 0, 0.125, 0.25, 0.125));
      ASSERT_TRUE(inner.ok());
      for (const Precision precision : {Precision::doubles, Precision::singles})
        merged += expect_written(*sum, precision) + expect_written(*inner, precision);
    }
  }
  EXPECT_GT(merged, 2u);
}

MeshData bent_bar() { return oracles::voxel_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 2, 0}}); }

TEST(SeparatedSurface, a_box_turned_by_30_degrees_and_shrunk_by_a_tenth) {
  std::mt19937_64 random(1);
  const Mesh ball = solids::geodesic_sphere(2, 0.1);
  for (const CoordinateKind kind : {CoordinateKind::turned, CoordinateKind::turned_far}) {
    for (const MeshData& part : {triangulated(solids::box(0, 0, 0, 3, 2, 1)).mesh.data(),
                                 triangulated(Mesh::create(bent_bar()).value()).mesh.data()}) {
      const Mesh box = Mesh::create(of_kind(part, kind, random)).value();
      for (const Precision precision : {Precision::doubles, Precision::singles}) {
        expect_written(erode(box, ball).value(), precision);
        expect_written(minkowski_sum(box, ball).value(), precision);
      }
    }
  }
}

// An opening restores most of what was opened but for rounding between its two steps: thousands of faces lie on each
// other within some units in the last place, and merging the nearest of them does not end.
TEST(SeparatedSurface, an_opening_whose_faces_lie_on_each_other_but_for_rounding) {
  std::mt19937_64 random(5);
  const Mesh ball = solids::geodesic_sphere(1, 0.1);
  const Mesh parts[2] = {
      Mesh::create(of_kind(solids::geodesic_sphere(2, 1).data(), CoordinateKind::turned, random)).value(),
      Mesh::create(of_kind(triangulated(Mesh::create(bent_bar()).value()).mesh.data(), CoordinateKind::turned, random))
          .value()};
  for (const Mesh& part : parts)
    for (const Precision precision : {Precision::doubles, Precision::singles})
      expect_written(opening(part, ball, {}, BetweenSteps::rounded)->solid, precision);
}

TEST(SeparatedSurface, what_is_not_allowed_is_refused_with_the_place) {
  std::mt19937_64 random(1);
  const Mesh p =
      Mesh::create(of_kind(triangulated(Mesh::create(bent_bar()).value()).mesh.data(), CoordinateKind::turned, random))
          .value();
  std::size_t refused = 0;
  for (const double radius : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    const Mesh ball = solids::geodesic_sphere(2, radius);
    for (const SpatialSum& sum : {minkowski_sum(p, ball).value(), erode(p, ball).value()}) {
      for (const Precision precision : {Precision::doubles, Precision::singles}) {
        ASSERT_TRUE(sum.rounded(precision).ok());
        // Merging alone. Vertices in one position are one with any tolerance.
        const Result<SpatialSum::Rounded> merged =
            spatial::separated_surface(sum.drawn(), precision, 0x1p-100,
                                       [](const SpatialSum::Rounded&) { return std::optional<SpatialSum::Rounded>(); });
        if (merged) continue;
        ++refused;
        EXPECT_EQ(merged.error().code, ErrorCode::rounding_changed_topology);
        EXPECT_TRUE(merged.error().evidence.x.has_value());
        // Where next to nothing may be merged, what the rounded surface goes around is as near as rounding allows.
        const Result<SpatialSum::Rounded> rounded = sum.rounded(precision, 0x1p-100);
        if (!rounded) continue;
        EXPECT_FALSE(rounded->nearest);
        EXPECT_LE(rounded->distance, 4 * (precision == Precision::doubles ? 0x1p-48 : 0x1p-19));
        EXPECT_TRUE(Mesh::create(rounded->mesh).ok());
      }
    }
  }
  EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace dymsum
