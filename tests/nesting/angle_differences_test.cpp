// Differences of orientations, whichever way they are computed, are those of the definition.
#include "nesting/angle_differences.h"

#include <gtest/gtest.h>

#include <vector>

#include "oracles/random.h"

namespace dymsum::nesting {
namespace {

std::set<Rational> by_definition(const std::set<Rational>& from, const std::set<Rational>& to) {
  std::set<Rational> all;
  for (const Rational& b : to)
    for (const Rational& a : from) all.insert(b < a ? b - a + Rational(360) : b - a);
  return all;
}

std::set<Rational> differences(const std::set<Rational>& from, const std::set<Rational>& to) {
  return angle_differences(from, to, PlanningPoll(Progress()));
}

Rational random_angle(oracles::Random& random, std::int64_t denominator) {
  const std::uint64_t parts = random.next() % static_cast<std::uint64_t>(360 * denominator);
  return Rational::of(static_cast<std::int64_t>(parts), denominator).value();
}

std::int64_t one_of(oracles::Random& random, const std::vector<std::int64_t>& values) {
  return values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
}

TEST(AngleDifferences, are_those_of_the_definition) {
  oracles::Random random(4);
  // One denominator for all; several; some that have none of 40 bits in common.
  for (const std::vector<std::int64_t>& denominators :
       {std::vector<std::int64_t>{1}, {2, 3, 7, 10}, {(1LL << 40) - 87, (1LL << 39) - 7}, {1LL << 39}, {1LL << 40}}) {
    for (int k = 0; k < 20; ++k) {
      std::set<Rational> from{Rational(0)}, to;
      for (int i = 0; i < 7; ++i) from.insert(random_angle(random, one_of(random, denominators)));
      for (int i = 0; i < 5; ++i) to.insert(random_angle(random, one_of(random, denominators)));
      EXPECT_EQ(differences(from, to), by_definition(from, to));
      EXPECT_EQ(differences(from, from), by_definition(from, from));
    }
  }
}

TEST(AngleDifferences, of_equally_spaced_angles_are_themselves) {
  std::set<Rational> all;
  for (int k = 0; k < 3600; ++k) all.insert(Rational::of(k, 10).value());
  EXPECT_EQ(differences(all, all), all);
}

TEST(AngleDifferences, angles_lose_whole_turns) {
  for (const auto& [given, wanted] :
       {std::pair{"-90", "270"}, {"360", "0"}, {"450.5", "90.5"}, {"-1e-9", "359.999999999"}})
    EXPECT_EQ(reduced_angle(Rational::parse(given).value()), Rational::parse(wanted).value()) << given;
}

}  // namespace
}  // namespace dymsum::nesting
