// Inner fits of solids: known answers, identities, and unions of cubes against lattice cells.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>

#include "dymsum/solid_erosion.h"
#include "dymsum/solids.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/erode/erosion.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using oracles::Voxel;
using oracles::Voxels;
using spatial::erosion;
using spatial::sum_of_solids;

Mesh mesh(const MeshData& data) { return Mesh::create(data).value(); }

TEST(SolidErosion, of_a_block_with_a_tunnel_by_a_cube) {
  const SpatialSum inner = erode(mesh(tunnel()), mesh(box(0.25))).value();
  EXPECT_EQ(inner.volume_exact().to_string(), "798/1");
  EXPECT_EQ(inner.shells, 1u);
  EXPECT_EQ(inner.faces.size(), 10u);
  EXPECT_TRUE(inner.tight_faces.empty() && inner.tight_segments.empty() && inner.tight_points.empty());
  EXPECT_TRUE(Mesh::create(inner.rounded().value().mesh).ok()) << "seen from outside";
}

TEST(SolidErosion, moves_with_its_operands) {
  const Mesh cube = mesh(box(0.25));
  const Rational volume = erode(mesh(tunnel()), cube).value().volume_exact();
  EXPECT_EQ(erode(mesh(tunnel()), translated(cube, 100, 0, -7).value()).value().volume_exact(), volume);
  EXPECT_EQ(erode(translated(mesh(tunnel()), 0x1p40, 0, 3).value(), cube).value().volume_exact(), volume);
}

TEST(SolidErosion, of_a_slot_by_a_plate_as_thick_is_a_face) {
  const SpatialSum fit = erode(solids::box(0, 0, 0, 8, 6, 1), solids::box(0, 0, 0, 2, 2, 1)).value();
  EXPECT_TRUE(fit.faces.empty());
  ASSERT_EQ(fit.tight_faces.size(), 1u);
  EXPECT_EQ(tight_area(fit), 24);
  EXPECT_TRUE(fit.tight_segments.empty() && fit.tight_points.empty());
  ASSERT_EQ(fit.tight_face_contacts.size(), 1u);
  for (const SolidContact& side : fit.tight_face_contacts[0]) EXPECT_EQ(side.p.kind, SolidFeature::Kind::face);
  EXPECT_NE(fit.tight_face_contacts[0][0].p, fit.tight_face_contacts[0][1].p) << "floor and ceiling";
}

TEST(SolidErosion, of_a_bore_by_a_peg_as_wide_is_a_segment) {
  const SpatialSum fit = erode(solids::box(0, 0, 0, 2, 2, 9), solids::box(-1, -1, -1, 1, 1, 1)).value();
  EXPECT_TRUE(fit.faces.empty() && fit.tight_faces.empty() && fit.tight_points.empty());
  ASSERT_EQ(fit.tight_segments.size(), 1u);
  EXPECT_EQ(length(fit, fit.tight_segments[0]), 7);
  EXPECT_EQ(fit.exact(fit.tight_segments[0][0]), (RationalPoint3{1, 1, 1}));
  EXPECT_GE(fit.tight_segment_contacts[0].size(), 4u) << "four walls";
}

TEST(SolidErosion, of_a_solid_by_itself_is_a_point) {
  const SpatialSum fit = erode(mesh(ell()), mesh(ell())).value();
  EXPECT_TRUE(fit.faces.empty() && fit.tight_faces.empty() && fit.tight_segments.empty());
  ASSERT_EQ(fit.tight_points.size(), 1u);
  EXPECT_EQ(fit.exact(fit.tight_points[0]), (RationalPoint3{}));
  EXPECT_GE(fit.tight_point_contacts[0].size(), 6u);
}

TEST(SolidErosion, of_what_is_too_large_or_empty) {
  EXPECT_EQ(erode(mesh(box(1)), mesh(box(2))).value(), SpatialSum());
  EXPECT_EQ(erode(mesh(ell()), mesh(box(2.25))).value(), SpatialSum()) << "4 wide arms";
  EXPECT_EQ(erode(Mesh(), mesh(box(2))).value(), SpatialSum());
  EXPECT_EQ(erode(mesh(box(1)), Mesh()).error().code, ErrorCode::unsupported_operand);
  const Error far = erode(scaled(mesh(box(1)), 0x1p1002, 1, 1).value(), mesh(box(1))).error();
  EXPECT_EQ(far.code, ErrorCode::unsupported_operand);
  EXPECT_TRUE(far.evidence.x.has_value());
}

TEST(SolidErosion, of_two_parts_by_two_parts_needs_both) {
  // Cubes of size 2 at 0 and 10; a pair of cubes of size 1 as far apart, and one that is closer.
  MeshData a = box(1);
  const MeshData second = moved(box(1), 10, 0, 0);
  for (const Point3& v : second.vertices) a.vertices.push_back(v);
  for (Face f : second.faces) {
    for (std::uint32_t& v : f) v += 8;
    a.faces.push_back(f);
  }
  const auto scaled_pair = [&](double gap) {
    MeshData b = a;
    for (std::size_t k = 0; k < 16; ++k) {
      Point3& v = b.vertices[k];
      const double midpoint = k < 8 ? 0 : 10;
      v = {(v.x - midpoint) / 2 + (k < 8 ? 0 : gap), v.y / 2, v.z / 2};
    }
    return b;
  };
  EXPECT_EQ(erosion(a, scaled_pair(10), {}).value().volume_exact(), 1);
  EXPECT_EQ(erosion(a, scaled_pair(9.5), {}).value().volume_exact(), *Rational::parse("1/2"));
  EXPECT_EQ(erosion(a, scaled_pair(5), {}).value(), SpatialSum()) << "one inside, the other one in between";
}

int fuzz_pairs(int few) {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(few, std::atoi(text) / 10) : few;
}

/// What fits, by lattice cells with doubled coordinates: an odd one is an open unit interval, an even one a point.
struct LatticeFit {
  std::size_t volume = 0, faces = 0, edges = 0, points = 0;
};
std::set<Voxel> lattice_fits(const Voxels& a, const Voxels& b) {
  std::set<Voxel> fits;
  const auto holds = [&](const Voxel& cell) {
    for (const Voxel& v : b) {
      for (int k = 0; k < 8; ++k) {
        Voxel at;
        for (int i = 0; i < 3; ++i) {
          const int odd = std::abs(cell[i] % 2);
          at[i] = (cell[i] - odd) / 2 + v[i] + (odd != 0 ? (k >> i) & 1 : 0);
        }
        if (!a.contains(at)) return false;
      }
    }
    return true;
  };
  for (int x = -7; x <= 7; ++x)
    for (int y = -7; y <= 7; ++y)
      for (int z = -7; z <= 7; ++z)
        if (holds({x, y, z})) fits.insert({x, y, z});
  return fits;
}
LatticeFit lattice_fit(const Voxels& a, const Voxels& b) {
  const std::set<Voxel> fits = lattice_fits(a, b);
  LatticeFit fit;
  std::set<Voxel> reached;
  for (int dimension = 3; dimension >= 0; --dimension) {
    std::vector<Voxel> found;
    for (const Voxel& c : fits) {
      const int odd = std::abs(c[0] % 2) + std::abs(c[1] % 2) + std::abs(c[2] % 2);
      if (odd == dimension && !reached.contains(c)) found.push_back(c);
    }
    (dimension == 3 ? fit.volume : dimension == 2 ? fit.faces : dimension == 1 ? fit.edges : fit.points) = found.size();
    for (const Voxel& c : found)
      for (int k = 0; k < 27; ++k) {
        Voxel at = c;
        const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        for (int i = 0; i < 3; ++i) at[i] += c[i] % 2 != 0 ? step[i] : 0;
        reached.insert(at);
      }
  }
  return fit;
}

Voxels random_set(const Voxel& size, int fraction, std::mt19937_64& random) {
  Voxels set;
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        if (static_cast<int>(random() % 100) < fraction) set.insert({x, y, z});
  if (set.empty()) set.insert({0, 0, 0});
  return set;
}

TEST(SolidErosion, of_unions_of_cubes_is_that_of_lattice_cells) {
  int tight = 0, room = 0;
  for (int k = 0; k < fuzz_pairs(16); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const Voxels a = random_set({3, 3, 3}, 80 + k % 3 * 8, random),
                 b = random_set({1 + k % 2, 1 + k / 2 % 2, 1}, 70, random);
    const LatticeFit expected = lattice_fit(a, b);
    const SpatialSum fit = erosion(oracles::voxel_mesh(a), oracles::voxel_mesh(b), {}).value();
    EXPECT_EQ(fit.volume_exact(), static_cast<std::int64_t>(expected.volume)) << "seed " << k;
    EXPECT_EQ(fit.volume(), static_cast<double>(expected.volume)) << "seed " << k;
    EXPECT_EQ(tight_area(fit), static_cast<double>(expected.faces)) << "seed " << k;
    double edges = 0;
    for (const auto& segment : fit.tight_segments) edges += length(fit, segment);
    EXPECT_EQ(edges, static_cast<double>(expected.edges)) << "seed " << k;
    EXPECT_EQ(fit.tight_points.size(), expected.points) << "seed " << k;
    tight += expected.faces + expected.edges + expected.points > 0;
    room += expected.volume > 0;
  }
  EXPECT_GT(tight, 2);
  EXPECT_GT(room, 2);
}

TEST(SolidErosion, by_a_sum_is_that_by_one_after_the_other) {
  // (A (-) B) (-) C = A (-) (B (+) C)
  const Mesh a = mesh(tunnel()), b = mesh(box(0.5)), c = solids::box(-0.25, -0.5, 0, 0.5, 0.25, 0.25);
  const Mesh once = mesh(erode(a, b).value().rounded().value().mesh);
  const Mesh both = mesh(minkowski_sum(b, c).value().rounded().value().mesh);
  EXPECT_EQ(erode(once, c).value(), erode(a, both).value());
}

/// The complement of a solid in a box from -40 to 40, and the box less a result of it.
MeshData outside(const MeshData& a) {
  MeshData all = box(40);
  for (const Point3& v : a.vertices) all.vertices.push_back(v);
  for (Face f : a.faces) {
    for (std::uint32_t& v : f) v += 8;
    all.faces.emplace_back(f.rbegin(), f.rend());
  }
  return all;
}

TEST(SolidErosion, of_a_complement_is_the_complement_of_the_sum) {
  for (const MeshData& a : {ell(), tunnel(), cavity()}) {
    const MeshData b = solids::box(-0.5, -0.25, 0, 0.5, 0.5, 0.25).data();
    const SpatialSum inner = erosion(outside(a), b, {}).value();
    const SpatialSum outer = sum_of_solids(a, negated(mesh(b)).data(), {}).value();
    const Rational frame =
        Rational(79) * (Rational(80) - *Rational::parse("3/4")) * (Rational(80) - *Rational::parse("1/4"));
    EXPECT_EQ(inner.volume_exact() + outer.volume_exact(), frame);
    EXPECT_EQ(inner.shells, outer.shells + 1);
    EXPECT_EQ(inner.tight_points.size() + inner.tight_segments.size() + inner.tight_faces.size(), 0u);
  }
  // Ways through the sum are ways in the complement's erosion.
  const SpatialSum inner = erosion(outside(tunnel()), box(1), {}).value();
  EXPECT_EQ(inner.tight_segments.size(), 1u);
}

TEST(SolidOpening, and_closing_of_an_ell) {
  const Mesh a = mesh(ell()), ball = mesh(box(1));
  EXPECT_EQ(opening(a, ball).value().solid.volume(), volume(a)) << "its arms are wider";
  EXPECT_EQ(closing(a, ball).value().solid.volume(), volume(a)) << "a cube reaches into the corner";
  EXPECT_EQ(opening(a, ball).value().moved, 0);
  const Mesh hollow = mesh(cavity());
  EXPECT_EQ(closing(hollow, mesh(box(2))).value().solid.volume_exact(), 1000) << "the cavity is filled";
  EXPECT_EQ(opening(hollow, mesh(box(1.5))).value().solid.volume_exact(), 992);
  EXPECT_EQ(opening(hollow, mesh(box(2))).value().solid.volume_exact(), 992) << "the walls are as thick as the cube";
  EXPECT_TRUE(opening(hollow, mesh(box(4))).value().solid.faces.empty());
}

/// A U of walls 1 thick.
MeshData channel() {
  oracles::Voxels voxels;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z)
        if (x == 0 || x == 3 || y == 0) voxels.insert({x, y, z});
  return oracles::voxel_mesh(voxels);
}

TEST(SolidOpening, where_the_inner_fit_has_no_volume) {
  const Mesh a = mesh(channel());
  const SpatialSum itself = spatial::sum_of_solids(a, Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value(), {}).value();
  const SolidOpening by_itself = opening(a, a).value();
  EXPECT_EQ(by_itself.solid, itself) << "one position is left";
  EXPECT_EQ(by_itself.moved, 0);
  EXPECT_EQ(opening(a, mesh(oracles::voxel_mesh({{0, 0, 0}}))).value().solid.volume_exact(), 16)
      << "faces: a cube as wide as the walls reaches all of them";
  // segments: a bar that fits into the floor alone, along z
  const Mesh bar = solids::box(0, 0, 0, 4, 1, 1);
  EXPECT_EQ(opening(a, bar).value().solid.volume_exact(), 8);
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  EXPECT_TRUE(opening(a, bar, regular).value().solid.faces.empty()) << "no room to move";
  SpatialOptions unlisted;
  unlisted.tight = false;
  EXPECT_EQ(opening(a, bar, unlisted).value().solid.volume_exact(), 8) << "what is not listed counts";
}

TEST(SolidOpening, of_unions_of_cubes_is_that_of_lattice_cells) {
  int seams = 0, flat = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(8, 2)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(500 + k));
    const Voxels a = random_set({3, 3, 3}, 75 + k % 3 * 8, random),
                 b = random_set({1 + k % 2, 1 + k / 2 % 2, 1}, 70, random);
    const Result<Mesh> p = Mesh::create(oracles::voxel_mesh(a)), q = Mesh::create(oracles::voxel_mesh(b));
    if (!p || !q) continue;
    const std::set<Voxel> fits = lattice_fits(a, b);
    const SpatialSum made = opening(*p, *q).value().solid;
    const oracles::VoxelSum expected = fits.empty() ? oracles::VoxelSum{} : oracles::lattice_sum(b, fits);
    const std::string seed = "seed " + std::to_string(500 + k);
    EXPECT_EQ(made.volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
    EXPECT_EQ(tight_area(made), static_cast<double>(expected.tight_faces)) << seed;
    double edges = 0;
    for (const auto& segment : made.tight_segments) edges += length(made, segment);
    EXPECT_EQ(edges, static_cast<double>(expected.tight_edges)) << seed;
    EXPECT_EQ(made.tight_points.size(), expected.tight_points) << seed;
    if (expected.volume == 0) continue;
    SpatialOptions brute;
    brute.engine = SpatialEngine::brute;
    EXPECT_EQ(opening(*p, *q, brute).value().solid, made) << seed;
    seams += expected.tight_faces > 0;
    const LatticeFit fit = lattice_fit(a, b);
    flat += fit.faces + fit.edges + fit.points > 0;
    if (const Result<Mesh> again = as_mesh(made)) {
      EXPECT_EQ(opening(*again, *q).value().solid.volume_exact(), made.volume_exact()) << "twice is once, " << seed;
    }
  }
  EXPECT_GT(flat, oracles::rounds(2, 2));
  EXPECT_GE(seams, oracles::rounds(1));
}

TEST(SolidOpening, of_a_tight_fit_that_is_rounded) {
  // a wedge as thick as the box: the inner fit is a triangle without volume, with corners that are sevenths
  const Mesh a = Mesh::create({{{0, 0, 0}, {7, 0, 0}, {0, 5, 0}, {0, 0, 1}, {7, 0, 1}, {0, 5, 1}},
                               {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}})
                     .value();
  const Mesh b = solids::box(0, 0, 0, 0.25, 0.25, 1);
  const SolidOpening exact = opening(a, b).value();
  EXPECT_EQ(exact.moved, 0);
  EXPECT_EQ(exact.solid.volume_exact(), *Rational::parse("9763/560"));
  const SolidOpening rounded = opening(a, b, {}, BetweenSteps::rounded).value();
  EXPECT_GT(rounded.moved, 0);
  EXPECT_LT(rounded.moved, 1e-14);
  // Corners of a quarter at both ends are cut off: a triangle of legs 0.25 and 5/28 at one, 7/20 and 0.25 at the other.
  EXPECT_NEAR(rounded.solid.volume(), 17.5 - 0.25 * 5 / 56 - 0.25 * 7 / 40, 1e-12);
}

TEST(SolidOpening, of_what_has_no_doubles_is_exact_or_rounded) {
  const Mesh ball = mesh(box(0.25));
  const Mesh a =
      Mesh::create({{{0, 0, 0}, {7, 0, 0}, {0, 5, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
          .value();
  const SolidOpening exact = opening(a, ball).value();
  EXPECT_EQ(exact.moved, 0);
  const SolidOpening rounded = opening(a, ball, {}, BetweenSteps::rounded).value();
  EXPECT_NEAR(rounded.solid.volume(), exact.solid.volume(), 1e-12);
  EXPECT_GT(rounded.moved, 0);
  EXPECT_LT(rounded.moved, 1e-14);
  EXPECT_LT(rounded.solid.volume(), volume(a));
}

TEST(SolidOpening, lies_inside_and_closing_outside_and_twice_is_once) {
  int tried = 0;
  for (int k = 0; k < fuzz_pairs(6); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(100 + k));
    const MeshData a = oracles::voxel_mesh(random_set({3, 3, 3}, 85, random));
    const Result<Mesh> solid = Mesh::create(a);
    if (!solid) continue;
    const Mesh b = mesh(box(0.25));
    const SpatialSum closed = closing(*solid, b).value().solid;
    const SpatialSum open = opening(*solid, b).value().solid;
    const Rational size = *Rational::of(volume(*solid));
    EXPECT_LE(open.volume_exact(), size);
    EXPECT_GE(closed.volume_exact(), size);
    if (const Result<Mesh> again = Mesh::create(closed.rounded().value().mesh)) {
      EXPECT_EQ(closing(*again, b).value().solid, closed) << k;
      ++tried;
    }
    if (const Result<Mesh> again = Mesh::create(open.rounded().value().mesh)) {
      EXPECT_EQ(opening(*again, b).value().solid, open) << k;
      ++tried;
    }
  }
  EXPECT_GT(tried, 2);
}

}  // namespace
}  // namespace dymsum
