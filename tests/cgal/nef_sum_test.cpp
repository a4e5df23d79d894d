// Sums of solids against CGAL's Nef polyhedra, which mark every vertex, edge, facet and volume: the closed, the open
// and the regular sum, tight features, and membership, all exactly and in both directions.
//
// The witness follows the definition: for closed solids P and Q that are unions of convex pieces C and D, P + Q is the
// union of all C + D, and int P + int Q that of their insides: int P + int Q contains these and is contained in the
// union of all C + int D, and C + int D is int C + int D because int D is open and C the closure of its inside. CGAL
// decomposes into pieces; that their union is the solid is checked. CGAL's own minkowski_sum_3 is compared as well.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <random>
#include <string>

#include "cgal/nef_set.h"
#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum {
namespace {

using nef::Cells, nef::NefSet, nef::Place, nef::Side;

using Pieces = std::vector<std::vector<Place>>;

Pieces checked_pieces(const NefSet& solid) {
  Pieces pieces = solid.convex_pieces();
  std::vector<NefSet> hulls;
  for (const std::vector<Place>& piece : pieces) hulls.push_back(NefSet::hull(piece));
  EXPECT_TRUE(united(hulls) == solid) << "CGAL's convex decomposition";
  return pieces;
}

/// P + Q, int P + int Q, and what is tight: the complement of the open sum without the closure of that one's inside.
struct Witness {
  NefSet closed, open, tight;

  Witness(const Pieces& p, const Pieces& q) {
    std::vector<NefSet> sums, insides;
    for (const std::vector<Place>& c : p)
      for (const std::vector<Place>& d : q) {
        std::vector<Place> places;
        for (const Place& a : c)
          for (const Place& b : d) places.push_back({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
        sums.push_back(NefSet::hull(places));
        insides.push_back(sums.back().interior());
      }
    closed = united(sums), open = united(insides);
    EXPECT_TRUE(open.closure() == closed);
    tight = open.complement().without(open.complement().regularized());
  }
};

Place place_of(const SpatialSum& sum, std::uint32_t vertex) {
  const RationalPoint3 at = sum.exact(vertex);
  return {at.x, at.y, at.z};
}

void add_face(const SpatialSum& sum, const std::vector<std::vector<std::uint32_t>>& loops, Cells& cells) {
  std::vector<Side> sides;
  for (const std::vector<std::uint32_t>& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Place a = place_of(sum, loop[k]), b = place_of(sum, loop[(k + 1) % loop.size()]);
      sides.push_back(a < b ? Side{a, b} : Side{b, a});
      cells.vertices.insert(a), cells.edges.insert(sides.back());
    }
  std::sort(sides.begin(), sides.end());
  cells.facets.insert(std::move(sides));
}

Cells boundary_cells(const SpatialSum& sum) {
  Cells cells;
  for (const SpatialFace& face : sum.faces) add_face(sum, face.loops, cells);
  EXPECT_EQ(cells.edges.size(), sum.edges().size());
  return cells;
}

Cells tight_cells(const SpatialSum& sum) {
  Cells cells;
  for (const auto& loops : sum.tight_faces) add_face(sum, loops, cells);
  for (const auto& [from, to] : sum.tight_segments) {
    const Place a = place_of(sum, from), b = place_of(sum, to);
    cells.vertices.insert(a), cells.vertices.insert(b), cells.edges.insert(Side{std::min(a, b), std::max(a, b)});
  }
  for (const std::uint32_t v : sum.tight_points) cells.vertices.insert(place_of(sum, v));
  return cells;
}

Place between(const Place& a, const Place& b) {
  const Rational half = Rational(1) / Rational(2);
  return {(a[0] + b[0]) * half, (a[1] + b[1]) * half, (a[2] + b[2]) * half};
}
Place midpoint(const SpatialSum& sum, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  const Place a = place_of(sum, i), b = place_of(sum, j), c = place_of(sum, k);
  const Rational third = Rational(1) / Rational(3);
  return {(a[0] + b[0] + c[0]) * third, (a[1] + b[1] + c[1]) * third, (a[2] + b[2] + c[2]) * third};
}

/// Vertices, middles of edges and of triangles of the boundary or of what is tight: all of its vertices, some positions
/// inside every edge and face.
std::vector<Place> places_on(const Cells& cells) {
  std::vector<Place> places(cells.vertices.begin(), cells.vertices.end());
  for (const auto& [a, b] : cells.edges) places.push_back(between(a, b));
  for (const std::vector<Side>& sides : cells.facets)
    for (std::size_t k = 1; k < sides.size(); ++k)
      places.push_back(between(between(sides[0][0], sides[0][1]), between(sides[k][0], sides[k][1])));
  return places;
}

struct Tally {
  int pairs = 0, tight = 0, too_large = 0;
  int located = 0, queried = 0, inside = 0, touching = 0, outside = 0;
};

class Comparison {
 public:
  Comparison(const MeshData& p, const MeshData& q, Tally& tally)
      : p_(Mesh::create(p).value()),
        q_(Mesh::create(q).value()),
        nef_p_(NefSet::solid(p)),
        nef_q_(NefSet::solid(q)),
        q_pieces_(checked_pieces(nef_q_)),
        witness_(checked_pieces(nef_p_), q_pieces_),
        tally_(tally) {}

  void run(std::uint64_t seed) {
    ++tally_.pairs;
    compare_sets();
    locate_ours();
    query_membership(seed);
  }

  /// minkowski_sum_3 has the closed sum of closed operands and the open one of open ones. Of an open operand and a
  /// closed one the sum is the open one as well; CGAL 5.5.1 often adds parts of the boundary to it, and fills tight
  /// positions where int P and x - Q have nothing in common (see locate_ours). Such results are counted.
  void compare_with_cgal() {
    EXPECT_TRUE(cgal_sum(nef_p_, nef_q_) == witness_.closed) << "minkowski_sum_3 of closed operands";
    EXPECT_TRUE(cgal_sum(nef_p_.interior(), nef_q_.interior()) == witness_.open) << "of open operands";
    const NefSet mixed = cgal_sum(nef_p_.interior(), nef_q_);
    EXPECT_TRUE(mixed.closure() == witness_.closed) << "of an open and a closed one";
    EXPECT_TRUE(witness_.open.without(mixed).empty()) << "of an open and a closed one";
    tally_.too_large += !(mixed == witness_.open);
  }

 private:
  /// at - Q.
  NefSet q_reflected_at(const Place& at) const {
    std::vector<NefSet> hulls;
    for (const std::vector<Place>& piece : q_pieces_) {
      std::vector<Place> places;
      for (const Place& b : piece) places.push_back({at[0] - b[0], at[1] - b[1], at[2] - b[2]});
      hulls.push_back(NefSet::hull(places));
    }
    return united(hulls);
  }

  void compare_sets() {
    const Cells boundary = witness_.closed.cells(), tight = witness_.tight.cells();
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular})
      for (const SpatialEngine engine : {SpatialEngine::fast, SpatialEngine::brute}) {
        SpatialOptions options;
        options.semantics = semantics, options.engine = engine;
        sum_ = minkowski_sum(p_, q_, options).value();
        EXPECT_EQ(sum_.volume_exact(), witness_.closed.volume());
        EXPECT_TRUE(boundary_cells(sum_) == boundary);
        EXPECT_TRUE(tight_cells(sum_) == (semantics == Semantics::regular ? Cells{} : tight));
      }
    sum_ = minkowski_sum(p_, q_).value();
    tally_.tight += !tight.vertices.empty();
  }

  /// Positions on our boundary are in the closed sum and not in the open one; those on what is tight inside the closed
  /// one.
  void locate_ours() {
    const NefSet inside = witness_.closed.interior();
    std::vector<Place> boundary = places_on({boundary_cells(sum_).vertices, boundary_cells(sum_).edges, {}});
    for (const auto& [a, b, c] : spatial::triangulated(sum_).triangles) boundary.push_back(midpoint(sum_, a, b, c));
    for (const Place& at : boundary) {
      EXPECT_TRUE(witness_.closed.locate(at).marked && !witness_.open.locate(at).marked);
      EXPECT_LT(witness_.closed.locate(at).dimension, 3);
    }
    std::vector<Place> tight;
    for (const auto& [a, b] : sum_.tight_segments) tight.push_back(between(place_of(sum_, a), place_of(sum_, b)));
    for (const auto& [a, b, c] : sum_.tight_triangles()) tight.push_back(midpoint(sum_, a, b, c));
    for (const std::uint32_t v : sum_.tight_points) tight.push_back(place_of(sum_, v));
    for (const Place& at : tight) {
      EXPECT_TRUE(inside.locate(at).marked && !witness_.open.locate(at).marked);
      EXPECT_TRUE(witness_.tight.locate(at).marked);
      const NefSet moved = q_reflected_at(at);
      EXPECT_TRUE(nef_p_.interior().common_with(moved).empty() && nef_p_.common_with(moved.interior()).empty());
      EXPECT_FALSE(nef_p_.common_with(moved).empty());
    }
    tally_.located += static_cast<int>(boundary.size() + tight.size());
  }

  /// `contains` at the vertices of the witness, on its edges and facets, at what is tight, and anywhere.
  void query_membership(std::uint64_t seed) {
    std::vector<Place> places = places_on(witness_.closed.cells()), tight = places_on(witness_.tight.cells());
    places.insert(places.end(), tight.begin(), tight.end());
    std::mt19937_64 random(seed);
    const std::array<double, 6> a = bounds(p_), b = bounds(q_);
    for (int k = 0; k < 40; ++k) {
      Place at;
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational low = *Rational::of(a[i]) + *Rational::of(b[i]),
                       high = *Rational::of(a[i + 3]) + *Rational::of(b[i + 3]);
        at[i] = low + (high - low) * Rational(static_cast<int>(random() % 25)) / Rational(24);
      }
      places.push_back(at);
    }
    for (const Place& at : places) query(at);
  }

  void query(const Place& at) {
    const RationalPoint3 z{at[0], at[1], at[2]};
    const bool closed = witness_.closed.locate(at).marked, open = witness_.open.locate(at).marked;
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      const auto answer = contains_each(p_, q_, std::span(&z, 1), semantics);
      ASSERT_TRUE(answer.ok()) << answer.error().to_string();
      EXPECT_EQ((*answer)[0], semantics == Semantics::open ? open : closed);
      ++tally_.queried;
    }
    ++(open ? tally_.inside : closed ? tally_.touching : tally_.outside);
  }

  Mesh p_, q_;
  NefSet nef_p_, nef_q_;
  Pieces q_pieces_;
  Witness witness_;
  SpatialSum sum_;
  Tally& tally_;
};

void compare(const std::string& name, const MeshData& p, const MeshData& q, std::uint64_t seed, Tally& tally) {
  SCOPED_TRACE(name);
  Comparison comparison(p, q, tally);
  comparison.run(seed);
  comparison.compare_with_cgal();
}

void print(const char* what, const Tally& t) {
  std::printf(
      "%s: %d pairs, %d with tight features; %d places of ours located, %d answers of contains (%d places inside, "
      "%d touching, %d outside); %d sums of CGAL's of an open and a closed operand are too large\n",
      what, t.pairs, t.tight, t.located, t.queried, t.inside, t.touching, t.outside, t.too_large);
}

MeshData mapped(MeshData mesh, const std::function<Point3(Point3)>& map) {
  for (Point3& v : mesh.vertices) v = map(v);
  return mesh;
}
Point3 sheared(Point3 v) { return {v.x + 2 * v.y - v.z, v.y + v.z, v.z}; }
Point3 turned(Point3 v) { return {v.y, v.z, v.x}; }
MeshData reflected(const MeshData& mesh) { return negated(Mesh::create(mesh).value()).data(); }

TEST(NefSum, of_known_solids) {
  const MeshData plate = solids::box(-1, -1, -0.5, 1, 1, 0.5).data();
  const MeshData wedge = solids::prism({{0, 0}, {3, 0}, {0, 2}}, 1).data();
  const std::vector<std::tuple<const char*, MeshData, MeshData>> pairs{
      {"two boxes", box(1), solids::box(0, -1, 2, 3, 0.5, 4).data()},
      {"a block with a tunnel and a peg as wide", tunnel(), box(1)},
      {"the same with a thinner peg", tunnel(), box(0.75)},
      {"a block with a tunnel and a plate as high", tunnel(), plate},
      {"a cube with a cavity and its key", cavity(), box(1)},
      {"the same with a smaller key", cavity(), box(0.75)},
      {"a cube with a cavity and a plate as wide", cavity(), plate},
      {"an L and a cube", ell(), box(0.25)},
      {"an L with itself", ell(), ell()},
      {"an L with its reflection", ell(), reflected(ell())},
      {"an L and an L turned", ell(), mapped(ell(), turned)},
      {"a sheared tunnel and its peg", mapped(tunnel(), sheared), mapped(box(1), sheared)},
      {"a sheared cavity and its key", mapped(cavity(), sheared), mapped(box(1), sheared)},
      {"a tunnel and an oblique wedge", tunnel(), mapped(wedge, sheared)},
      {"an L and a wedge", ell(), wedge},
  };
  Tally tally;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    compare(std::get<0>(pairs[k]), std::get<1>(pairs[k]), std::get<2>(pairs[k]), k, tally);
  print("known solids", tally);
}

MeshData tetrahedron(std::mt19937_64& random) {
  while (true) {
    random_solids::Tetrahedron t;
    for (Point3& v : t)
      v = {static_cast<double>(random() % 4), static_cast<double>(random() % 4), static_cast<double>(random() % 4)};
    if (random_solids::six_volume(t) > 0) return random_solids::boundary({t});
  }
}

TEST(NefSum, of_tetrahedra) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    std::mt19937_64 random(seed);
    const MeshData p = tetrahedron(random);
    compare("seed " + std::to_string(seed), p, seed % 4 == 0 ? reflected(p) : tetrahedron(random), seed, tally);
  }
  print("tetrahedra", tally);
}

/// A cube with a cavity of this shape.
MeshData around(const MeshData& hollow) {
  MeshData mesh = box(8);
  mesh.vertices.insert(mesh.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (Face f : hollow.faces) {
    for (std::uint32_t& v : f) v += 8;
    mesh.faces.push_back({f.rbegin(), f.rend()});
  }
  return mesh;
}

// The key is the cavity reflected: it fits in one position at least. A part of it, or a shorter one, fits in more.
TEST(NefSum, of_cavities_and_their_keys) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 7; ++seed) {
    std::mt19937_64 random(seed);
    const MeshData hollow = seed < 6 ? tetrahedron(random) : random_solids::valid_polyhedron(random).data();
    compare("seed " + std::to_string(seed), around(hollow), reflected(hollow), seed, tally);
  }
  print("cavities and their keys", tally);
  EXPECT_EQ(tally.tight, tally.pairs);
}

TEST(NefSum, of_unions_of_cubes) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    const auto [p, q] = oracles::random_voxels(seed % 10 == 0 ? 3 : 2, random);
    const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
    const oracles::IntegerMap& map = seed % 2 == 0 ? oracles::kNoShear : shear;
    compare("seed " + std::to_string(seed), oracles::voxel_mesh(p, map), oracles::voxel_mesh(q, map), seed, tally);
  }
  print("unions of cubes", tally);
  EXPECT_GT(tally.tight, 5);
}

TEST(NefSum, of_small_polyhedra) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::mt19937_64 random(seed);
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    compare("seed " + std::to_string(seed), p.data(), q.data(), seed, tally);
  }
  print("small polyhedra", tally);
}

TEST(NefSum, of_tetrahedra_put_together) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    std::mt19937_64 random(seed);
    const int scale = 2 + static_cast<int>(random() % 2);
    const auto complex = random_solids::random_complex(random, 1, scale);
    const auto other = random_solids::random_complex(random, 1, scale);
    const Result<Mesh> p = Mesh::create(random_solids::boundary(complex)),
                       q = Mesh::create(random_solids::boundary(other));
    if (!p.ok() || !q.ok() || p->empty() || q->empty()) continue;  // moved vertices may touch what they should not
    compare("seed " + std::to_string(seed), p->data(), q->data(), seed, tally);
  }
  print("tetrahedra put together", tally);
}

}  // namespace
}  // namespace dymsum
