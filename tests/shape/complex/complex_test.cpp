// The complex against its definition, the fast engine against all pairs. DYMSUM_FUZZ_PAIRS scales the random regions.
#include "shape/complex/complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include "oracles/coordinate_kinds.h"

#include "dymsum/shapes.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "shape/complex/definition.h"
#include "shape/complex/make_complex.h"
#include "shape/complex/ranked.h"

namespace dymsum {
namespace {

using shape::Candidates;
using shape::Complex;
using shape::Engine;
using shape::Side;
using shape::Walks;
using testing::check_complex;
using testing::summary;
using namespace shapes;

constexpr Side kSides[] = {Side::outside, Side::inside};

const char* name_of(Side side) { return side == Side::inside ? " inside" : " outside"; }

void expect_sound(const Region& region, const std::string& name) {
  for (const Side side : kSides) {
    SCOPED_TRACE(name + name_of(side));
    const Result<Complex> made = make_complex(region, side, Engine::brute);
    ASSERT_TRUE(made.ok()) << made.error().to_string();
    EXPECT_EQ(check_complex(*made), "") << summary(*made);
    const Result<Complex> fast = make_complex(region, side, Engine::fast);
    ASSERT_TRUE(fast.ok()) << fast.error().to_string();
    EXPECT_EQ(summary(*fast), summary(*made));
    EXPECT_TRUE(fast->work.certified);
  }
}

Region square_at(double x, double y, double size) { return rectangle(x, y, x + size, y + size); }

Region together(const std::vector<Region>& regions) {
  RegionData data;
  for (const Region& r : regions) data.parts.insert(data.parts.end(), r.parts().begin(), r.parts().end());
  return Region::create(data).value();
}

TEST(Complex, GeneratorsHaveTheComplexOfTheDefinitionByEitherEngine) {
  expect_sound(letter_u(4, 4, 1), "letter u");
  expect_sound(star(5, 1, 3), "star");
  expect_sound(comb(4, 2, 1, 3), "comb");
  expect_sound(grate(4, 2, 1, 3), "grate");
  expect_sound(pockets(4, 1), "grid of holes");
  expect_sound(spiral(2, 12, 1, 0.4), "spiral");
  expect_sound(disc(12, 3), "disc");
  for (const std::uint64_t seed : {7U, 8U, 9U})
    expect_sound(random_polygon(20, 2, seed), "random polygon with holes, seed " + std::to_string(seed));
}

TEST(Complex, SeveralPartsTouchingRingsPolylinesAndPoints) {
  expect_sound(together({square_at(0, 0, 2), square_at(5, 1, 3), square_at(1, 7, 1)}), "three parts");
  expect_sound(together({square_at(0, 0, 2), square_at(2, 2, 3)}), "parts that touch at corners");
  const Part plate{{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                   {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}, {{0, 5}, {1, 6}, {1, 5}}}};
  expect_sound(Region::create({{plate}, {}, {}}).value(), "holes that touch each other and the outer ring");
  expect_sound(Region::create({{}, {{{0, 0}, {4, 0}, {4, 3}}, {{1, 2}, {1, 5}}}, {}}).value(), "polylines");
  expect_sound(Region::create({{}, {}, {{0, 0}, {4, 0}, {0, 3}, {4, 3}, {9, 1}}}).value(), "points");
  expect_sound(Region::create({{}, {}, {{0, 0}}}).value(), "one point");
  expect_sound(Region::create({{}, {{{0, 0}, {1, 2}}}, {}}).value(), "one segment");
}

TEST(Complex, TinyRegionsHaveTheComplexOfTheDefinition) {
  const std::uint64_t first = oracles::setting("DYMSUM_FIRST_SEED", 0);
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", 250);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
    oracles::Random random(seed);
    const int grid = 4 + static_cast<int>(seed % 5);
    expect_sound(Region::create(oracles::random_parts(random, grid)).value(),
                 "DYMSUM_FIRST_SEED=" + std::to_string(seed));
  }
}

TEST(Complex, CoordinatesOfEveryKindHaveTheComplexOfTheDefinition) {
  std::mt19937_64 noise(7316);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int valid = 0;
    for (std::uint64_t seed = 0; seed < 12 && !HasFailure(); ++seed) {
      oracles::Random random(7316 + seed);
      const Result<Region> region =
          Region::create(of_kind(oracles::random_parts(random, 4 + static_cast<int>(seed % 4)), kind, noise));
      if (!region.ok()) continue;
      ++valid;
      expect_sound(*region, name_of(kind) + ", seed " + std::to_string(seed));
    }
    for (const Region& shape : {comb(4, 2, 1, 3), pockets(4, 1), grate(4, 2, 1, 3)})
      if (const Result<Region> region = Region::create(of_kind(shape.data(), kind, noise)))
        expect_sound(*region, name_of(kind));
    EXPECT_GT(valid, 6) << name_of(kind);
  }
}

// Radii as doubles, and radii that are told equal by congruence.

/// Twice the region, one of them mirrored: most radii come in pairs.
RegionData with_mirror_image(const RegionData& data) {
  RegionData both = data;
  const RegionData image = oracles::moved(oracles::mapped(data, -1, 0, 0, 1), 1000, 13);
  both.parts.insert(both.parts.end(), image.parts.begin(), image.parts.end());
  return both;
}

TEST(Complex, RadiiAreTheNearestDoublesAndAscend) {
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", 250) / 10;
  std::vector<Region> regions = {star(7, 1, 3), random_polygon(30, 2, 5), noisy_star(60, 0.3, 1), grate(4, 2, 1, 3)};
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    oracles::Random random(5000 + seed);
    regions.push_back(Region::create(oracles::random_parts(random, 7)).value());
  }
  regions.push_back(Region::create({{{{{0, 0}, {0x1p-1070, 0}, {0x3p-1074, 0x5p-1072}}, {}}}, {}, {}}).value());
  for (const Region& region : regions) {
    for (const Side side : kSides) {
      const Complex c = make_complex(region, side).value();
      for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
        EXPECT_EQ(c.nodes[n].radius, exact::nearest_double(exact_radius(c, n))) << "node " << n << name_of(side);
        if (n > 0) {
          EXPECT_LE(c.nodes[n - 1].radius, c.nodes[n].radius) << "node " << n;
        }
      }
    }
  }
}

TEST(Complex, DiscsWithEqualKeysHaveEqualRadii) {
  std::size_t equal = 0, without = 0, nodes = 0;
  for (std::uint64_t seed = 0; seed < oracles::setting("DYMSUM_FUZZ_PAIRS", 250) / 10; ++seed) {
    oracles::Random random(6000 + seed);
    const Region region = Region::create(with_mirror_image(oracles::random_parts(random, 9))).value();
    for (const Side side : kSides) {
      const Complex c = make_complex(region, side).value();
      std::map<std::vector<exact::BigInteger>, std::uint32_t> rank_of;
      for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
        const auto key = congruence_key(c.exact->walks, c.exact->discs[n]);
        ++nodes;
        without += key.empty();
        if (key.empty()) continue;
        const auto [found, is_new] = rank_of.emplace(key, c.nodes[n].rank);
        equal += !is_new;
        EXPECT_EQ(found->second, c.nodes[n].rank) << "seed " << seed << " node " << n << name_of(side);
      }
    }
  }
  EXPECT_GT(3 * equal, nodes);
  EXPECT_LT(20 * without, nodes);
}

// Rigid motions and similarities.

/// What a motion keeps of nodes and edges.
std::vector<std::tuple<std::uint32_t, int, std::uint32_t>> kinds_by_rank(const Complex& c) {
  std::vector<std::tuple<std::uint32_t, int, std::uint32_t>> nodes;
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n)
    nodes.emplace_back(c.nodes[n].rank, static_cast<int>(c.nodes[n].kind), c.first_spoke[n + 1] - c.first_spoke[n]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void expect_scaled(const Complex& c, const Complex& image, int scale) {
  EXPECT_EQ(kinds_by_rank(image), kinds_by_rank(c));
  EXPECT_EQ(image.edges.size(), c.edges.size());
  if (image.nodes.size() != c.nodes.size()) return;
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
    if (n > 0 && c.nodes[n].rank == c.nodes[n - 1].rank) continue;
    const auto scaled = exact_radius(c, n) * exact::RootExpression(scale);
    EXPECT_EQ(exact::compare(exact_radius(image, n), scaled), 0) << "node " << n;
  }
}

TEST(Complex, MotionsAndSimilaritiesKeepRanksAndKinds) {
  const std::uint64_t first = oracles::setting("DYMSUM_FIRST_SEED", 0);
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", 250) / 10;
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
    oracles::Random random(1000 + seed);
    const RegionData data = oracles::random_parts(random, 6);
    const std::vector<std::pair<RegionData, int>> images = {
        {oracles::moved(data, -1000, 7), 1},
        {oracles::mapped(data, 0, -1, 1, 0), 1},   // a quarter turn
        {oracles::mapped(data, -1, 0, 0, 1), 1},   // a reflection
        {oracles::mapped(data, 4, -3, 3, 4), 5}};  // by the angle of 3-4-5
    for (const Side side : kSides) {
      const Complex c = make_complex(Region::create(data).value(), side).value();
      for (std::size_t k = 0; k < images.size(); ++k) {
        SCOPED_TRACE("DYMSUM_FIRST_SEED=" + std::to_string(seed) + name_of(side) + " image " + std::to_string(k));
        expect_scaled(c, make_complex(Region::create(images[k].first).value(), side).value(), images[k].second);
      }
    }
  }
}

// Extremes.

TEST(Complex, TrianglesHaveOneDiscInsideAndNoneOutside) {
  const Region triangle = Region::create({{{{{0, 0}, {4, 0}, {0, 3}}, {}}}, {}, {}}).value();
  expect_sound(triangle, "triangle");
  EXPECT_TRUE(make_complex(triangle, Side::outside)->nodes.empty());
  const Complex inside = make_complex(triangle, Side::inside).value();
  ASSERT_EQ(kinds_by_rank(inside).size(), 4U);  // and the three corners
  EXPECT_EQ(compare_radius(inside, 3, Rational(1)), 0);
}

TEST(Complex, EmptyRegionsHaveTheEmptyComplex) {
  for (const Side side : kSides) {
    for (const Engine engine : {Engine::fast, Engine::brute}) {
      const Complex c = make_complex(Region(), side, engine).value();
      EXPECT_TRUE(c.sites.empty() && c.nodes.empty() && c.edges.empty());
    }
  }
}

TEST(Complex, LargeAndSmallCoordinatesTogetherAreExact) {
  const Ring corner = {{0, 0}, {1e300, 0}, {1e300, 1}, {1, 1}, {1, 1e300}, {0, 1e300}};
  const Ring sliver = {{0, 0}, {1, 0}, {1, 1e-300}, {0.5, 1e-301}, {0, 1e-300}};
  expect_sound(Region::create({{{corner, {}}}, {}, {}}).value(), "corner with legs of 1e300");
  expect_sound(Region::create({{{sliver, {}}}, {}, {}}).value(), "sliver of 1e-300");
}

TEST(Complex, CoordinatesAndDiscsBeyondTheRangeAreRefusedWithThePlace) {
  const Region large = Region::create({{{{{0, 0}, {1e305, 0}, {0, 1}}, {}}}, {}, {}}).value();
  const Region flat_points = Region::create({{}, {}, {{0, 0}, {1e300, 0}, {5e299, 1}}}).value();
  const Region flat_ring = Region::create({{{{{-1e300, -1}, {1e300, 0}, {2, 1}, {1, 3}}, {}}}, {}, {}}).value();
  for (const Region& region : {large, flat_points, flat_ring}) {
    const Result<Complex> made = make_complex(region, Side::outside);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::out_of_range);
    EXPECT_TRUE(made.error().evidence.x.has_value());
  }
}

TEST(Complex, ProgressAscendsAndStopsAnywhere) {
  const Region region = star(9, 1, 3);
  std::vector<double> fractions;
  const auto go_on = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "complex");
    fractions.push_back(fraction);
    return true;
  };
  ASSERT_TRUE(make_complex(region, Side::outside, Engine::fast, 1, go_on).ok());
  EXPECT_GE(fractions.size(), 4U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    std::size_t queried = 0;
    const Result<Complex> made =
        make_complex(region, Side::outside, Engine::fast, 1, [&](std::string_view, double) { return queried++ < k; });
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::cancelled);
    EXPECT_EQ(queried, k + 1);
  }
}

// Guesses that are wrong.

std::string from_guess(const Region& region, Side side, const Candidates& guess, bool& certified) {
  const Progress never_stops;
  const Complex c = complex_from(make_walks(region, side).value(), guess, 1, Poll(never_stops));
  certified = c.work.certified;
  return summary(c);
}

TEST(Complex, CandidatesWithoutThoseOfOneSiteAreCompleted) {
  bool certified = false;
  for (const Region& region : {letter_u(4, 4, 1), star(5, 1, 3), random_polygon(16, 1, 3)}) {
    for (const Side side : kSides) {
      const std::string expected = summary(make_complex(region, side, Engine::brute).value());
      const Candidates all = candidates_of(make_walks(region, side).value());
      for (std::uint32_t s = 0; s < all.size(); ++s) {
        Candidates guess = all;
        guess[s].clear();
        EXPECT_EQ(from_guess(region, side, guess, certified), expected) << "site " << s << name_of(side);
        for (auto& list : guess) std::erase(list, s);  // nobody knows it
        EXPECT_EQ(from_guess(region, side, guess, certified), expected) << "unknown site " << s << name_of(side);
      }
    }
  }
}

// Half-planes lie along the tips of the teeth, next to discs about their vertices that grow without end.
TEST(Complex, CandidatesOfCombsStayFew) {
  const Complex c = make_complex(comb(50, 2, 1, 3), Side::outside).value();
  EXPECT_EQ(c.work.full_sites, 0U);
  EXPECT_LT(c.work.candidates, 20 * c.sites.size());
}

// Each square goes once round infinity by itself: only the certificate sees that they are two.
TEST(Complex, GuessesThatFailTheCertificateFallBackToAllPairs) {
  const Region region = together({square_at(0, 0, 2), square_at(5, 1, 3)});
  bool certified = true;
  const Candidates none(make_walks(region, Side::outside)->sites.size());
  EXPECT_EQ(from_guess(region, Side::outside, none, certified),
            summary(make_complex(region, Side::outside, Engine::brute).value()));
  EXPECT_FALSE(certified);
}

// An isolated point whose cell meets one edge twice, across the direction that its cell is counted from.
TEST(Complex, CellsOfPointsMeetAnEdgeTwice) {
  const Ring triangle = {{0, 6}, {4, 2}, {7, 5}};
  for (const std::vector<Point>& points : {std::vector<Point>{{6, 6}, {7, 7}}, {{6, 6}, {7, 7}, {3, 2}, {-1, 7}}}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const auto turned = [&](Point p) {
        for (int k = 0; k < quarter; ++k) p = {-p.y, p.x};
        return p;
      };
      RegionData data{{{{}, {}}}, {}, {}};
      for (const Point& p : triangle) data.parts[0].outer.push_back(turned(p));
      for (const Point& p : points) data.points.push_back(turned(p));
      expect_sound(Region::create(data).value(), "quarter " + std::to_string(quarter));
    }
  }
}

TEST(Complex, PolylinesAndPointsThatTouchAreRefusedWithThePlace) {
  const Part square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}};
  const std::vector<RegionData> touching = {
      {{square}, {{{2, 2}, {6, 2}}}, {}},
      {{square}, {{{1, 1}, {2, 2}}}, {}},
      {{square}, {{{4, 4}, {6, 2}}}, {}},
      {{square}, {}, {{1, 1}}},
      {{square}, {}, {{4, 1}}},
      {{}, {{{0, 0}, {4, 0}}, {{2, 0}, {2, 3}}}, {}},
      {{}, {{{0, 0}, {4, 0}}, {{2, -1}, {2, 3}}}, {}},
      {{}, {{{0, 0}, {4, 0}, {2, 0}}}, {}},
      {{}, {{{0, 0}, {4, 0}}}, {{3, 0}}},
  };
  for (const RegionData& data : touching) {
    const Result<Complex> made = make_complex(Region::create(data).value(), Side::outside);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::unsupported_operand);
    EXPECT_TRUE(made.error().evidence.x.has_value());
  }
  expect_sound(Region::create({{square}, {{{5, 0}, {9, 0}, {7, 3}, {5, 0}}}, {{7, 1}}}).value(), "apart");
}

}  // namespace
}  // namespace dymsum
