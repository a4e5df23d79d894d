// Solids by winding number, against rational arithmetic, cells of a lattice, and laws between volumes.
#include "dymsum/solid_union.h"

#include <gtest/gtest.h>

#include "dymsum/solid_erosion.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/voxel_solids.h"
#include "spatial/boolean/winding_oracle.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

using oracles::operator-;
using oracles::RationalVector;
using oracles::Voxels;

MeshData together(std::initializer_list<MeshData> surfaces) {
  MeshData all;
  for (const MeshData& s : surfaces) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), s.vertices.begin(), s.vertices.end());
    for (Face face : s.faces) {
      for (std::uint32_t& v : face) v += first;
      all.faces.push_back(std::move(face));
    }
  }
  return all;
}

MeshData box(double x, double y, double z, double dx, double dy, double dz) {
  return solids::box(x, y, z, x + dx, y + dy, z + dz).data();
}

MeshData inside_out(MeshData m) {
  for (Face& f : m.faces) std::reverse(f.begin(), f.end());
  return m;
}

bool inside(int winding, Fill fill) {
  return fill == Fill::positive ? winding > 0 : fill == Fill::nonzero ? winding != 0 : winding % 2 != 0;
}

/// A position within the surface's box, on nothing.
RationalVector some_position(const MeshData& surface, std::mt19937_64& random) {
  Point3 low = surface.vertices[0], high = low;
  for (const Point3& p : surface.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto between = [&](double a, double b) {
    const Rational part = Rational::of(static_cast<std::int64_t>(random() % 99989), 99991).value();
    return oracles::exact_of(a) + (oracles::exact_of(b) - oracles::exact_of(a)) * part;
  };
  return {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
}

/// Every position is inside of the result, once, exactly where the winding number says so.
int expect_right(const MeshData& surface, Fill fill, int positions, std::mt19937_64& random, const std::string& name) {
  const Result<SpatialSum> result = united(surface, fill);
  EXPECT_TRUE(result.ok()) << name << ": " << (result.ok() ? "" : result.error().to_string());
  if (!result.ok()) return 0;
  const oracles::ExactSurface before = oracles::exact_surface(surface), after = oracles::exact_surface(*result);
  int found = 0;
  for (int k = 0; k < positions; ++k) {
    const RationalVector at = some_position(surface, random);
    const bool in = inside(oracles::winding_at(before, at).value(), fill);
    EXPECT_EQ(oracles::winding_at(after, at), in ? 1 : 0) << name;
    found += in;
  }
  return found;
}

TEST(SolidUnion, two_boxes_that_overlap_are_one_solid) {
  const Mesh a = Mesh::create(box(0, 0, 0, 2, 2, 2)).value(), b = Mesh::create(box(1, 1, 1, 2, 2, 2)).value();
  const Mesh both[2] = {a, b};
  const SpatialSum sum = united(both).value();
  EXPECT_EQ(sum.volume_exact(), Rational(15));
  EXPECT_EQ(sum.shells, 1u);
  EXPECT_EQ(sum.faces.size(), 12u);
  EXPECT_EQ(sum.vertices.size(), 20u);
  EXPECT_EQ(intersection(a, b)->volume_exact(), Rational(1));
  EXPECT_EQ(difference(a, b)->volume_exact(), Rational(7));
  EXPECT_EQ(symmetric_difference(a, b)->volume_exact(), Rational(14));
  const Result<SpatialSum::Rounded> mesh = sum.rounded();
  ASSERT_TRUE(mesh.ok());
  EXPECT_TRUE(mesh->nearest);
  EXPECT_TRUE(Mesh::create(mesh->mesh).ok());
}

TEST(SolidUnion, boxes_that_share_a_face_an_edge_or_a_corner) {
  const MeshData a = box(0, 0, 0, 1, 1, 1);
  const SpatialSum face = united(together({a, box(1, 0, 0, 1, 1, 1)})).value();
  EXPECT_EQ(face.faces.size(), 6u);
  EXPECT_EQ(face.vertices.size(), 8u);
  const SpatialSum edge = united(together({a, box(1, 1, 0, 1, 1, 1)})).value();
  EXPECT_EQ(edge.faces.size(), 12u);
  EXPECT_EQ(edge.volume_exact(), Rational(2));
  const SpatialSum corner = united(together({a, box(1, 1, 1, 1, 1, 1)})).value();
  EXPECT_EQ(corner.vertices.size(), 15u);
  const SpatialSum part = united(together({a, box(1, 0.25, 0.25, 1, 0.5, 0.5)})).value();
  EXPECT_EQ(part.faces.size(), 11u);
  EXPECT_EQ(part.shells, 1u);
  EXPECT_TRUE(united(together({a, inside_out(a)}))->faces.empty()) << "nothing is inside";
  EXPECT_EQ(united(together({a, a}))->faces.size(), 6u);
  EXPECT_TRUE(united(together({a, a}), Fill::even_odd)->faces.empty());
}

TEST(SolidUnion, shells_inside_of_shells) {
  const MeshData outer = box(0, 0, 0, 4, 4, 4), inner = box(1, 1, 1, 2, 2, 2);
  EXPECT_EQ(united(together({outer, inside_out(inner)}))->volume_exact(), Rational(56));
  EXPECT_EQ(united(together({outer, inner}))->volume_exact(), Rational(64));
  EXPECT_EQ(united(together({outer, inner}), Fill::even_odd)->volume_exact(), Rational(56));
  EXPECT_TRUE(united(inside_out(outer))->faces.empty());
  EXPECT_EQ(united(inside_out(outer), Fill::nonzero)->volume_exact(), Rational(64));
  const SpatialSum island = united(together({outer, inside_out(inner), box(1.5, 1.5, 1.5, 1, 1, 1)})).value();
  EXPECT_EQ(island.shells, 3u);
  EXPECT_EQ(island.volume_exact(), Rational(57));
}

TEST(SolidUnion, faces_name_those_of_the_surface) {
  const MeshData surface = together({box(0, 0, 0, 2, 2, 2), box(1, 1, 1, 2, 2, 2)});
  const SpatialSum sum = united(surface).value();
  for (const SpatialFace& face : sum.faces) {
    ASSERT_EQ(face.p.kind, SolidFeature::Kind::face);
    const Face& named = surface.faces[face.p.a];
    // All vertices of the result's face are in the plane of the one that it names.
    const auto at = [&](std::uint32_t v) { return oracles::exact_of(surface.vertices[v]); };
    for (const std::uint32_t v : face.loops[0]) {
      const RationalVector gap = oracles::vector_of(sum.exact(v)) - at(named[0]);
      EXPECT_EQ(oracles::determinant(at(named[1]) - at(named[0]), at(named[2]) - at(named[0]), gap).sign(), 0);
    }
  }
}

TEST(SolidUnion, what_does_not_close_is_an_error_with_its_position) {
  MeshData open = together({box(0, 0, 0, 1, 1, 1), box(5, 0, 0, 1, 1, 1)});
  open.faces.pop_back();
  const Result<SpatialSum> result = united(open);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::not_closed);
  ASSERT_TRUE(result.error().evidence.x);
  EXPECT_GE(*result.error().evidence.x, 5);
  open.vertices[0].y = std::nan("");
  EXPECT_EQ(united(open).error().code, ErrorCode::not_finite);
  EXPECT_EQ(united(MeshData{{{0, 0, 0}}, {{0, 1, 2}}}).error().code, ErrorCode::bad_index);
  EXPECT_TRUE(united(MeshData{})->faces.empty());
}

TEST(SolidUnion, an_edge_may_have_other_vertices_on_its_other_side) {
  MeshData m = box(0, 0, 0, 1, 1, 1);
  // The upper half of one face by itself: its vertices lie inside edges that know nothing of them.
  for (std::size_t f = 0; f < m.faces.size(); ++f) {
    Face& face = m.faces[f];
    const auto on_top = [&](std::uint32_t v) { return m.vertices[v].z == 1; };
    if (!std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return m.vertices[v].x == 1; })) continue;
    const auto low = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.push_back({1, 0, 0.5}), m.vertices.push_back({1, 1, 0.5});
    Face upper, lower;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t v = face[k], w = face[(k + 1) % face.size()];
      (on_top(v) ? upper : lower).push_back(v);
      if (on_top(v) == on_top(w)) continue;
      const std::uint32_t midpoint = m.vertices[v].y == 0 ? low : low + 1;
      upper.push_back(midpoint), lower.push_back(midpoint);
    }
    face = upper;
    m.faces.push_back(lower);
    break;
  }
  const SpatialSum sum = united(m).value();
  EXPECT_EQ(sum.faces.size(), 6u);
  EXPECT_EQ(sum.volume_exact(), Rational(1));
}

TEST(SolidUnion, memory_and_progress_are_kept) {
  std::vector<Mesh> balls;
  for (int k = 0; k < 6; ++k) {
    MeshData m = solids::geodesic_sphere(3, 1).data();
    for (Point3& p : m.vertices) p.x += 0.3 * k;
    balls.push_back(Mesh::create(std::move(m)).value());
  }
  SpatialOptions options;
  options.memory = 100000;
  EXPECT_EQ(united(balls, options).error().code, ErrorCode::out_of_memory);
  options.memory = 0;
  int queried = 0;
  options.progress = [&](std::string_view, double) { return ++queried < 4; };
  EXPECT_EQ(united(balls, options).error().code, ErrorCode::cancelled);
  options.progress = {};
  options.threads = 1;
  const SpatialSum one = united(balls, options).value();
  options.threads = 5;
  EXPECT_EQ(united(balls, options).value(), one);
  EXPECT_EQ(one.shells, 1u);
}

// Of facet edges that are much shorter than the solid, as where an opening lies on what was opened but for rounding,
// doubles know no side: their ends' own errors are larger. Found by `./run bench files`; the smallest of 400 such
// openings.
TEST(SolidUnion, faces_beside_the_shortest_borders_are_named) {
  std::mt19937_64 random(259);
  const Mesh p = Mesh::create(of_kind(triangulated(random_solids::valid_polyhedron(random)).mesh.data(),
                                      CoordinateKind::turned, random))
                     .value();
  const SolidOpening opened = opening(p, solids::geodesic_sphere(1, 0.125), {}, BetweenSteps::rounded).value();
  const MeshData drawn = opened.solid.drawn().mesh;
  const SpatialSum solid = united(drawn).value();
  ASSERT_FALSE(solid.faces.empty());
  EXPECT_NEAR(solid.volume(), opened.solid.volume(), 1e-12);
}

// Closed surfaces with small integers for coordinates, which cross themselves and each other, touch, and lie on each
// other, some of them inside out, and the same with other coordinates.
TEST(SolidUnion, positions_are_inside_where_winding_numbers_say_so) {
  std::mt19937_64 random(40501);
  std::map<Fill, int> found;
  for (int n = 0; n < 36; ++n) {
    MeshData surface;
    for (int k = 0; k < 1 + n % 3; ++k) {
      MeshData m = random_solids::tiny_polyhedron(random);
      for (Point3& p : m.vertices) p.x += static_cast<double>(random() % 3), p.y += static_cast<double>(random() % 2);
      surface = together({surface, random() % 3 == 0 ? inside_out(m) : m});
    }
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(n / 3) % kCoordinateKinds.size()];
    surface = of_kind(std::move(surface), kind, random);
    for (const Fill fill : {Fill::positive, Fill::nonzero, Fill::even_odd})
      found[fill] += expect_right(surface, fill, 4, random, "surface " + std::to_string(n) + ", " + name_of(kind));
  }
  EXPECT_GT(found[Fill::positive], 8);
  EXPECT_GT(found[Fill::nonzero], 8);
  EXPECT_GT(found[Fill::even_odd], 8);
}

TEST(SolidUnion, of_any_number_of_solids_is_common_or_taken_away) {
  const std::vector<Mesh> boxes{solids::box(0, 0, 0, 4, 4, 4), solids::box(1, 0, 0, 5, 4, 4),
                                solids::box(0, 2, 0, 4, 6, 4)};
  EXPECT_EQ(intersection(boxes)->volume_exact(), Rational(24));
  EXPECT_EQ(intersection(std::span(boxes).first(1))->volume_exact(), Rational(64));
  EXPECT_EQ(intersection(std::span<const Mesh>{}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(difference(boxes[0], std::span(boxes).subspan(1))->volume_exact(), Rational(8));
  EXPECT_EQ(difference(boxes[0], std::span<const Mesh>{})->volume_exact(), Rational(64));
}

// Volumes of the union and of the intersection together are those of both; and so on, exactly.
TEST(SolidUnion, volumes_keep_the_laws) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 36; ++n) {
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(n) % kCoordinateKinds.size()];
    const auto some = [&]() -> Mesh {
      while (true) {
        MeshData m = random_solids::tiny_polyhedron(random);
        const auto shift = static_cast<double>(random() % 3);
        for (Point3& p : m.vertices) p.x += shift;
        if (Result<Mesh> mesh = Mesh::create(of_kind(std::move(m), kind, random)); mesh.ok()) return *std::move(mesh);
      }
    };
    const Mesh solids[2] = {some(), some()};
    const auto &a = solids[0], &b = solids[1];
    const Mesh alone_a[1] = {a}, alone_b[1] = {b};
    const Rational va = united(alone_a)->volume_exact(), vb = united(alone_b)->volume_exact();
    const Rational all = united(solids)->volume_exact(), common = intersection(a, b)->volume_exact();
    EXPECT_EQ(all + common, va + vb) << n;
    EXPECT_EQ(difference(a, b)->volume_exact(), va - common) << n;
    EXPECT_EQ(difference(b, a)->volume_exact(), vb - common) << n;
    EXPECT_EQ(symmetric_difference(a, b)->volume_exact(), all - common) << n;
    // By itself a solid is what it was.
    const Mesh origin = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();
    EXPECT_EQ(united(alone_a).value(), minkowski_sum(a, origin).value()) << n;
  }
}

// Unions of boxes at lattice points against the cells that they hold.
TEST(SolidUnion, boxes_of_a_lattice_hold_their_cells) {
  std::mt19937_64 random(99);
  for (int n = 0; n < 40; ++n) {
    MeshData surface;
    std::map<oracles::Voxel, int> winding;
    for (int k = 0; k < 5; ++k) {
      const auto draw = [&](int m) { return static_cast<int>(random() % static_cast<unsigned>(m)); };
      const int x = draw(4), y = draw(4), z = draw(4), dx = 1 + draw(3), dy = 1 + draw(3), dz = 1 + draw(3);
      const bool out = draw(4) == 0;
      const MeshData m = box(x, y, z, dx, dy, dz);
      surface = together({surface, out ? inside_out(m) : m});
      for (int i = x; i < x + dx; ++i)
        for (int j = y; j < y + dy; ++j)
          for (int l = z; l < z + dz; ++l) winding[{i, j, l}] += out ? -1 : 1;
    }
    for (const Fill fill : {Fill::positive, Fill::nonzero, Fill::even_odd}) {
      Voxels cells;
      for (const auto& [cell, w] : winding)
        if (inside(w, fill)) cells.insert(cell);
      const SpatialSum sum = united(surface, fill).value();
      EXPECT_EQ(sum.volume_exact(), Rational(static_cast<int>(cells.size()))) << n;
      // The boundary of the cells is the same set, with the same faces once they are merged.
      EXPECT_EQ(sum, united(oracles::voxel_mesh(cells)).value()) << n;
    }
  }
}

}  // namespace
}  // namespace dymsum
