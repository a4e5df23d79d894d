// Families of scaling sums of solids: every sum is the one from scratch, with everything that touches, in every cell,
// at every event and a 2^-200 beside; volumes are one polynomial a cell; lifetimes are what the cells hold.
#include "dymsum/solid_scaling_family.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "dymsum/convex_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_scale_events.h"
#include "dymsum/solids.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/convex/setting.h"
#include "spatial/family/family_checks.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using exact::BigRational;

Scale scale(const BigRational& s) { return Scale::of(exact::to_rational(s)).value(); }
Scale scale(const char* text) { return Scale::parse(text).value(); }
BigRational value(const Scale& s) { return exact::exact_value(s.exact()); }

SolidFamilyOptions scaled_q() {
  SolidFamilyOptions options;
  options.moving = MovingOperand::q;
  return options;
}

/// Of convex solids as minkowski_sum names what touches.
SpatialSum from_scratch(const SolidScalingFamily& family, const Scale& s) {
  const SolidPose scaled{{}, {s, s, s}};
  const bool of_p = family.options().moving == MovingOperand::p;
  const SolidPose pose_p = of_p ? scaled : SolidPose{}, pose_q = of_p ? SolidPose{} : scaled;
  MovingSolidOptions options;
  options.semantics = family.options().semantics, options.tight = family.options().tight;
  if (Result<ConvexSum> convex = ConvexSum::create(family.p(), family.q())) {
    ConvexSum sum = *std::move(convex);
    sum.set(pose_p, pose_q);
    return sum.sum();
  }
  return posed_sum(family.p(), family.q(), pose_p, pose_q, options).value();
}

/// Its polygons as triangles, which stay plane whatever happens to vertices.
MeshData in_triangles(MeshData mesh) {
  std::vector<Face> faces;
  for (const Face& f : mesh.faces) {
    if (f.size() == 6) {  // of ell(), reflex at its third or second last vertex
      const std::size_t reflex = static_cast<std::size_t>(
          std::find_if(f.begin(), f.end(), [](std::uint32_t v) { return v % 6 == 3; }) - f.begin());
      for (std::size_t k = 1; k < 5; ++k) faces.push_back({f[reflex], f[(reflex + k) % 6], f[(reflex + k + 1) % 6]});
      continue;
    }
    for (std::size_t k = 1; k + 1 < f.size(); ++k) faces.push_back({f[0], f[k], f[k + 1]});
  }
  mesh.faces = std::move(faces);
  return mesh;
}

/// Scales in every cell, the first of which makes the structure and the others use it; at `most_events` events, and a
/// 2^-200 beside these.
std::size_t check_family(const std::string& name, const SolidScalingFamily& family, std::mt19937_64& random,
                         int a_cell = 3, std::size_t most_events = 12) {
  std::vector<BigRational> ends{value(family.low())};
  for (const ScaleEvent& e : family.events()) ends.push_back(exact::exact_value(e.parameter));
  ends.push_back(value(family.high()));
  std::size_t queries = 0;
  const auto check = [&](const BigRational& s) {
    const Scale at = scale(s);
    ++queries;
    const Result<SpatialSum> sum = family.at(at);
    ASSERT_TRUE(sum.ok()) << name << " at " << s << ": " << sum.error().to_string();
    expect_same_sum(*sum, from_scratch(family, at), name + " at " + s.str());
  };
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    EXPECT_LE(ends[k], ends[k + 1]) << name;
    if (ends[k] == ends[k + 1]) continue;
    for (int i = 0; i < a_cell; ++i) {
      const BigRational s = ends[k] + (ends[k + 1] - ends[k]) * BigRational(1 + random() % 1022, 1024);
      EXPECT_EQ(family.locate(scale(s)), (SolidFamilyLocation{static_cast<std::uint32_t>(k), false})) << name;
      check(s);
      if (testing::Test::HasFatalFailure()) return queries;
    }
  }
  const BigRational beside(1, exact::BigInteger(1) << 200);
  const std::size_t step = std::max<std::size_t>(1, family.events().size() / most_events);
  for (std::size_t k = 0; k < family.events().size(); k += step) {
    const BigRational s = ends[k + 1];
    EXPECT_EQ(family.locate(scale(s)), (SolidFamilyLocation{static_cast<std::uint32_t>(k), true})) << name;
    check(s);
    if (s - beside > ends.front()) check(s - beside);
    if (s + beside < ends.back()) check(s + beside);
    if (testing::Test::HasFatalFailure()) return queries;
  }
  return queries;
}

TEST(SolidScalingFamily, SumsOfSmallPairsAreThoseFromScratch) {
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 1701);
  std::mt19937_64 random(seed);
  std::size_t queries = 0;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    const bool long_one = name == "torus with itself" || name == "gears in mesh" || name == "tori";
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale(long_one ? "31/32" : "3/4"),
                                                                 scale(long_one ? "33/32" : "3/2"), scaled_q())
                                          .value();
    queries += check_family(name, family, random);
    const SolidFamilyWork work = family.work();
    EXPECT_EQ(work.cells, work.events + 1) << name;
    EXPECT_LE(work.made, work.cells) << name << ": a structure was made twice";
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(queries, 200u);
}

TEST(SolidScalingFamily, SumsOfRandomPolyhedraOnTinyGrids) {
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 71), rounds = test::setting("DYMSUM_FUZZ_FAMILIES", 4);
  std::mt19937_64 random(seed);
  std::size_t events = 0;
  for (std::uint64_t k = 0; k < rounds; ++k) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    SolidFamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale("1/4"), scale("4"), options).value();
    events += family.events().size();
    check_family("seed " + std::to_string(seed) + ", round " + std::to_string(k), family, random, 2);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(events, rounds);
}

class SolidScalingFamilyOf : public testing::TestWithParam<CoordinateKind> {};

TEST_P(SolidScalingFamilyOf, SumsAreThoseFromScratchInAllCoordinates) {
  std::mt19937_64 random(17);
  const auto made = [&](MeshData data) {
    return moving_cases::mesh_of(of_kind(in_triangles(std::move(data)), GetParam(), random));
  };
  const std::array<std::pair<Mesh, Mesh>, 2> pairs{
      std::pair{made(ell()), made(box(1.5))},
      std::pair{made(moving_cases::torus(2, 0.75, 6, 4)), made(moving_cases::torus(1, 0.375, 5, 3))}};
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const MovingOperand moving : {MovingOperand::p, MovingOperand::q}) {
      SolidFamilyOptions options;
      options.moving = moving;
      const SolidScalingFamily family =
          SolidScalingFamily::create(pairs[k].first, pairs[k].second, scale(k == 0 ? "1/2" : "1"),
                                     scale(k == 0 ? "2" : "33/32"), options)
              .value();
      check_family(name_of(GetParam()) + ", pair " + std::to_string(k), family, random, 3, 4);
      if (HasFatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidScalingFamilyOf, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& info) { return test_name_of(info.param); });

TEST(SolidScalingFamily, EventsAreThoseOfTheSearchAndMore) {
  std::size_t quiet = 0;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name != "L with itself" && name != "tunnel + L" && name != "stars") continue;
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale("3/4"), scale("3/2"), scaled_q()).value();
    const std::vector<ScaleEvent> visible = SolidScaleEvents::create(p, q)->events(scale("3/4"), scale("3/2")).value();
    EXPECT_EQ(family.changes(scale("3/4"), scale("3/2")), visible) << name;
    EXPECT_EQ(family.work().visible, visible.size()) << name;
    quiet += family.events().size() - visible.size();
    // next() walks through the same list.
    std::vector<ScaleEvent> walked;
    for (const ScaleEvent& e : visible)
      if (e.parameter == *Rational::of(3, 4)) walked.push_back(e);
    Scale s = scale("3/4");
    while (const std::optional<ScaleEvent> e = family.next(s))
      walked.push_back(*e), s = Scale::of(e->parameter).value();
    EXPECT_EQ(walked, visible) << name;
  }
  EXPECT_GT(quiet, 0u);
}

TEST(SolidScalingFamily, ASlotTellsWhenThePegFitsExactly) {
  // A peg of side 1 in a block with a square hole of side 1: at scale 1 it fits exactly, above 1 it does not enter.
  const SolidScalingFamily family =
      SolidScalingFamily::create(moving_cases::mesh_of(tunnel()), moving_cases::mesh_of(box(1)), scale("1/4"),
                                 scale("2"), scaled_q())
          .value();
  const std::vector<ScaleEvent> changes = family.changes(scale("1/4"), scale("2"), EventChange::topology);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].parameter, Rational(1));
  const SpatialSum at = family.at(scale("1")).value();
  EXPECT_EQ(at.tight_faces.size() + at.tight_segments.size() + at.tight_points.size(), 1u);
  for (const char* beside : {"0.999", "0.9991", "1.001", "1.0011"})
    EXPECT_TRUE(family.at(scale(beside))->tight_faces.empty() && family.at(scale(beside))->tight_segments.empty());
}

Rational polynomial(const std::array<Rational, 4>& c, const Rational& s) {
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

TEST(SolidScalingFamily, TheVolumeOfACellIsOnePolynomial) {
  std::mt19937_64 random(5);
  std::size_t cells = 0;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name == "torus with itself" || name == "gears in mesh") continue;
    const Scale low = scale("3/4"), high = scale("5/4");
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, low, high, scaled_q()).value();
    std::vector<BigRational> ends{value(low)};
    for (const ScaleEvent& e : family.events()) ends.push_back(exact::exact_value(e.parameter));
    ends.push_back(value(high));
    const std::size_t step = std::max<std::size_t>(1, ends.size() / 4);
    std::optional<std::array<Rational, 4>> last;
    for (std::size_t k = 0; k + 1 < ends.size(); k += step) {
      if (ends[k] == ends[k + 1]) continue;
      const auto between = [&](int i) { return scale(ends[k] + (ends[k + 1] - ends[k]) * BigRational(i, 17)); };
      const std::array<Rational, 4> c = family.volume_polynomial(between(3)).value();
      EXPECT_EQ(family.volume_polynomial(between(11)).value(), c) << name;
      for (const int i : {2, 13})
        EXPECT_EQ(polynomial(c, between(i).exact()), from_scratch(family, between(i)).volume_exact()) << name;
      // At the event behind the cell its polynomial holds still.
      if (k + 1 < ends.size() - 1) {
        const Scale end = scale(ends[k + 1]);
        EXPECT_EQ(family.volume_polynomial(end).value(), c) << name;
        EXPECT_EQ(polynomial(c, end.exact()), from_scratch(family, end).volume_exact()) << name;
      }
      ++cells;
    }
  }
  EXPECT_GT(cells, 20u);
}

TEST(SolidScalingFamily, CubesGrowAsTheirVolumeDoes) {
  // Cubes of sides 2 and 2 s: (2 + 2 s)^3.
  const Mesh cube = moving_cases::mesh_of(box(1));
  const SolidScalingFamily family = SolidScalingFamily::create(cube, cube, scale("1/8"), scale("8")).value();
  EXPECT_TRUE(family.events().empty());
  const std::array<Rational, 4> c = family.volume_polynomial(scale("3")).value();
  EXPECT_EQ(c, (std::array<Rational, 4>{8, 24, 24, 8}));
  EXPECT_TRUE(family.at(scale("5/3"))->is_convex());
}

TEST(SolidScalingFamily, LifetimesAreWhatTheCellsHold) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name != "L with itself" && name != "cavity + cube" && name != "tunnel + L") continue;
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale("1/2"), scale("8"), scaled_q()).value();
    const std::vector<SolidLifetime> lives = family.lifetimes().value();
    const std::size_t cells = family.events().size() + 1;
    std::vector<BigRational> ends{value(family.low())};
    for (const ScaleEvent& e : family.events()) ends.push_back(exact::exact_value(e.parameter));
    ends.push_back(value(family.high()));
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      if (ends[cell] == ends[cell + 1]) continue;
      const SpatialSum sum = from_scratch(family, scale((ends[cell] + ends[cell + 1]) / 2));
      std::set<SolidContact> living;
      std::size_t shells = 0;
      for (const SolidLifetime& life : lives) {
        if (cell < life.first_cell || cell > life.last_cell) continue;
        if (life.feature == SolidFamilyFeature::shell) ++shells;
        else EXPECT_TRUE(living.insert(life.contact).second) << name << ": two lifetimes of one contact in a cell";
      }
      EXPECT_EQ(shells, sum.shells) << name << ", cell " << cell;
      for (const SpatialFace& face : sum.faces)
        EXPECT_TRUE(living.contains({face.p, face.q})) << name << ", cell " << cell;
    }
    // The cavity is filled where the cube is as large as it.
    if (name == "cavity + cube") {
      std::size_t short_ones = 0;
      for (const SolidLifetime& life : lives)
        short_ones += life.feature == SolidFamilyFeature::shell && life.last_cell + 1 < cells;
      EXPECT_EQ(short_ones, 1u);
    }
  }
}

TEST(SolidScalingFamily, DroppedStructuresAreMadeAgain) {
  const Mesh p = moving_cases::mesh_of(moving_cases::torus(3, 1, 6, 4)), q = moving_cases::mesh_of(ell());
  SolidFamilyOptions options = scaled_q();
  options.structure_bytes = 1;
  const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale("1/4"), scale("1/2"), options).value();
  ASSERT_GE(family.events().size(), 2u);
  std::mt19937_64 random(3);
  for (int round = 0; round < 2; ++round) {
    check_family("bounded", family, random, 2, 2);
    EXPECT_EQ(family.work().kept, 1u);
  }
  EXPECT_GE(family.work().made, 2 * family.work().cells - 2);
  SolidFamilyOptions all = scaled_q();
  all.structure_bytes = 0;
  const SolidScalingFamily unbounded = SolidScalingFamily::create(p, q, scale("1/4"), scale("1/2"), all).value();
  for (int round = 0; round < 2; ++round) check_family("unbounded", unbounded, random, 2, 2);
  EXPECT_EQ(unbounded.work().made, unbounded.work().kept);
  EXPECT_GT(unbounded.work().bytes, 1000u);
}

TEST(SolidScalingFamily, ThreadsQueryOneFamily) {
  const Mesh p = moving_cases::mesh_of(tunnel()), q = moving_cases::mesh_of(ell());
  SolidFamilyOptions options = scaled_q();
  options.structure_bytes = 40000;
  const SolidScalingFamily family = SolidScalingFamily::create(p, q, scale("1/8"), scale("2"), options).value();
  std::vector<std::pair<Scale, SpatialSum>> expected;
  std::mt19937_64 random(8);
  for (int k = 0; k < 40; ++k) {
    const Scale s = scale(BigRational(1, 8) + BigRational(15, 8) * BigRational(random() % 4096, 4096));
    expected.emplace_back(s, from_scratch(family, s));
  }
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k < 3 * expected.size(); ++k) {
        const auto& [s, sum] = expected[(7 * k + 11 * t) % expected.size()];
        wrong += !(family.at(s).value() == sum);
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(wrong, 0);
}

TEST(SolidScalingFamily, RefusesWhatItDoesNotTake) {
  const Mesh cube = moving_cases::mesh_of(box(1)), ell_mesh = moving_cases::mesh_of(ell());
  const auto code = [](const auto& result) { return result.error().code; };
  EXPECT_EQ(code(SolidScalingFamily::create(cube, cube, scale("2"), scale("1"))), ErrorCode::bad_scale);
  SolidFamilyOptions options;
  options.threads = -1;
  EXPECT_EQ(code(SolidScalingFamily::create(cube, cube, scale("1"), scale("2"), options)), ErrorCode::out_of_range);
  options.threads = 1, options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(code(SolidScalingFamily::create(ell_mesh, ell_mesh, scale("1"), scale("2"), options)),
            ErrorCode::cancelled);
  const SolidScalingFamily family = SolidScalingFamily::create(ell_mesh, cube, scale("1"), scale("2")).value();
  EXPECT_EQ(code(family.at(scale("3"))), ErrorCode::bad_scale);
  EXPECT_NE(family.at(scale("3")).error().message.find("3/1"), std::string::npos);
  EXPECT_EQ(code(family.volume_polynomial(scale("1/2"))), ErrorCode::bad_scale);
  EXPECT_EQ(code(family.at(scale("3/2"), [](std::string_view, double) { return false; })), ErrorCode::cancelled);
  EXPECT_EQ(code(family.lifetimes([](std::string_view, double) { return false; })), ErrorCode::cancelled);
  const Mesh none = Mesh::create(MeshData{}).value();
  const SolidScalingFamily empty = SolidScalingFamily::create(none, cube, scale("1"), scale("2")).value();
  EXPECT_TRUE(empty.events().empty());
  EXPECT_TRUE(empty.at(scale("3/2"))->vertices.empty());
  EXPECT_TRUE(empty.at(scale("4/3"))->vertices.empty());
  EXPECT_EQ(empty.volume_polynomial(scale("3/2")).value(), (std::array<Rational, 4>{}));
}

}  // namespace
}  // namespace dymsum
