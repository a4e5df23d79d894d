// All pairs of features that touch after the shortest moves, against every pair of features in rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "depth/touching_oracle.h"
#include "dymsum/solids.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

using Kind = SolidFeature::Kind;

Mesh solid_of(const MeshData& data) { return Mesh::create(data).value(); }

/// Counts of pairs by the kinds of their features: "vertex face" and so on.
std::map<std::string, int> kinds(const std::vector<SolidTouch>& contacts) {
  const auto name = [](Kind k) { return k == Kind::vertex ? "vertex" : k == Kind::edge ? "edge" : "face"; };
  std::map<std::string, int> counts;
  for (const SolidTouch& c : contacts) ++counts[std::string(name(c.p.kind)) + " " + name(c.q.kind)];
  return counts;
}

/// Whether a feature is another one, or on its rim.
bool is_on(const TouchingShape& s, const SolidFeature& part, const SolidFeature& of) {
  if (part == of) return true;
  const auto holds = [&](std::uint32_t v) {
    if (of.kind == Kind::edge) return v == of.a || v == of.b;
    if (of.kind == Kind::vertex) return v == of.a;
    return std::find(s.faces[of.a].begin(), s.faces[of.a].end(), v) != s.faces[of.a].end();
  };
  return part.kind < of.kind && holds(part.a) && (part.kind == Kind::vertex || holds(part.b));
}

/// Of convex faces: pairs on the rim of another one belong to its patch, and nothing else joins patches.
void expect_patches(const TouchingShape& p, const TouchingShape& q, const std::vector<SolidTouch>& contacts) {
  std::vector<std::size_t> root(contacts.size());
  for (std::size_t k = 0; k < root.size(); ++k) root[k] = k;
  const auto of = [&](std::size_t k) {
    while (root[k] != k) k = root[k];
    return k;
  };
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < contacts.size(); ++j)
      if (is_on(p, contacts[i].p, contacts[j].p) && is_on(q, contacts[i].q, contacts[j].q)) root[of(i)] = of(j);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < contacts.size(); ++j) EXPECT_EQ(of(i) == of(j), contacts[i].patch == contacts[j].patch);
}

bool has_convex_faces(const Mesh& mesh) {
  return std::all_of(mesh.faces().begin(), mesh.faces().end(), [](const Face& f) { return f.size() <= 4; });
}

/// The contacts of all ways are all pairs that touch, each with a position of both.
int expect_all_pairs(const Mesh& p, const Mesh& q, const Point3& at, const SolidDistance& d) {
  int pairs = 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(d.ways.size(), 2); ++k) {
    const SolidWay& way = d.ways[k];
    Position moved = exact_position(way.move);
    moved[0] += exact::exact_value(at.x), moved[1] += exact::exact_value(at.y), moved[2] += exact::exact_value(at.z);
    const TouchingShape ps = touching_shape(p, {}), qs = touching_shape(q, moved);
    const auto expected = touching_by_definition(ps, qs);
    std::map<std::pair<SolidFeature, SolidFeature>, int> found;
    std::set<std::uint32_t> patches;
    for (const SolidTouch& c : way.contacts) {
      found[{c.p, c.q}] = c.dimension;
      patches.insert(c.patch);
      EXPECT_TRUE(feature_holds(ps, c.p, exact_position(c.at)));
      EXPECT_TRUE(feature_holds(qs, c.q, exact_position(c.at)));
    }
    EXPECT_EQ(found, expected) << "way " << k << " of " << d.ways.size();
    EXPECT_FALSE(found.empty());
    EXPECT_TRUE(patches.empty() || *patches.rbegin() + 1 == patches.size());
    if (has_convex_faces(p) && has_convex_faces(q)) {
      EXPECT_EQ(found.size(), way.contacts.size());
      expect_patches(ps, qs, way.contacts);
    }
    pairs += static_cast<int>(found.size());
  }
  return pairs;
}

TEST(Touching, a_small_box_sunk_flush_into_a_large_one_touches_in_nine_pairs) {
  const Mesh large = solids::box(0, 0, 0, 5, 5, 5), small = solids::box(0, 0, 0, 0.25, 0.25, 0.25);
  SolidDepth pair = SolidDepth::create(large, small).value();
  const SolidDistance d = pair.at({2, 2, 4.9375});
  ASSERT_EQ(d.ways.size(), 1U);
  const std::vector<SolidTouch>& all = d.ways[0].contacts;
  EXPECT_EQ(kinds(all), (std::map<std::string, int>{{"face edge", 4}, {"face face", 1}, {"face vertex", 4}}));
  EXPECT_EQ(all[0].dimension, 2);
  EXPECT_EQ(all[0].p.kind, Kind::face);
  EXPECT_EQ(all[0].at.z, Rational(5));
  expect_all_pairs(large, small, {2, 2, 4.9375}, d);
}

TEST(Touching, flush_cubes_touch_in_face_and_face) {
  const Mesh cube = solids::box(-1, -1, -1, 1, 1, 1);
  SolidDepth pair = SolidDepth::create(cube, cube).value();
  for (const Point3& at : {Point3{2, 0, 0}, {1.5, 0, 0}, {3, 0, 0}, {1.5, 0.5, 0.25}, {2, 2, 0}, {2, 2, 2}}) {
    const SolidDistance d = pair.at(at);
    expect_all_pairs(cube, cube, at, d);
    if (at.y == 0 && at.z == 0) {
      EXPECT_EQ(kinds(d.ways.at(0).contacts),
                (std::map<std::string, int>{{"face face", 1}, {"edge edge", 4}, {"vertex vertex", 4}}));
    }
  }
  EXPECT_EQ(pair.at({2, 2, 2}).ways[0].contacts.size(), 1U) << "a corner on a corner";
}

TEST(Touching, is_left_out_where_nobody_asks) {
  DepthOptions options;
  options.contacts = false;
  const Mesh cube = solids::box(-1, -1, -1, 1, 1, 1);
  const SolidDistance d = SolidDepth::create(cube, cube, options).value().at({1.5, 0, 0});
  EXPECT_EQ(d.distance, 0.5);
  EXPECT_TRUE(d.ways.at(0).contacts.empty());
}

TEST(Touching, pieces_of_one_pair_are_listed_each) {
  // A fork of three teeth stands on a plate: its lower face of two triangles each touches in three patches.
  const Ring comb = {{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 2}, {4, 2}, {4, 0}, {5, 0}, {5, 3}, {0, 3}};
  const Mesh plate = solids::box(-10, -10, -10, 10, 0, 10), fork = solids::prism(comb, 1);
  SolidDepth pair = SolidDepth::create(plate, fork).value();
  const SolidDistance d = pair.at({0, -0.5, 0});
  ASSERT_EQ(d.ways.size(), 1U);
  expect_all_pairs(plate, fork, {0, -0.5, 0}, d);
  std::set<std::uint32_t> patches;
  for (const SolidTouch& c : d.ways[0].contacts) patches.insert(c.patch);
  EXPECT_EQ(patches.size(), 3U);
  // A long edge across the comb's front: the same edge and face in three pieces.
  const Mesh bar = solids::prism({{-1, 0}, {6, 0}, {6, 1}, {-1, 1}}, 1);  // its upper face at height 1
  SolidDepth lying = SolidDepth::create(fork, bar).value();
  const SolidDistance flat = lying.at({0, 0.5, 1});
  EXPECT_EQ(flat.meeting, Meeting::touching);
  ASSERT_EQ(flat.ways.size(), 1U);
  expect_all_pairs(fork, bar, {0, 0.5, 1}, flat);
  EXPECT_EQ(kinds(flat.ways[0].contacts).at("face face"), 3);
  EXPECT_EQ(kinds(flat.ways[0].contacts).at("face edge"), 6);
}

TEST(Touching, a_face_is_named_by_its_own_index_where_others_lie_in_its_plane) {
  const Mesh fine = solids::tessellated_cube(8, 4), tip = solids::cone(5, 0.25, 1);
  SolidDepth pair = SolidDepth::create(tip, fine).value();
  for (const Point3& at : {Point3{0.3, 0.4, 4.75}, {-3.1, 2.7, 4.75}, {3.3, 3.4, 4.9}, {-2.2, -3.7, 4.8}})
    EXPECT_GT(expect_all_pairs(tip, fine, at, pair.at(at)), 0);
}

/// Coordinates as people have them.
enum class Coordinates { grid, decimal, single, turned, noisy };

Mesh with_coordinates(const Mesh& mesh, Coordinates how, std::mt19937_64& random) {
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  const double c = std::cos(0.5), s = std::sin(0.5);
  MeshData data = how == Coordinates::grid ? mesh.data() : triangulated(mesh).mesh.data();
  for (Point3& v : data.vertices) {
    if (how == Coordinates::decimal) v = {0.1 * v.x, 0.1 * v.y, 0.1 * v.z};
    if (how == Coordinates::single)
      v = {static_cast<float>(0.1 * v.x), static_cast<float>(0.1 * v.y), static_cast<float>(0.1 * v.z)};
    if (how == Coordinates::turned) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    if (how == Coordinates::noisy) v = {v.x + noise(random), v.y + noise(random), v.z + noise(random)};
  }
  Result<Mesh> made = Mesh::create(std::move(data));
  return made ? *std::move(made) : mesh;
}

Mesh some_solid(std::mt19937_64& random) {
  switch (random() % 6) {
    case 0:
      return solid_of(ell());
    case 1:
      return solid_of(tunnel());
    case 2:
      return solid_of(box(static_cast<double>(1 + random() % 3)));
    case 3:
      return solids::tessellated_cube(4, 2);
    default:
      return random_solids::valid_polyhedron(random);
  }
}

TEST(Touching, is_every_pair_of_features_of_random_solids) {
  std::mt19937_64 random(41);
  std::map<std::string, int> seen;
  const int rounds = oracles::rounds(20);
  for (int round = 0; round < rounds; ++round)
    for (const Coordinates how :
         {Coordinates::grid, Coordinates::decimal, Coordinates::single, Coordinates::turned, Coordinates::noisy}) {
      const Mesh p = with_coordinates(some_solid(random), how, random),
                 q = with_coordinates(some_solid(random), how, random);
      SolidDepth pair = SolidDepth::create(p, q).value();
      const double unit = how == Coordinates::decimal || how == Coordinates::single ? 0.05 : 0.5;
      const auto along = [&] { return unit * (static_cast<double>(random() % 25) - 12); };
      const Point3 at{along(), along(), along()};
      const SolidDistance d = pair.at(at);
      expect_all_pairs(p, q, at, d);
      for (const SolidWay& way : d.ways)
        for (const auto& [name, count] : kinds(way.contacts)) seen[name] += count;
      if (testing::Test::HasFailure()) FAIL() << "round " << round << " " << static_cast<int>(how);
    }
  for (const char* name : {"vertex vertex", "vertex edge", "edge vertex", "vertex face", "face vertex", "edge edge",
                           "edge face", "face edge", "face face"})
    EXPECT_GT(seen[name], 0) << name;
}

}  // namespace
}  // namespace dymsum::test
