// Solids by their planes: turned, noisy and rounded parts have the faces that they had, exactly, near where they were.
#include "dymsum/solid_by_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "dymsum/shapes.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "spatial/boolean/solid_union.h"
#include "spatial/sum/exact_set.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
namespace {

using exact::BigRational;

MeshData in_triangles(const MeshData& mesh) { return triangulated(Mesh::create(mesh).value()).mesh.data(); }

MeshData each(MeshData mesh, const std::function<Point3(Point3)>& f) {
  for (Point3& p : mesh.vertices) p = f(p);
  return mesh;
}

/// By a random rotation, in doubles.
MeshData turned_at_random(MeshData mesh, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double q[4];
  double size = 0;
  for (double& c : q) c = normal(random), size += c * c;
  for (double& c : q) c /= std::sqrt(size);
  const auto [w, x, y, z] = std::array{q[0], q[1], q[2], q[3]};
  return each(std::move(mesh), [&](Point3 p) {
    return Point3{(1 - 2 * (y * y + z * z)) * p.x + 2 * (x * y - w * z) * p.y + 2 * (x * z + w * y) * p.z,
                  2 * (x * y + w * z) * p.x + (1 - 2 * (x * x + z * z)) * p.y + 2 * (y * z - w * x) * p.z,
                  2 * (x * z - w * y) * p.x + 2 * (y * z + w * x) * p.y + (1 - 2 * (x * x + y * y)) * p.z};
  });
}

std::vector<std::pair<std::string, MeshData>> parts() {
  return {{"box", box(1.5)},
          {"ell", ell()},
          {"tunnel", tunnel()},
          {"cavity", cavity()},
          {"rod", solids::cylinder(24, 0.5, 3, 0x1p-20).data()},
          {"gear", solids::prism(shapes::gear(9, 1, 1.5, 0x1p-20).parts()[0].outer, 0.75).data()}};
}

BigRational squared(const BigRational& x) { return x * x; }

/// Every vertex of the solid is within the largest move of one of the data's, and the tolerance holds.
void expect_near(const SolidByPlanes& made, const MeshData& data) {
  EXPECT_LE(made.largest_move, made.tolerance);
  const BigRational most = squared(exact::exact_value(made.largest_move));
  for (std::size_t v = 0; v < made.solid.vertices.size(); ++v) {
    const spatial::ExactPosition at = spatial::SpatialSumInternals::positions(made.solid).at(v);
    const bool near = std::any_of(data.vertices.begin(), data.vertices.end(), [&](const Point3& p) {
      return squared(at[0] - exact::exact_value(p.x)) + squared(at[1] - exact::exact_value(p.y)) +
                 squared(at[2] - exact::exact_value(p.z)) <=
             most;
    });
    EXPECT_TRUE(near) << "vertex " << v;
  }
}

/// Exactly parallel pairs of faces, as many as there are.
std::size_t parallel_pairs(const SpatialSum& solid) {
  const auto normal = [&](const SpatialFace& f) {
    std::array<spatial::ExactPosition, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = spatial::SpatialSumInternals::positions(solid).at(f.loops[0][k]);
    std::array<BigRational, 3> u, v;
    for (std::size_t k = 0; k < 3; ++k) u[k] = p[1][k] - p[0][k], v[k] = p[2][k] - p[0][k];
    return std::array<BigRational, 3>{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < solid.faces.size(); ++i) {
    for (std::size_t j = i + 1; j < solid.faces.size(); ++j) {
      const auto a = normal(solid.faces[i]), b = normal(solid.faces[j]);
      pairs += a[0] * b[1] == a[1] * b[0] && a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2];
    }
  }
  return pairs;
}

/// The solid that the faces of a result bound, made anew from its exact vertices.
SpatialSum made_anew(const SpatialSum& sum) { return spatial::solid_inside(spatial::exact_set(sum), {}, {}).value(); }

TEST(ByPlanes, turned_parts_have_the_faces_that_they_had) {
  std::mt19937_64 random(1);
  for (const auto& [name, part] : parts()) {
    SCOPED_TRACE(name);
    const SpatialSum grid = united(part).value();
    for (int k = 0; k < oracles::rounds(20); ++k) {
      SCOPED_TRACE(k);
      const MeshData data = turned_at_random(in_triangles(part), random);
      const SolidByPlanes made = by_planes(data).value();
      EXPECT_EQ(made.solid.faces.size(), grid.faces.size());
      EXPECT_EQ(made.solid.vertices.size(), grid.vertices.size());
      EXPECT_EQ(made.solid.shells, grid.shells);
      if (name != "gear") EXPECT_EQ(parallel_pairs(made.solid), parallel_pairs(grid));
      else EXPECT_GE(parallel_pairs(made.solid), 1u);  // an odd number of teeth: its ends
      EXPECT_NEAR(made.solid.volume(), grid.volume(), 1e-9);
      EXPECT_EQ(made.axes.size(), 1u);
      EXPECT_EQ(made.bent_faces, 0u);
      expect_near(made, data);
      EXPECT_EQ(made.solid, made_anew(made.solid));
    }
  }
}

TEST(ByPlanes, every_kind_of_coordinates) {
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    for (const auto& [name, part] : parts()) {
      SCOPED_TRACE(name);
      std::mt19937_64 random(2);
      const MeshData data = of_kind(in_triangles(part), kind, random);
      const SolidByPlanes made = by_planes(data).value();
      expect_near(made, data);
      if (kind == CoordinateKind::decimals) continue;  // 4 digits change which faces are parallel
      const SpatialSum grid = united(part).value();
      EXPECT_EQ(made.solid.faces.size(), grid.faces.size());
      EXPECT_EQ(made.solid.vertices.size(), grid.vertices.size());
    }
  }
}

TEST(ByPlanes, parts_in_single_precision_that_were_turned) {
  std::mt19937_64 random(3);
  for (const auto& [name, part] : parts()) {
    SCOPED_TRACE(name);
    const auto single = [](double c) { return static_cast<double>(static_cast<float>(c)); };
    const MeshData data = each(turned_at_random(in_triangles(part), random), [&](Point3 p) {
      return Point3{single(p.x), single(p.y), single(p.z)};
    });
    const SolidByPlanes made = by_planes(data).value();
    EXPECT_EQ(made.solid.faces.size(), united(part).value().faces.size());
    expect_near(made, data);
  }
}

TEST(ByPlanes, noise_along_own_axes_goes_and_vertices_stay_doubles) {
  MeshData data = box(1);
  data.vertices[0].x += 0x1p-52;
  data.vertices[3].y -= 0x1p-52;
  const SolidByPlanes made = by_planes(data).value();
  EXPECT_TRUE(made.axes.empty());
  EXPECT_EQ(made.merged, 2u);
  EXPECT_EQ(as_mesh(made.solid).value(), Mesh::create(box(1)).value());
  MeshData cylinder = in_triangles(solids::cylinder(8, 1, 2).data());  // cos 90 degrees is 6e-17
  EXPECT_EQ(by_planes(cylinder)->solid.faces.size(), 10u);
  EXPECT_TRUE(as_mesh(by_planes(cylinder)->solid).ok());
}

TEST(ByPlanes, polygons_that_rounding_bent_are_taken) {
  std::mt19937_64 random(4);
  const MeshData data = turned_at_random(ell(), random);
  EXPECT_FALSE(Mesh::create(data).ok());
  EXPECT_EQ(by_planes(data)->solid.faces.size(), 8u);
}

TEST(ByPlanes, a_slanted_polygon_in_no_plane_becomes_triangles) {
  MeshData data = box(1);
  data.vertices[6].z += 0.25;  // its face on top
  const SolidByPlanes made = by_planes(data).value();
  EXPECT_EQ(made.bent_faces, 1u);
  EXPECT_EQ(made.solid.faces.size(), 7u);
}

TEST(ByPlanes, parts_have_common_axes_in_any_order) {
  std::mt19937_64 random(5);
  const std::uint64_t seed = random();
  std::mt19937_64 same(seed), again(seed);
  const MeshData ell_data = turned_at_random(in_triangles(ell()), same),
                 rod_data = turned_at_random(in_triangles(solids::cylinder(24, 0.5, 3, 0x1p-20).data()), again);
  const std::vector<SolidByPlanes> both = by_planes(std::vector{ell_data, rod_data}).value(),
                                   reversed = by_planes(std::vector{rod_data, ell_data}).value();
  const SolidByPlanes &p = both[0], &q = both[1];
  ASSERT_EQ(q.axes, p.axes);
  EXPECT_EQ(p.solid, reversed[1].solid);
  EXPECT_EQ(q.solid, reversed[0].solid);
  const SpatialSum sum = minkowski_sum(p.solid, q.solid).value(),
                   grid = minkowski_sum(Mesh::create(ell()).value(), solids::cylinder(24, 0.5, 3, 0x1p-20)).value();
  EXPECT_EQ(sum.faces.size(), grid.faces.size());
  EXPECT_EQ(sum.vertices.size(), grid.vertices.size());
  EXPECT_NEAR(sum.volume(), grid.volume(), 1e-8);
  // Not mapped, but as sets of fractions.
  EXPECT_EQ(sum, spatial::sum_of_exact_sets(spatial::exact_set(p.solid), spatial::exact_set(q.solid), {}).value());
}

TEST(ByPlanes, sums_and_fits_of_parts_with_equal_axes_are_those_of_exact_sets) {
  std::mt19937_64 random(6);
  const auto list = parts();
  int equal = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      SCOPED_TRACE(list[i].first + " " + list[j].first);
      const std::uint64_t seed = random();
      std::mt19937_64 same(seed), again(seed);
      const MeshData large = turned_at_random(list[i].second, same);
      const MeshData small = each(list[j].second, [](Point3 v) { return Point3{v.x / 4, v.y / 4, v.z / 4}; });
      const std::vector<SolidByPlanes> both = by_planes(std::vector{large, turned_at_random(small, again)}).value();
      const SolidByPlanes &p = both[0], &q = both[1];
      equal += q.axes == p.axes;
      EXPECT_EQ(minkowski_sum(p.solid, q.solid).value(),
                spatial::sum_of_exact_sets(spatial::exact_set(p.solid), spatial::exact_set(q.solid), {}).value());
      const SpatialSum inner = erode(p.solid, q.solid).value();
      const SpatialSum free_fit = erode(made_anew(p.solid), made_anew(q.solid)).value();
      EXPECT_EQ(inner, free_fit);
      EXPECT_EQ(minkowski_sum(p.solid, negated(q.solid)).value(),
                minkowski_sum(made_anew(p.solid), negated(made_anew(q.solid))).value());
    }
  }
  EXPECT_GE(equal, 11);
}

TEST(ByPlanes, parts_with_axes_of_their_own_meet) {
  std::mt19937_64 random(7);
  // A box, turned, in the cavity of another one that is turned otherwise; and one beside it along the axes.
  MeshData all = cavity();
  for (const MeshData& part : {turned_at_random(box(0.5), random), moved(turned_at_random(box(1), random), 20, 0, 0)}) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (Face f : part.faces) {
      for (std::uint32_t& v : f) v += first;
      all.faces.push_back(std::move(f));
    }
  }
  const SolidByPlanes made = by_planes(all).value();
  EXPECT_EQ(made.axes.size(), 2u);
  EXPECT_EQ(made.solid.faces.size(), 24u);
  EXPECT_EQ(made.solid.shells, 4u);
  expect_near(made, all);
  EXPECT_EQ(made.solid, made_anew(made.solid));
  for (const SpatialFace& face : made.solid.faces) {
    ASSERT_EQ(face.p.kind, SolidFeature::Kind::face);
    EXPECT_LT(face.p.a, all.faces.size());
  }
}

TEST(ByPlanes, boxes_in_one_file_keep_their_planes) {
  std::mt19937_64 random(9);
  for (int k = 0; k < oracles::rounds(60); ++k) {
    SCOPED_TRACE(k);
    MeshData all;
    for (int part = 0; part < 3; ++part) {
      const MeshData one = moved(turned_at_random(box(1 + 0.25 * part), random), 7.1 * part, 1.3, -2.7);
      const auto first = static_cast<std::uint32_t>(all.vertices.size());
      all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
      for (Face f : one.faces) {
        for (std::uint32_t& v : f) v += first;
        all.faces.push_back(std::move(f));
      }
    }
    const SolidByPlanes made = by_planes(all).value();
    EXPECT_EQ(made.solid.faces.size(), 18u);
    EXPECT_EQ(parallel_pairs(made.solid), 9u);
    EXPECT_EQ(made.bent_faces, 0u);
    expect_near(made, all);
  }
}

TEST(ByPlanes, of_any_size) {
  std::mt19937_64 random(10);
  for (const int power : {-1000, -500, -100, -3, 250, 500, 1000}) {
    SCOPED_TRACE(power);
    for (const MeshData& part : {ell(), box(1.5)}) {
      const MeshData data = each(turned_at_random(in_triangles(part), random), [&](Point3 p) {
        return Point3{std::ldexp(p.x, power), std::ldexp(p.y, power), std::ldexp(p.z, power)};
      });
      const SolidByPlanes made = by_planes(data).value();
      EXPECT_EQ(made.solid.faces.size(), united(part).value().faces.size());
      expect_near(made, data);
    }
  }
}

TEST(ByPlanes, what_is_thinner_than_the_tolerance_is_an_error) {
  PlanesOptions options;
  options.tolerance = 100;
  EXPECT_EQ(by_planes(box(1), options).error().code, ErrorCode::no_area);
  EXPECT_EQ(by_planes(moved(box(0.5), 1e15, 0, 0)).error().code, ErrorCode::no_area);
}

TEST(Negated, is_the_set_through_the_origin_and_its_own_inverse) {
  std::mt19937_64 random(8);
  for (const auto& [name, part] : parts()) {
    SCOPED_TRACE(name);
    const Mesh mesh = Mesh::create(part).value(), small = solids::box(0, 0, 0, 0.125, 0.25, 0.5);
    const SpatialSum sum = minkowski_sum(mesh, small).value();
    EXPECT_EQ(negated(sum), minkowski_sum(negated(mesh), negated(small)).value());
    EXPECT_EQ(negated(negated(sum)), sum);
    const SpatialSum turned_part = by_planes(turned_at_random(part, random))->solid;
    EXPECT_EQ(negated(turned_part), made_anew(negated(turned_part)));
    EXPECT_EQ(negated(negated(turned_part)), turned_part);
    EXPECT_EQ(negated(turned_part).volume_exact(), turned_part.volume_exact());
  }
  // Tight: a box of half size 1 in the tunnel of that size.
  const SpatialSum fit = erode(Mesh::create(tunnel()).value(), Mesh::create(box(1)).value()).value(),
                   channel = minkowski_sum(Mesh::create(tunnel()).value(), Mesh::create(box(1)).value()).value();
  ASSERT_FALSE(channel.tight_segments.empty());
  EXPECT_EQ(negated(channel), channel) << "symmetric";
  EXPECT_EQ(negated(fit), fit);
  EXPECT_EQ(negated(SpatialSum()), SpatialSum());
}

TEST(ByPlanes, errors_name_what_is_wrong) {
  const double inf = std::numeric_limits<double>::infinity();
  MeshData data = box(1);
  EXPECT_TRUE(by_planes(MeshData{})->solid.faces.empty());
  for (const double tolerance : {0.0, -1.0, 1e-17, inf, std::nan("")}) {
    PlanesOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(by_planes(data, options).error().code, ErrorCode::out_of_range) << tolerance;
  }
  data.vertices[0].x = inf;
  EXPECT_EQ(by_planes(data).error().code, ErrorCode::not_finite);
  data = box(1);
  data.faces[0][0] = 99;
  EXPECT_EQ(by_planes(data).error().code, ErrorCode::bad_index);
  data = box(1);
  data.faces.pop_back();
  EXPECT_EQ(by_planes(data).error().code, ErrorCode::not_closed);
  data = box(1);
  data.faces[0].resize(2);
  EXPECT_EQ(by_planes(data).error().code, ErrorCode::too_few_vertices);
  PlanesOptions options;
  options.sums.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(by_planes(box(1), options).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace dymsum
