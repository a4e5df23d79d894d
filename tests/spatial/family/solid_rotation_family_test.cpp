// Families of turning sums of solids: every sum is the one from scratch, in every cell, at every rational event and
// beside every one.
#include "dymsum/solid_rotation_family.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "dymsum/solids.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/convex/setting.h"
#include "spatial/events/rotating_pairs.h"
#include "spatial/family/angle_order.h"
#include "spatial/family/family_checks.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using exact::BigRational;

/// As far as a family promises: what touches may be named otherwise where faces stay parallel.
void expect_same_set(const SpatialSum& found, const SpatialSum& expected, const std::string& where) {
  ASSERT_TRUE(found == expected) << where << ": " << found.faces.size() << " faces of " << expected.faces.size();
  ASSERT_EQ(found.shells, expected.shells) << where;
  for (std::size_t v = 0; v < found.vertices.size(); ++v)
    ASSERT_LE(std::abs(found.vertices[v].x - expected.vertices[v].x), found.at_error + expected.at_error) << where;
}

/// Turns near `radians`, three of different lengths.
std::vector<AxisTurn> turns_near(const TurnAxis& axis, double radians) {
  double length = 0;
  for (const std::int32_t a : axis) length += static_cast<double>(a) * a;
  const double t = std::tan(radians / 2) / std::sqrt(length);
  std::vector<AxisTurn> turns;
  for (const int bits : {12, 20, 40})
    turns.push_back(AxisTurn::of(*Rational::of(std::ldexp(std::nearbyint(std::ldexp(t, bits)), -bits))));
  return turns;
}

struct Compared {
  std::size_t sums = 0, named_otherwise = 0;
};

/// Every sum at angles all over the range, and beside every event.
Compared check_family(const std::string& name, const SolidRotationFamily& family, double low, double high, int count) {
  Compared compared;
  SolidRotationOptions plain;
  plain.moving = family.options().moving;
  const SolidRotationEvents scratch = SolidRotationEvents::create(family.p(), family.q(), family.axis(), plain).value();
  const auto check = [&](const AxisTurn& theta) {
    const Result<SpatialSum> found = family.at(theta);
    if (!found.ok() && found.error().code == ErrorCode::bad_rotation) return;  // just outside
    ASSERT_TRUE(found.ok()) << name << ": " << found.error().to_string();
    const SpatialSum expected = scratch.at(theta).value();
    expect_same_set(*found, expected, name + " at t = " + theta.t().to_string());
    ++compared.sums;
    bool same = found->vertex_contacts == expected.vertex_contacts;
    for (std::size_t f = 0; f < found->faces.size(); ++f)
      same = same && found->faces[f].p == expected.faces[f].p && found->faces[f].q == expected.faces[f].q;
    compared.named_otherwise += !same;
  };
  for (int k = 0; k < count; ++k)
    for (const AxisTurn& theta : turns_near(family.axis(), low + (high - low) * (k + 0.37) / count)) {
      check(theta);
      if (testing::Test::HasFatalFailure()) return compared;
    }
  for (std::size_t k = 0; k < family.events().size(); k += std::max<std::size_t>(1, family.events().size() / 12)) {
    const SolidRotationEvent& event = family.events()[k];
    if (event.parameter.exact) {
      EXPECT_EQ(family.locate(*event.parameter.exact), (SolidFamilyLocation{static_cast<std::uint32_t>(k), true}));
      check(*event.parameter.exact);
    }
    for (const double by : {-1e-7, -1e-13, 1e-13, 1e-7})
      for (const AxisTurn& theta : turns_near(family.axis(), event.approx + by)) check(theta);
    if (testing::Test::HasFatalFailure()) return compared;
  }
  return compared;
}

TEST(SolidRotationFamily, SumsOfSmallPairsAreThoseFromScratch) {
  Compared all;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name != "cubes" && name != "L + cube" && name != "L with itself" && name != "tunnel + L" && name != "stars")
      continue;
    const TurnAxis axis = name == "L + cube" ? TurnAxis{0, 0, 1} : TurnAxis{1, 2, 3};
    const AxisTurn from = AxisTurn::nearest(axis, -0.21).value(), to = AxisTurn::nearest(axis, 0.33).value();
    const SolidRotationFamily family = SolidRotationFamily::create(p, q, axis, from, to).value();
    const Compared compared = check_family(name, family, -0.21, 0.33, 15);
    all.sums += compared.sums, all.named_otherwise += compared.named_otherwise;
    EXPECT_LE(family.work().made, family.work().cells) << name;
    EXPECT_LT(family.work().made, compared.sums) << name << ": no structure was used";
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(all.sums, 150u);
  // Where no faces stay parallel everything that touches is named alike.
  EXPECT_LT(4 * all.named_otherwise, all.sums);
}

TEST(SolidRotationFamily, SumsOfRandomPairsAreThoseFromScratch) {
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 31), rounds = test::setting("DYMSUM_FUZZ_TURNS", 6);
  for (std::uint64_t k = 0; k < rounds; ++k) {
    const turning_pairs::Pair pair = turning_pairs::Maker(seed + k).pair();
    SolidFamilyOptions options;
    options.moving = pair.moving;
    const Result<SolidRotationFamily> family =
        SolidRotationFamily::create(pair.p, pair.q, pair.axis, pair.from, pair.to, options);
    ASSERT_TRUE(family.ok()) << family.error().to_string();
    double low = pair.from.radians(pair.axis), high = pair.to.radians(pair.axis);
    if (high < low) high += 2 * std::numbers::pi;
    check_family("seed " + std::to_string(seed + k), *family, low, high, 6);
    if (HasFatalFailure()) return;
  }
}

TEST(SolidRotationFamily, AWholeTurnOfACubeInACube) {
  const Mesh cube = moving_cases::mesh_of(box(1));
  const SolidRotationFamily family = SolidRotationFamily::create(cube, cube, {0, 0, 1}).value();
  EXPECT_FALSE(family.ends());
  // Faces are parallel at the four quarters.
  ASSERT_EQ(family.events().size(), 4u);
  EXPECT_EQ(family.events().back().approx, std::numbers::pi);
  check_family("cubes", family, -3.1, 3.14, 24);
  EXPECT_EQ(family.work().cells, 5u);
  EXPECT_EQ(family.work().made, 4u);  // the last cell lies behind pi
  EXPECT_EQ(family.at(AxisTurn()).value().faces.size(), 6u);
  EXPECT_EQ(family.at(AxisTurn::of(*Rational::of(1, 3))).value().faces.size(), 10u);
  EXPECT_EQ(family.next(AxisTurn::of(*Rational::of(1, 3)))->parameter.exact, AxisTurn::of(1));
  EXPECT_FALSE(family.next(AxisTurn::half_turn()));
}

TEST(SolidRotationFamily, AnglesBesideAHalfTurnAreToldExactly) {
  const spatial::RotationCircle circle({0, 0, 1});
  const spatial::AngleOrder whole(circle, std::nullopt, std::nullopt);
  SolidRotationEvent event;  // t = 2^-60 behind half a theta, whose double is pi
  event.parameter.polynomial = {"-1", "1152921504606846976"}, event.parameter.opposite = true;
  event.parameter.t_low = event.parameter.t_high = 0x1p-60, event.approx = std::numbers::pi;
  const auto at = [&](const AxisTurn& angle) { return circle.position(angle); };
  const auto angle = [&](const char* t) { return at(AxisTurn::of(Rational::parse(t).value())); };
  EXPECT_EQ(whole.compare(at(AxisTurn::half_turn()), event), 1);
  EXPECT_EQ(whole.compare(at(AxisTurn()), event), 1);
  // -1 / t of chart 0.
  EXPECT_EQ(whole.compare(angle("-1152921504606846976"), event), 0);
  EXPECT_EQ(whole.compare(angle("-1152921504606846977"), event), -1);
  EXPECT_EQ(whole.compare(angle("-1152921504606846975"), event), 1);
  EXPECT_EQ(whole.compare(angle("1152921504606846976"), event), 1);
}

TEST(SolidRotationFamily, RefusesWhatItDoesNotTake) {
  const Mesh cube = moving_cases::mesh_of(box(1)), none = Mesh::create(MeshData{}).value();
  const auto code = [](const auto& result) { return result.error().code; };
  const AxisTurn some = AxisTurn::of(*Rational::of(1, 3)), more = AxisTurn::of(*Rational::of(1, 2));
  EXPECT_EQ(code(SolidRotationFamily::create(cube, cube, {0, 0, 0})), ErrorCode::bad_rotation);
  EXPECT_EQ(code(SolidRotationFamily::create(none, cube, {0, 0, 1})), ErrorCode::unsupported_operand);
  EXPECT_EQ(code(SolidRotationFamily::create(cube, cube, {0, 0, 1}, some, some)), ErrorCode::out_of_range);
  SolidFamilyOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(code(SolidRotationFamily::create(cube, cube, {0, 0, 1}, options)), ErrorCode::cancelled);
  const SolidRotationFamily family = SolidRotationFamily::create(cube, cube, {0, 0, 2}, some, more).value();
  EXPECT_EQ(family.axis(), (TurnAxis{0, 0, 1}));
  EXPECT_TRUE(family.at(some).ok());
  EXPECT_TRUE(family.at(more).ok());
  EXPECT_EQ(code(family.at(AxisTurn())), ErrorCode::bad_rotation);
  EXPECT_EQ(code(family.at(AxisTurn::half_turn())), ErrorCode::bad_rotation);
  EXPECT_EQ(code(family.at(AxisTurn::of(*Rational::of(1000000001, 2000000000)))), ErrorCode::bad_rotation);
  EXPECT_THROW(static_cast<void>(family.locate(AxisTurn())), std::invalid_argument);
}

}  // namespace
}  // namespace dymsum
