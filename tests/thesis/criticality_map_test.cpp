// The criticality map gives back the sum at every angle about its axis, and its angles are those at which the sum
// changes, exactly.
#include "thesis/criticality_map.h"

#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "spatial/convex/convex_cases.h"
#include "spatial/convex/setting.h"

namespace dymsum::test {
namespace {

using Axis = std::array<std::int32_t, 3>;

const double kPi = std::acos(-1.0);

SolidPose pose(const Rotation& r) { return {r, {}}; }

/// Facets by their features: the structure without positions.
bool same_structure(const SpatialSum& a, const SpatialSum& b) { return structure(a) == structure(b); }

/// At random angles, inside every interval (of at most `intervals`, evenly spread), and where the interval's rational
/// angle is as simple as a quarter turn.
void expect_static_sums(const Mesh& p, const Mesh& q, const CriticalityMap& map, std::mt19937_64& random, int angles,
                        std::size_t intervals) {
  std::uniform_real_distribution<double> angle(0, 2 * kPi);
  for (int k = 0; k < angles; ++k) {
    const Rotation r = map.near(angle(random));
    const SpatialSum expected = *convex_sum(p, q, pose(r));
    ASSERT_TRUE(identical(*map.at(r), expected)) << k;
  }
  const std::size_t step = std::max<std::size_t>(1, map.size() / intervals);
  std::size_t looked = 0;
  for (std::size_t i = 0; i < map.size(); i += step) {
    const std::optional<Rotation> r = map.inside(i);
    if (!r) continue;
    ++looked;
    ASSERT_EQ(*map.interval(*r), i);
    ASSERT_TRUE(identical(*map.at(*r), *convex_sum(p, q, pose(*r)))) << i;
  }
  EXPECT_GT(2 * looked, std::min(map.size(), intervals)) << "few intervals are too narrow for a Rotation";
}

TEST(CriticalityMap, equals_the_static_sum_everywhere) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 51);
  std::mt19937_64 random(seed);
  const Axis axes[] = {{0, 0, 1}, {1, 2, 3}, {-7, 4, 1}, {1000, -1, 32768}};
  for (int pair = 0; pair < 4; ++pair) {
    const Mesh p = random_round_polytope(random, 8 + 4 * pair), q = random_round_polytope(random, 20 - 4 * pair);
    const CriticalityMap map = *CriticalityMap::create(p, q, axes[pair]);
    ASSERT_GT(map.size(), 50u);
    expect_static_sums(p, q, map, random, 40, 100);
    EXPECT_GT(map.stats().pairs, 20 * map.stats().exact_pairs) << "doubles decide nearly all pairs";
  }
}

TEST(CriticalityMap, grid_polytopes_with_ties_at_events_and_throughout) {
  // A pair of these takes as long as some hundred of the planar fuzz, after which the setting is named.
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 52),
                      pairs = std::max<std::uint64_t>(24, setting("DYMSUM_FUZZ_PAIRS", 0) / 100);
  std::mt19937_64 random(seed);
  const Axis axes[] = {{0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, -1, 0}, {1, 2, 2}};
  // Quarter turns and others that carry grids to themselves about these axes.
  const std::array<std::array<std::int64_t, 2>, 9> turns{
      {{1, 0}, {1, 1}, {0, 1}, {1, -1}, {3, 1}, {-3, 1}, {2, 1}, {1, 2}, {1, 3}}};
  std::uint64_t persistent = 0, exact = 0;
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    const Axis d = axes[pair % std::size(axes)];
    const Mesh p = random_grid_polytope(random, 5 + static_cast<int>(pair % 7), 3),
               q = pair % 3 == 0   ? negated(p)
                   : pair % 3 == 1 ? p
                                   : random_grid_polytope(random, 7, 2);
    const CriticalityMap map = *CriticalityMap::create(p, q, d);
    expect_static_sums(p, q, map, random, 10, 60);
    for (const auto& [u, v] : turns) {
      const Rotation r = *Rotation::of(u, v * d[0], v * d[1], v * d[2]);
      ASSERT_TRUE(identical(*map.at(r), *convex_sum(p, q, pose(r))))
          << "seed " << seed << " pair " << pair << " turn " << u << ":" << v;
    }
    persistent += map.stats().persistent;
    exact += map.stats().exact_orders;
    EXPECT_GE(map.stats().meetings, map.size());
  }
  EXPECT_GT(persistent, 0u);
  EXPECT_GT(exact, 0u);
}

TEST(CriticalityMap, cubes_about_an_axis_of_theirs_have_the_quarter_turns) {
  const Mesh p = cube(1), q = cube(3);
  const CriticalityMap map = *CriticalityMap::create(p, q, {0, 0, 5});
  ASSERT_EQ(map.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(map.angle(k), static_cast<double>(k) * kPi / 2, 1e-15);
    const CriticalAngle exact = map.exact_angle(k);
    EXPECT_EQ(exact.radians, map.angle(k));
    // t (t^2 - 1) and infinity: the polynomials are t or t^2 - 1 up to a constant factor.
    const std::array<std::string, 3> c = exact.coefficients;
    if (k % 2 == 0) {
      EXPECT_EQ(c[0] + "," + c[2], "0,0");
    } else {
      EXPECT_EQ(std::stoi(c[0]), -std::stoi(c[2]));
      EXPECT_EQ(c[1], "0");
    }
  }
  EXPECT_GT(map.stats().persistent, 0u) << "tops and bottoms stay parallel";
  std::mt19937_64 random(53);
  expect_static_sums(p, q, map, random, 20, 4);
  for (const std::array<std::int64_t, 2> t : {std::array<std::int64_t, 2>{1, 0}, {1, 1}, {0, 1}, {1, -1}}) {
    const Rotation r = *Rotation::of(t[0], 0, 0, t[1]);
    EXPECT_EQ(map.at(r)->faces.size(), 6u);
    EXPECT_TRUE(identical(*map.at(r), *convex_sum(p, q, pose(r))));
    EXPECT_EQ(map.angle(*map.interval(r)), map.angle(t == std::array<std::int64_t, 2>{1, 0} ? 0
                                                     : t[0] == 0                            ? 2
                                                     : t[1] > 0                             ? 1
                                                                                            : 3));
  }
}

/// Face normals of prisms about their axis stay on the arcs of parallel edges, and enter and leave them.
TEST(CriticalityMap, prisms_about_their_axis) {
  const Mesh p = solids::cylinder(5, 1, 2, solids::kDemoSnap), q = solids::cylinder(7, 2, 1, solids::kDemoSnap);
  const CriticalityMap map = *CriticalityMap::create(p, q, {0, 0, 1});
  std::mt19937_64 random(54);
  expect_static_sums(p, q, map, random, 60, 200);
  EXPECT_GT(map.stats().persistent, 0u);
}

/// In general position every critical angle separates two different structures, so the map has no angle too many; that
/// it has none too few the static sums inside the intervals and between show.
TEST(CriticalityMap, every_angle_counts) {
  std::mt19937_64 random(55);
  const Mesh p = random_round_polytope(random, 9), q = random_round_polytope(random, 11);
  const CriticalityMap map = *CriticalityMap::create(p, q, {3, 1, -2});
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto before = map.inside(i), after = map.inside((i + 1) % map.size());
    if (!before || !after) continue;
    EXPECT_FALSE(same_structure(*map.at(*before), *map.at(*after))) << i;
    if (i + 1 < map.size()) {
      EXPECT_LT(map.angle(i), map.angle(i + 1));
    }
  }
}

/// Independent of the map: a sum that turns in small steps changes its structure exactly when a critical angle is
/// passed.
TEST(CriticalityMap, a_turning_sum_changes_where_the_map_says) {
  std::mt19937_64 random(56);
  const Mesh p = random_round_polytope(random, 10), q = random_round_polytope(random, 8);
  const CriticalityMap map = *CriticalityMap::create(p, q, {1, -1, 2});
  ConvexSum turning = *ConvexSum::create(p, q);
  turning.set(map.near(0));
  SpatialSum last = turning.sum();
  std::size_t last_interval = *map.interval(map.near(0)), changes = 0, quiet = 0;
  for (int k = 1; k <= 3000; ++k) {
    const Rotation r = map.near(2 * kPi * k / 3000);
    turning.set(r);
    SpatialSum sum = turning.sum();
    const std::size_t interval = *map.interval(r);
    ASSERT_EQ(*map.facet_count(r), turning.face_vertex_count() + turning.edge_edge_count());
    if (interval == last_interval) {
      ASSERT_TRUE(same_structure(sum, last)) << k;
      ++quiet;
    } else if ((last_interval + 1) % map.size() == interval) {
      ASSERT_FALSE(same_structure(sum, last)) << k;
      ++changes;
    }
    last = std::move(sum);
    last_interval = interval;
  }
  EXPECT_GT(changes, 100u);
  EXPECT_GT(quiet, 1000u);
}

TEST(CriticalityMap, solid_with_itself_and_with_its_reflection) {
  std::mt19937_64 random(57);
  const Mesh p = random_round_polytope(random, 12);
  for (const Mesh& q : {p, negated(p)}) {
    const CriticalityMap map = *CriticalityMap::create(p, q, {1, 2, 3});
    expect_static_sums(p, q, map, random, 20, 60);
    if (q == p) {
      EXPECT_EQ(map.angle(0), 0) << "all normals and arcs coincide at the start";
    }
    const Rotation none, half = *Rotation::of(0, 1, 2, 3);
    EXPECT_TRUE(identical(*map.at(none), *convex_sum(p, q)));
    EXPECT_TRUE(identical(*map.at(half), *convex_sum(p, q, pose(half))));
  }
}

TEST(CriticalityMap, coordinates_of_any_size) {
  std::mt19937_64 random(58);
  const Mesh small = random_grid_polytope(random, 7, 3);
  MeshData far = small.data();
  for (Point3& v : far.vertices) v = {v.x + 0x1p44, v.y * 0x1p-30, v.z};
  MeshData wide = small.data();
  for (Point3& v : wide.vertices) v = {v.x * 0x1p200, v.y, v.z};
  for (const Mesh& q : {*Mesh::create(far), *Mesh::create(wide)}) {
    const CriticalityMap map = *CriticalityMap::create(small, q, {1, 1, 2});
    std::uniform_real_distribution<double> angle(0, 2 * kPi);
    for (int k = 0; k < 20; ++k) {
      const Rotation r = map.near(angle(random));
      ASSERT_TRUE(identical(*map.at(r), *convex_sum(small, q, pose(r))));
    }
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (const auto r = map.inside(i)) {
        ASSERT_TRUE(identical(*map.at(*r), *convex_sum(small, q, pose(*r))));
      }
    }
  }
}

TEST(CriticalityMap, rotations_near_an_angle) {
  std::mt19937_64 random(60);
  std::uniform_real_distribution<double> angle(0, 2 * kPi);
  for (const Axis d : {Axis{0, 0, 1}, Axis{1, -2, 3}, Axis{32768, 32767, -32765}}) {
    const CriticalityMap map = *CriticalityMap::create(cube(1), cube(1), d);
    const double length = std::sqrt(double(d[0]) * d[0] + double(d[1]) * d[1] + double(d[2]) * d[2]);
    for (int k = 0; k < 200; ++k) {
      const double wanted = angle(random);
      const Rotation r = map.near(wanted);
      ASSERT_TRUE(map.interval(r).ok());
      const auto [w, x, y, z] = r.quaternion();
      const double along = (double(x) * d[0] + double(y) * d[1] + double(z) * d[2]) / length;
      EXPECT_LE(std::abs(std::remainder(2 * std::atan2(along, double(w)) - wanted, 2 * kPi)), 0x1p-28 * length);
    }
    for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) EXPECT_THROW(map.near(none), std::invalid_argument);
  }
}

TEST(CriticalityMap, memory_is_that_of_the_differences) {
  std::mt19937_64 random(59);
  const Mesh p = random_round_polytope(random, 60), q = random_round_polytope(random, 60);
  const CriticalityMap map = *CriticalityMap::create(p, q, {1, 2, 5});
  const CriticalityStats& s = map.stats();
  EXPECT_LT(s.key_bytes, 2 * s.difference_bytes);
  EXPECT_LT(10 * (s.key_bytes + s.difference_bytes), s.full_bytes);
  EXPECT_GT(map.bytes(), s.angle_bytes + s.key_bytes + s.difference_bytes);
  EXPECT_GT(map.bytes(), ConvexSum::create(p, q)->bytes());
  EXPECT_GT(s.pairs, 100 * s.exact_pairs);
  EXPECT_EQ(s.meetings, map.size()) << "general position";
}

TEST(CriticalityMap, errors) {
  const Mesh p = cube(1);
  EXPECT_EQ(CriticalityMap::create(p, p, {0, 0, 0}).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(CriticalityMap::create(p, p, {1, 32769, 0}).error().code, ErrorCode::bad_rotation);
  EXPECT_TRUE(CriticalityMap::create(p, p, {0, 65536, 0}).ok()) << "of any length when a divisor makes it short";
  EXPECT_EQ(CriticalityMap::create(p, Mesh(), {1, 0, 0}).error().code, ErrorCode::no_area);
  const CriticalityMap map = *CriticalityMap::create(p, p, {1, 2, 3});
  const Rotation other = *Rotation::of(1, 1, 2, 4);
  EXPECT_EQ(map.at(other).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(map.facet_count(other).error().code, ErrorCode::bad_rotation);
  EXPECT_EQ(map.interval(other).error().code, ErrorCode::bad_rotation);
  std::set<std::string> stages;
  for (const char* stop : {"critical angles", "structures"}) {
    const auto cancelled = CriticalityMap::create(p, p, {1, 2, 3}, [&](std::string_view stage, double fraction) {
      EXPECT_GE(fraction, 0);
      EXPECT_LE(fraction, 1);
      stages.insert(std::string(stage));
      return stage != stop;
    });
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
  }
  EXPECT_EQ(stages.size(), 2u);
}

}  // namespace
}  // namespace dymsum::test
