#include "nesting/angle_differences.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "exact/big.h"

namespace dymsum::nesting {
namespace {

using exact::BigInteger;
using exact::BigRational;

constexpr int kPartsBits = 40;
static_assert(kPartsBits + 9 < 63, "360 degrees of so many parts, and differences of angles, are 64-bit integers");

/// The least common denominator of both sets, if it is small.
std::optional<std::int64_t> common_parts(const std::set<Rational>& from, const std::set<Rational>& to) {
  BigInteger parts = 1;
  for (const std::set<Rational>* angles : {&from, &to}) {
    for (const Rational& angle : *angles) {
      parts = lcm(parts, BigInteger(denominator(exact::exact_value(angle))));
      if ((parts >> kPartsBits) != 0) return std::nullopt;
    }
  }
  return static_cast<std::int64_t>(parts);
}

std::vector<std::int64_t> in_parts(const std::set<Rational>& angles, std::int64_t parts) {
  std::vector<std::int64_t> counts;
  for (const Rational& angle : angles)
    counts.push_back(static_cast<std::int64_t>(BigInteger(numerator(exact::exact_value(angle) * parts))));
  return counts;
}

void keep_each_once(std::vector<std::int64_t>& counts) {
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
}

}  // namespace

Rational reduced_angle(const Rational& degrees) {
  const BigRational value = exact::exact_value(degrees);
  const BigInteger turn = BigInteger(360 * denominator(value));
  BigInteger rest = numerator(value) % turn;
  if (rest.sign() < 0) rest += turn;
  return exact::to_rational(BigRational(rest, denominator(value)));
}

std::set<Rational> angle_differences(const std::set<Rational>& from, const std::set<Rational>& to,
                                     const PlanningPoll& poll) {
  constexpr std::string_view kStage = "differences of angles";
  std::set<Rational> all;
  const std::optional<std::int64_t> parts = common_parts(from, to);
  const std::size_t pairs = from.size() * to.size();
  std::size_t pair = 0;
  if (!parts) {
    for (const Rational& b : to) {
      for (const Rational& a : from) {
        all.insert(reduced_angle(b - a));
        poll.at(kStage, pair++, pairs);
      }
    }
    return all;
  }
  const std::vector<std::int64_t> a = in_parts(from, *parts), b = in_parts(to, *parts);
  std::vector<std::int64_t> found;
  std::size_t distinct = 0;
  for (const std::int64_t v : b) {
    for (const std::int64_t u : a) found.push_back(v < u ? v - u + 360 * *parts : v - u);
    pair += a.size();
    // Of equally spaced angles all sets of differences are one: memory stays that of the result.
    if (found.size() > 2 * distinct + 0x10000) {
      keep_each_once(found);
      distinct = found.size();
      poll.now(kStage, pair, pairs);
    }
  }
  keep_each_once(found);
  for (const std::int64_t count : found) {
    all.insert(all.end(), Rational::of(count, *parts).value());
    poll.at(kStage, all.size(), found.size());
  }
  return all;
}

}  // namespace dymsum::nesting
