// Slices of sums: against the section of the whole sum, and against lattice cells where the plane runs along faces.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "dymsum/solid_slice.h"
#include "dymsum/solids.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

using oracles::Voxel;
using oracles::Voxels;

Mesh mesh(const MeshData& data) { return Mesh::create(data).value(); }

int fuzz_pairs(int few) {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(few, std::atoi(text) / 10) : few;
}

using Position = std::pair<Rational, Rational>;

/// The vertices of a section, and twice its area by the faces that it crosses. For heights of no vertex.
struct Section {
  std::set<Position> vertices;
  Rational twice;
};
Section section(const SpatialSum& sum, const Rational& z) {
  Section result;
  std::vector<RationalPoint3> at;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) at.push_back(sum.exact(v));
  const auto cut = [&](std::uint32_t a, std::uint32_t b) {
    const Rational t = (z - at[a].z) / (at[b].z - at[a].z);
    return Position{at[a].x + t * (at[b].x - at[a].x), at[a].y + t * (at[b].y - at[a].y)};
  };
  for (const SpatialFace& face : sum.faces) {
    // Crossings of a face's edge with the plane, on its line, in order: pairs bound intervals.
    std::vector<std::pair<Position, bool>> crossings;
    for (const auto& loop : face.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
        if ((at[a].z < z) == (at[b].z < z)) continue;
        crossings.push_back({cut(a, b), at[a].z < z});
        result.vertices.insert(crossings.back().first);
      }
    }
    // Seen from outside, the facet edge comes up at the end of an interval that has the inside of the sum on its left.
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const auto &p = crossings[k].first, &q = crossings[k + 1].first;
      const Rational cross = p.first * q.second - p.second * q.first;
      result.twice += crossings[k].second ? -cross : cross;
    }
  }
  return result;
}

std::set<Position> vertices_of(const SolidSlice& slice) {
  std::set<Position> positions;
  const auto add = [&](const SumRing& ring) {
    for (const SumVertex& v : ring.vertices) {
      const RationalPoint at = slice.section.exact(v);
      positions.insert({at.x, at.y});
      EXPECT_LE(std::abs(v.at.x - at.x.to_double()), slice.section.at_error + 1e-300);
      EXPECT_LT(v.out.p, slice.contacts.size());
    }
  };
  for (const SumPart& part : slice.section.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return positions;
}

void expect_section(const Mesh& p, const Mesh& q, const SpatialSum& whole, double z, const std::string& what) {
  const SolidSlice slice = slice_of_sum(p, q, z).value();
  const Section expected = section(whole, *Rational::of(z));
  EXPECT_EQ(slice.section.area_exact() * Rational(2), expected.twice < Rational(0) ? -expected.twice : expected.twice)
      << what << " at " << z;
  EXPECT_TRUE(vertices_of(slice) == expected.vertices) << what << " at " << z;
}

Mesh torus(int nu, int nv, double big, double small, double turn) {
  MeshData m;
  const double pi = std::acos(-1);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * pi * i / nu, w = 2 * pi * j / nv;
      const double x = (big + small * std::cos(w)) * std::cos(u), y = (big + small * std::cos(w)) * std::sin(u),
                   z = small * std::sin(w);
      const auto snapped = [](double v) { return std::round(v * 0x1p20) / 0x1p20; };
      m.vertices.push_back({snapped(x), snapped(std::cos(turn) * y - std::sin(turn) * z),
                            snapped(std::sin(turn) * y + std::cos(turn) * z)});
    }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i % nu * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      m.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return mesh(m);
}

TEST(SolidSlice, of_tori_is_the_section_of_their_sum) {
  const Mesh p = torus(8, 6, 2, 0.6, 0), q = torus(8, 6, 1.3, 0.35, 0.7);
  const SpatialSum whole = minkowski_sum(p, q).value();
  std::mt19937_64 random(7);
  for (int k = 0; k < 12; ++k) {
    const double z = static_cast<double>(random() % 4000) / 1000.0 - 2 + 0x1p-30;
    expect_section(p, q, whole, z, "tori");
  }
  const SolidSlice slice = slice_of_sum(p, q, 0.1).value();
  EXPECT_LT(slice.stats.crossed, slice.stats.facets) << "facets elsewhere are left out";
}

TEST(SolidSlice, of_convex_and_other_solids) {
  const Mesh ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap), prism = mesh(ell());
  expect_section(prism, ball, minkowski_sum(prism, ball).value(), 4.125, "ell");
  expect_section(prism, ball, minkowski_sum(prism, ball).value(), 10.25, "ell, above");
  expect_section(ball, ball, minkowski_sum(ball, ball).value(), 0.3, "balls");
}

TEST(SolidSlice, far_from_the_origin_and_beyond_the_sum) {
  const Mesh cube = mesh(box(1)), far = translated(cube, 0, 0, 0x1p50).value();
  EXPECT_EQ(slice_of_sum(cube, far, 0x1p50 + 0.5).value().section.area_exact(), 16);
  EXPECT_TRUE(slice_of_sum(cube, far, 0).value().section.parts.empty());
  EXPECT_EQ(slice_of_sum(cube, cube, 0.1).value().section.area_exact(), 16) << "0.1 is taken at face value";
  EXPECT_TRUE(slice_of_sum(cube, cube, 2.5).value().section.parts.empty());
  EXPECT_TRUE(slice_of_sum(cube, Mesh(), 0).value().section.parts.empty());
  EXPECT_EQ(slice_of_sum(cube, cube, INFINITY).error().code, ErrorCode::not_finite);
}

TEST(SolidSlice, at_heights_far_finer_than_the_operands_is_exact) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1), far = solids::box(0, 0, 0, 1e60, 1e60, 1e60);
  for (const double z : {1e-50, 1e-70, 1e-76, 1e-100, 5e-324})
    EXPECT_EQ(slice_of_sum(cube, cube, z).value().section.area_exact(), 4) << z;
  EXPECT_EQ(slice_of_sum(far, far, 0.1).value().section.area_exact(),
            slice_of_sum(far, far, 1e50).value().section.area_exact());
}

TEST(SolidSlice, of_operands_of_very_different_sizes_is_one_or_an_error) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1), far = solids::box(0, 0, 0, 1e60, 1e60, 1e60),
             tiny = scaled(cube, 1e-60, 1e-60, 1e-60).value(), huge = scaled(cube, 1e308, 1e308, 1e308).value();
  EXPECT_TRUE(slice_of_sum(cube, far, 1).ok());
  EXPECT_TRUE(slice_of_sum(tiny, tiny, 1.5e-60).ok());
  EXPECT_EQ(slice_of_sum(tiny, far, 1).value().section.parts.size(), 1U);
  const auto wide = slice_of_sum(huge, huge, 1e308);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().code, ErrorCode::unsupported_operand);
  EXPECT_NE(wide.error().message.find("along x"), std::string::npos) << wide.error().message;
}

TEST(SolidSlice, of_a_tunnel_and_a_peg_of_its_width_has_the_way_through) {
  const Mesh block = mesh(tunnel()), peg = mesh(box(1));
  const SolidSlice along = slice_of_sum(block, peg, 0).value();
  EXPECT_EQ(along.section.area_exact(), 144);
  ASSERT_EQ(along.section.tight_segments.size(), 1u);
  EXPECT_EQ(along.section.exact(along.section.tight_segments[0].from), (RationalPoint{-6, 0}));
  EXPECT_EQ(along.section.exact(along.section.tight_segments[0].to), (RationalPoint{6, 0}));
  EXPECT_TRUE(along.touching.empty());
  EXPECT_TRUE(slice_of_sum(block, peg, 0.5).value().section.tight_segments.empty());
  MeshData upright = tunnel();
  for (Point3& v : upright.vertices) v = {v.y, v.z, v.x};
  const SolidSlice across = slice_of_sum(mesh(upright), peg, 0.3).value();
  EXPECT_EQ(across.section.area_exact(), 144);
  ASSERT_EQ(across.section.tight_points.size(), 1u);
  EXPECT_EQ(across.section.exact(across.section.tight_points[0]), (RationalPoint{}));
}

TEST(SolidSlice, along_faces_edges_and_points_of_the_sum) {
  const Mesh cube = mesh(box(1));
  const SolidSlice top = slice_of_sum(cube, cube, 2).value();
  EXPECT_EQ(top.section.area_exact(), 16);
  ASSERT_EQ(top.touching.size(), 1u);
  EXPECT_EQ(top.touching[0].outer.vertices.size(), 4u);
  const Mesh roof = Mesh::create({{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {0, 1, 1}, {4, 1, 1}},
                                  {{3, 2, 1, 0}, {0, 1, 5, 4}, {2, 3, 4, 5}, {1, 2, 5}, {3, 0, 4}}})
                        .value();
  const Mesh needle = solids::dipyramid(4, 0.5, 2, solids::kDemoSnap);
  const SolidSlice ridge = slice_of_sum(roof, needle, 1 + bounds(needle)[5]).value();
  EXPECT_TRUE(ridge.section.parts.empty());
  EXPECT_EQ(ridge.section.segments.size(), 1u);
  const SolidSlice tip = slice_of_sum(needle, needle, 2 * bounds(needle)[5]).value();
  EXPECT_TRUE(tip.section.parts.empty() && tip.section.segments.empty());
  EXPECT_EQ(tip.section.points.size(), 1u);
  // A plate in a slot: a face of positions in the plane.
  MeshData lying = tunnel();
  const SolidSlice plate = slice_of_sum(mesh(lying), solids::box(-1, -0.5, -1, 1, 0.5, 1), 0).value();
  ASSERT_EQ(plate.touching.size(), 1u);
  EXPECT_TRUE(plate.section.tight_segments.empty());
}

/// Counts of a section by lattice cells: squares, edges and points in doubled coordinates.
struct LatticeSection {
  std::size_t area = 0, touching = 0, threads = 0, dots = 0, cracks = 0, punctures = 0;
};
LatticeSection lattice_section(const Voxels& p, const Voxels& q, int doubled_z) {
  const int size = 16;
  std::vector<int> open(size * size), closed(size * size);
  for (const Voxel& a : p)
    for (const Voxel& b : q) {
      const Voxel low{2 * (a[0] + b[0]), 2 * (a[1] + b[1]), 2 * (a[2] + b[2])};
      if (doubled_z < low[2] || doubled_z > low[2] + 4) continue;
      const bool inner_z = doubled_z > low[2] && doubled_z < low[2] + 4;
      for (int x = 0; x <= 4; ++x)
        for (int y = 0; y <= 4; ++y) {
          const auto at = static_cast<std::size_t>((low[0] + x + 1) * size + low[1] + y + 1);
          closed[at] = 1;
          if (inner_z && x % 4 != 0 && y % 4 != 0) open[at] = 1;
        }
    }
  // Coordinates are one more than doubled ones: even ones are open intervals.
  LatticeSection count;
  for (int x = 1; x + 1 < size; ++x) {
    for (int y = 1; y + 1 < size; ++y) {
      const auto at = [&](int dx, int dy) { return static_cast<std::size_t>((x + dx) * size + y + dy); };
      const int ox = x % 2 == 0, oy = y % 2 == 0;
      if (ox + oy == 2) {
        count.area += closed[at(0, 0)];
        count.touching += closed[at(0, 0)] && !open[at(0, 0)];
        continue;
      }
      bool all_open = true, all_out = true;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          if ((dx == 0 && dy == 0) || (ox && dx != 0) || (oy && dy != 0)) continue;
          if (ox + oy == 1 && (dx == 0) == !ox && (dy == 0) == !oy) continue;
          all_open = all_open && open[at(dx, dy)];
          all_out = all_out && !closed[at(dx, dy)];
        }
      const bool crack = all_open && !open[at(0, 0)], thread = all_out && closed[at(0, 0)];
      (ox + oy == 1 ? count.cracks : count.punctures) += crack;
      (ox + oy == 1 ? count.threads : count.dots) += thread;
    }
  }
  return count;
}

TEST(SolidSlice, of_unions_of_cubes_is_that_of_lattice_cells) {
  int tight = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(60, 3)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const auto [a, b] = oracles::random_voxels(k % 4 == 0 ? 3 : 2, random);
    Voxels q = b;
    for (const Voxel& v : b)  // reflected ones are negative
      if (v[0] < 0 || v[1] < 0 || v[2] < 0) {
        q.clear();
        for (const Voxel& w : b) q.insert({w[0] + 2, w[1] + 2, w[2] + 2});
        break;
      }
    const Result<Mesh> p_mesh = Mesh::create(oracles::voxel_mesh(a)), q_mesh = Mesh::create(oracles::voxel_mesh(q));
    if (!p_mesh || !q_mesh) continue;
    for (int doubled = -1; doubled <= 11; ++doubled) {
      const LatticeSection expected = lattice_section(a, q, doubled);
      const SolidSlice slice = slice_of_sum(*p_mesh, *q_mesh, doubled / 2.0).value();
      const std::string what = "seed " + std::to_string(k) + " at " + std::to_string(doubled) + "/2";
      EXPECT_EQ(slice.section.area_exact(), static_cast<std::int64_t>(expected.area)) << what;
      PlanarSum touching = slice.section;
      touching.parts = slice.touching;
      EXPECT_EQ(touching.area_exact(), static_cast<std::int64_t>(expected.touching)) << what;
      const auto length = [](const std::vector<SumSegment>& segments) {
        double sum = 0;
        for (const SumSegment& s : segments) sum += std::hypot(s.to.at.x - s.from.at.x, s.to.at.y - s.from.at.y);
        return sum;
      };
      EXPECT_EQ(length(slice.section.tight_segments), static_cast<double>(expected.cracks)) << what;
      EXPECT_EQ(length(slice.section.segments), static_cast<double>(expected.threads)) << what;
      EXPECT_EQ(slice.section.tight_points.size(), expected.punctures) << what;
      EXPECT_EQ(slice.section.points.size(), expected.dots) << what;
      EXPECT_TRUE(slice.section.rounded().ok()) << what;
      tight += expected.cracks + expected.punctures > 0;
    }
  }
  EXPECT_GT(tight, oracles::rounds(5, 3));
}

}  // namespace
}  // namespace dymsum
