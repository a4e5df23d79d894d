// Sums of which an operand is a result, against sums of the same sets in integers, and their laws.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "dymsum/sum_locator.h"
#include "oracles/check_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/scaled_result.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kTripleSeed = 20261130;

int triples(int usual) {
  const char* queried = std::getenv("DYMSUM_FUZZ_OPERANDS");
  return queried != nullptr ? std::atoi(queried) : usual;
}

Region region_of(const RegionData& data) {
  Result<Region> region = Region::create(data);
  if (!region.ok()) throw std::runtime_error(region.error().to_string() + "\n" + to_wkt(data));
  return *std::move(region);
}

struct Triple {
  RegionData p, q, r;
};
std::string text_of(const Triple& t) { return to_wkt(t.p) + "\n" + to_wkt(t.q) + "\n" + to_wkt(t.r); }

/// Calls check(P, Q, R) for random triples, and names the first that fails.
template <class Check>
void for_triples(int count, const Check& check) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kTripleSeed));
  for (int k = 0; k < count; ++k) {
    Random random(kTripleSeed + static_cast<std::uint64_t>(k));
    const auto [p, q] = random_pair(random, 4);
    const Triple triple{p, q, random.chance(30) ? negated(region_of(p)).data() : random_region(random, 3)};
    SCOPED_TRACE("triple " + std::to_string(k) + "\n" + text_of(triple));
    check(triple);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(OperandSums, of_a_sum_equal_those_of_the_same_region_in_integers) {
  std::size_t fractions = 0, compared = 0;
  for_triples(triples(400), [&](const Triple& t) {
    const Region p = region_of(t.p), q = region_of(t.q), r = region_of(t.r);
    const PlanarSum m = minkowski_sum(p, q).value();
    const BigInt factor = denominator_of(m);
    const std::optional<RegionData> m_data = times_integer(m, factor);
    if (!m_data) return;
    const double f = factor.convert_to<double>();
    const Region whole = region_of(*m_data), part = region_of(mapped(t.r, f, 0, 0, f));
    ++compared;
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      SumOptions options;
      options.semantics = semantics;
      const PlanarSum nested = minkowski_sum(m, r, options).value();
      fractions += nested.stats.tier_bits == 0;
      EXPECT_TRUE(times_integer(canonical_shape(nested), factor) ==
                  canonical_shape(minkowski_sum(whole, part, options).value()));
      const PlanarSum other = minkowski_sum(r, m, options).value();
      EXPECT_TRUE(nested == other) << "commutes";
      for (const Engine engine : {Engine::brute, Engine::winding}) {
        options.engine = engine;
        EXPECT_TRUE(nested == minkowski_sum(m, r, options).value());
      }
    }
    EXPECT_TRUE(times_integer(canonical_shape(nfp(m, r).value()), factor) == canonical_shape(nfp(whole, part).value()));
    EXPECT_EQ(check_sum(whole, part, Semantics::closed, minkowski_sum(whole, part).value()), "");
  });
  EXPECT_GT(compared, 100u);
  EXPECT_GT(fractions, 100u);
}

TEST(OperandSums, are_associative_and_commute) {
  for_triples(triples(400), [&](const Triple& t) {
    const Region p = region_of(t.p), q = region_of(t.q), r = region_of(t.r);
    const PlanarSum pq = minkowski_sum(p, q).value(), qr = minkowski_sum(q, r).value(),
                    pr = minkowski_sum(p, r).value();
    const PlanarSum all = minkowski_sum(pq, r).value();
    EXPECT_TRUE(same_set(all, minkowski_sum(p, qr).value()));
    EXPECT_TRUE(same_set(all, minkowski_sum(pr, q).value()));
    const std::array<PlanarOperand, 3> sets{p, q, r};
    EXPECT_TRUE(all == minkowski_sum(sets).value());
  });
}

/// Whether a turn to the left of a ring is at a position that is no lattice point of integer operands.
std::size_t convex_crossings(const PlanarSum& sum, std::size_t& crossings) {
  std::size_t convex = 0;
  const ExactShape<Big> shape = exact_shape<Big>(sum);
  const auto whole = [](const Pt<Big>& v) { return denominator(v.x) == 1 && denominator(v.y) == 1; };
  const auto add = [&](const ExactRing<Big>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (whole(ring[k])) continue;
      ++crossings;
      const Pt<Big>&a = ring[(k + ring.size() - 1) % ring.size()], &b = ring[k], &c = ring[(k + 1) % ring.size()];
      convex += (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) > 0;
    }
  };
  for (const ExactPart<Big>& part : shape.parts) {
    add(part.outer);
    for (const auto& hole : part.holes) add(hole);
  }
  return convex;
}

TEST(OperandSums, have_no_convex_corner_that_is_no_sum_of_vertices) {
  std::size_t crossings = 0;
  for_triples(triples(1000), [&](const Triple& t) {
    const PlanarSum m = minkowski_sum(region_of(t.p), region_of(t.q)).value();
    EXPECT_EQ(convex_crossings(m, crossings), 0u);
    EXPECT_EQ(convex_crossings(minkowski_sum(m, region_of(t.r)).value(), crossings), 0u);
  });
  EXPECT_GT(crossings, 100u);
}

/// The digits of the widest number of a result.
std::size_t widest(const PlanarSum& sum) {
  std::size_t most = 0;
  for (const SumPart& part : sum.parts)
    for (const SumVertex& v : part.outer.vertices) {
      const RationalPoint at = sum.exact(v);
      for (const Rational* c : {&at.x, &at.y}) most = std::max(most, c->to_string().size());
    }
  return most;
}

TEST(OperandSums, of_ten_steps_are_those_of_halves_and_no_number_grows) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kTripleSeed));
  for (int k = 0; k < triples(6); ++k) {
    Random random(kTripleSeed + 7 * static_cast<std::uint64_t>(k));
    std::vector<Region> terms;
    for (int i = 0; i < 10; ++i) terms.push_back(region_of({{{random_polygon(random, 30, 5), {}}}, {}, {}}));
    const auto sum_of = [](std::span<const Region> some) {
      const std::vector<PlanarOperand> sets(some.begin(), some.end());
      return minkowski_sum(sets).value();
    };
    const std::span<const Region> all(terms);
    const PlanarSum chain = sum_of(all), low = sum_of(all.first(5)), high = sum_of(all.subspan(5));
    EXPECT_TRUE(same_set(chain, minkowski_sum(low, high).value()));
    EXPECT_LE(widest(chain), 4u * 14u) << "of integers below 2^9: 3 9 + 8 bits over 2 9 + 4";
  }
}

TEST(OperandSums, of_every_kind_of_coordinates_are_associative) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kTripleSeed));
  std::size_t fractions = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int k = 0; k < triples(20); ++k) {
      Random random(kTripleSeed + 7 * static_cast<std::uint64_t>(k));
      std::mt19937_64 noise(kTripleSeed);
      const auto drawn = [&] { return Region::create(of_kind(random_parts(random, 6), kind, noise)); };
      const Result<Region> p = drawn(), q = drawn(), r = drawn();
      if (!p || !q || !r) continue;  // rounding has spoilt a shape that touched itself
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(k));
      const PlanarSum pq = minkowski_sum(*p, *q).value(), qr = minkowski_sum(*q, *r).value();
      const PlanarSum left = minkowski_sum(pq, *r).value(), right = minkowski_sum(*p, qr).value();
      fractions += left.stats.tier_bits == 0;
      EXPECT_TRUE(same_set(left, right));
      if (::testing::Test::HasFailure()) return;
    }
  EXPECT_GT(fractions, 30u);
}

TEST(OperandSums, hold_the_points_that_the_sum_of_the_same_region_in_integers_holds) {
  std::size_t inside = 0;
  for_triples(triples(200), [&](const Triple& t) {
    const Region p = region_of(t.p), q = region_of(t.q), r = region_of(t.r);
    const PlanarSum m = minkowski_sum(p, q).value();
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      SumOptions options;
      options.semantics = semantics;
      const PlanarSum sum = minkowski_sum(m, r, options).value();
      const SumLocator locator(sum, semantics);
      for (double x = -1; x <= 12; x += 1.5)
        for (double y = -1; y <= 12; y += 1.5) {
          EXPECT_EQ(contains(m, r, {x, y}, semantics), locator.contains({x, y})) << x << " " << y;
          inside += locator.contains({x, y});
        }
    }
  });
  EXPECT_GT(inside, 1000u);
}

TEST(OperandSums, of_nothing_are_nothing) {
  const Region square = region_of({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}}, {}, {}}), empty;
  const PlanarSum none = minkowski_sum(square, empty).value();
  EXPECT_TRUE(minkowski_sum(none, square).value().parts.empty());
  EXPECT_TRUE(minkowski_sum(none, none).value().parts.empty());
  EXPECT_FALSE(contains(none, square, {0, 0}));
  EXPECT_FALSE(minkowski_sum(std::span<const PlanarOperand>{}).ok());
  const std::array<PlanarOperand, 1> one{square};
  EXPECT_TRUE(minkowski_sum(one).value() == minkowski_sum(square, region_of({{}, {}, {{0, 0}}})).value());
}

}  // namespace
}  // namespace dymsum::oracles
