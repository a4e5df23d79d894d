// (A u B) (+) Q = (A (+) Q) u (B (+) Q), closed and open, where the union of A and B is known: at all vertices, middles
// of edges and tight features of the three sums, and at all cells of the lattice.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

using oracles::Voxels;

int unions(int few) {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(few, std::atoi(text) / 50) : few;
}

RationalPoint3 midpoint(const RationalPoint3& a, const RationalPoint3& b) {
  const Rational half = Rational::of(1, 2).value();
  return {(a.x + b.x) * half, (a.y + b.y) * half, (a.z + b.z) * half};
}

void add_positions_of(const SpatialSum& sum, std::vector<RationalPoint3>& positions) {
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) positions.push_back(sum.exact(v));
  for (const SpatialEdge& e : sum.edges()) positions.push_back(midpoint(sum.exact(e.from), sum.exact(e.to)));
  for (const auto& [from, to] : sum.tight_segments) positions.push_back(midpoint(sum.exact(from), sum.exact(to)));
  // between edges of a face, mostly inside it
  for (const SpatialFace& f : sum.faces) {
    const auto& loop = f.loops[0];
    positions.push_back(
        midpoint(midpoint(sum.exact(loop[0]), sum.exact(loop[1])), midpoint(sum.exact(loop[1]), sum.exact(loop[2]))));
  }
  for (const auto& loops : sum.tight_faces)
    positions.push_back(midpoint(sum.exact(loops[0][0]), sum.exact(loops[0][2])));
}

/// Checks the law at all positions, and returns how many are in the open sum.
std::size_t expect_union(const Mesh& both, const Mesh& a, const Mesh& b, const Mesh& q,
                         std::vector<RationalPoint3> positions, const std::string& name) {
  for (const Mesh* part : {&both, &a, &b}) add_positions_of(minkowski_sum(*part, q).value(), positions);
  std::size_t open = 0;
  for (const Semantics semantics : {Semantics::closed, Semantics::open}) {
    const std::vector<bool> in_both = contains_each(both, q, positions, semantics).value(),
                            in_a = contains_each(a, q, positions, semantics).value(),
                            in_b = contains_each(b, q, positions, semantics).value();
    for (std::size_t k = 0; k < positions.size(); ++k) {
      EXPECT_EQ(in_both[k], in_a[k] || in_b[k])
          << name << " at " << positions[k].x.to_string() << " " << positions[k].y.to_string() << " "
          << positions[k].z.to_string() << (semantics == Semantics::open ? ", open" : ", closed");
      open += semantics == Semantics::open && in_both[k];
    }
  }
  return open;
}

Mesh of(const Voxels& voxels, const oracles::IntegerMap& map = oracles::kNoShear) {
  return Mesh::create(oracles::voxel_mesh(voxels, map)).value();
}

TEST(UnionLaw, of_unions_of_cubes_at_all_cells_of_the_lattice) {
  for (int k = 0; k < unions(oracles::kSanitized ? 1 : 3); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(40 + k));
    const Voxels a = oracles::random_voxels(3, random)[0], b = oracles::random_voxels(3, random)[0],
                 q = oracles::random_voxels(2, random)[0];
    Voxels both = a;
    both.insert(b.begin(), b.end());
    std::vector<RationalPoint3> cells;
    std::size_t cubes = 0;
    const Rational half = Rational::of(1, 2).value();
    for (int x = -1; x <= 11; ++x)
      for (int y = -1; y <= 11; ++y)
        for (int z = -1; z <= 11; ++z)
          if ((x + y + z) % 2 != 0 || k % 2 == 0)
            cells.push_back({half * Rational(x), half * Rational(y), half * Rational(z)});
    expect_union(of(both), of(a), of(b), of(q), cells, "seed " + std::to_string(40 + k));
    std::vector<RationalPoint3> centres;
    for (int x = 0; x < 6; ++x)
      for (int y = 0; y < 6; ++y)
        for (int z = 0; z < 6; ++z) centres.push_back({half + Rational(x), half + Rational(y), half + Rational(z)});
    const std::vector<bool> in_a = contains_each(of(a), of(q), centres, Semantics::open).value(),
                            in_b = contains_each(of(b), of(q), centres, Semantics::open).value();
    for (std::size_t c = 0; c < centres.size(); ++c) cubes += in_a[c] || in_b[c];
    EXPECT_EQ(minkowski_sum(of(both), of(q)).value().volume_exact(), static_cast<std::int64_t>(cubes)) << 40 + k;
    const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
    expect_union(of(both, shear), of(a, shear), of(b, shear), of(q), {}, "sheared " + std::to_string(40 + k));
  }
}

TEST(UnionLaw, of_solids_that_touch_in_a_slanted_face) {
  // A box cut in two along a plane that is parallel to no axis.
  const Mesh box = solids::box(0, 0, 0, 4, 3, 2);
  const auto part = [](std::vector<std::pair<double, double>> low, std::vector<std::pair<double, double>> high) {
    std::vector<Point3> points;
    for (const auto& [x, y] : low) points.push_back({x, y, 0});
    for (const auto& [x, y] : high) points.push_back({x, y, 2});
    return convex_hull(points).value();
  };
  // The cut runs through (1, 0) and (2, 3) below, and (2, 0) and (3, 3) above.
  const Mesh a = part({{0, 0}, {1, 0}, {2, 3}, {0, 3}}, {{0, 0}, {2, 0}, {3, 3}, {0, 3}});
  const Mesh b = part({{1, 0}, {4, 0}, {4, 3}, {2, 3}}, {{2, 0}, {4, 0}, {4, 3}, {3, 3}});
  EXPECT_EQ(volume(a) + volume(b), volume(box));
  for (const MeshData& q : {ell(), tunnel(), solids::dipyramid(5, 1, 2, solids::kDemoSnap).data()})
    EXPECT_GT(expect_union(box, a, b, Mesh::create(q).value(), {}, "a cut box"), 0u);
}

TEST(UnionLaw, of_solids_that_are_apart) {
  for (const double gap : {11.0, 12.0, 40.0}) {  // by less than Q, by as much as it is wide, by more
    const MeshData a = ell(), b = moved(tunnel(), 5 + gap, 3, 1);
    MeshData both = a;
    for (const Point3& v : b.vertices) both.vertices.push_back(v);
    for (Face f : b.faces) {
      for (std::uint32_t& v : f) v += static_cast<std::uint32_t>(a.vertices.size());
      both.faces.push_back(f);
    }
    const auto mesh = [](const MeshData& m) { return Mesh::create(m).value(); };
    const Mesh q = mesh(box(1));
    expect_union(mesh(both), mesh(a), mesh(b), q, {}, "a gap of " + std::to_string(gap - 10));
    const SpatialSum sum = minkowski_sum(mesh(both), q).value();
    const Rational parts =
        minkowski_sum(mesh(a), q).value().volume_exact() + minkowski_sum(mesh(b), q).value().volume_exact();
    if (gap == 11.0) {
      EXPECT_LT(sum.volume_exact(), parts);
    } else {
      EXPECT_EQ(sum.volume_exact(), parts);
    }
    EXPECT_EQ(sum.tight_faces.size(), gap == 12.0 ? 1u : 0u) << gap;
  }
}

}  // namespace
}  // namespace dymsum
