// Region::create against a validator by definition, on random regions with coordinates 0 to 4, where touching, running
// along and crossing in a vertex are the rule.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"
#include "planar/region/region_reference.h"

namespace dymsum::test {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  int below(int n) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<int>((state_ >> 20) % static_cast<std::uint64_t>(n));
  }

 private:
  std::uint64_t state_;
};

std::string verdict(const RegionData& data) {
  const Result<Region> result = Region::create(data);
  return result.ok() ? "valid" : std::string(name(result.error().code));
}

std::string describe(const RegionData& data) {
  std::string text;
  for (const Part& part : data.parts) {
    std::vector<Ring> rings{part.outer};
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
    for (const Ring& ring : rings) {
      text += &ring == &rings.front() ? "\n  outer" : "\n  hole";
      for (const Point p : ring) text += " (" + std::to_string(int(p.x)) + "," + std::to_string(int(p.y)) + ")";
    }
  }
  return text;
}

// Vertices in a random square of the given side; seldom with two consecutive ones equal.
Ring random_ring(Random& random, int most, int side) {
  const int x0 = random.below(6 - side), y0 = random.below(6 - side);
  Ring ring;
  for (int count = 3 + random.below(most - 2); count > 0; --count) {
    Point p;
    do {
      p = {double(x0 + random.below(side)), double(y0 + random.below(side))};
    } while (!ring.empty() && (p == ring.back() || p == ring.front()) && random.below(32) != 0);
    ring.push_back(p);
  }
  return ring;
}

Ring oriented(Ring ring, bool counter_clockwise) {
  return encloses_counter_clockwise(ring) == counter_clockwise ? ring : reversed(std::move(ring));
}

using Tally = std::map<std::string, int>;

void compare(const RegionData& data, std::uint64_t seed, Tally& tally) {
  const std::string expected = reference_verdict(data);
  const std::string found = verdict(data);
  ++tally[found];
  const bool either = expected.find(" or ") != std::string::npos;
  ASSERT_TRUE(expected == found || (either && expected.find(found) != std::string::npos))
      << "seed " << seed << ": expected " << expected << ", found " << found << describe(data);
}

void print(const char* what, const Tally& tally) {
  std::string text;
  for (const auto& [verdict, count] : tally) text += " " + verdict + " " + std::to_string(count);
  std::printf("%s, seeds from 1:%s\n", what, text.c_str());
}

TEST(RegionFuzz, SingleRingsOnATinyGrid) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 60000; ++seed) {
    Random random(seed);
    const Ring ring = random_ring(random, 8, 5);
    ASSERT_NO_FATAL_FAILURE(compare(one_ring(seed % 8 == 0 ? ring : oriented(ring, true)), seed, tally));
  }
  print("single rings", tally);
  for (const char* verdict : {"valid", "self_crossing", "wrong_orientation", "repeated_vertex", "no_area"}) {
    EXPECT_GT(tally[verdict], 200) << verdict;
  }
}

// Loops built to touch themselves: two or three small rings spliced at a common vertex.
TEST(RegionFuzz, RingsThatComeBackToAVertex) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 40000; ++seed) {
    Random random(seed);
    const Point hub{double(random.below(5)), double(random.below(5))};
    Ring ring;
    for (int lobe = 2 + random.below(2); lobe > 0; --lobe) {
      ring.push_back(hub);
      for (int k = 2 + random.below(2); k > 0; --k) ring.push_back({double(random.below(5)), double(random.below(5))});
    }
    ASSERT_NO_FATAL_FAILURE(compare(one_ring(oriented(ring, true)), seed, tally));
  }
  print("rings through one vertex twice", tally);
  EXPECT_GT(tally["valid"], 500);
  EXPECT_GT(tally["self_crossing"], 500);
}

TEST(RegionFuzz, SeveralRingsOnATinyGrid) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 60000; ++seed) {
    Random random(seed);
    RegionData data;
    for (int part = 1 + random.below(3); part > 0; --part) {
      data.parts.push_back({oriented(random_ring(random, 4, 2 + random.below(4)), true), {}});
      for (int hole = random.below(3); hole > 0; --hole) {
        data.parts.back().holes.push_back(oriented(random_ring(random, 4, 2 + random.below(2)), false));
      }
    }
    ASSERT_NO_FATAL_FAILURE(compare(data, seed, tally));
  }
  print("several rings", tally);
  for (const char* verdict : {"valid", "rings_cross", "hole_outside"}) {
    EXPECT_GT(tally[verdict], 1000) << verdict;
  }
}

// Big squares and diamonds around small rings: deep nesting with many touching corners.
TEST(RegionFuzz, NestedRingsOnATinyGrid) {
  const std::array<Ring, 5> around = {box(0, 0, 4, 4), Ring{{2, 0}, {4, 2}, {2, 4}, {0, 2}}, box(1, 1, 3, 3),
                                      Ring{{2, 1}, {3, 2}, {2, 3}, {1, 2}}, Ring{{0, 0}, {4, 0}, {2, 2}}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 60000; ++seed) {
    Random random(seed);
    const auto ring = [&](bool outer) {
      if (random.below(3) == 0) return oriented(random_ring(random, 3, 2), outer);
      return oriented(around[static_cast<std::size_t>(random.below(5))], outer);
    };
    RegionData data;
    for (int part = 1 + random.below(3); part > 0; --part) {
      data.parts.push_back({ring(true), {}});
      for (int hole = random.below(3); hole > 0; --hole) data.parts.back().holes.push_back(ring(false));
    }
    ASSERT_NO_FATAL_FAILURE(compare(data, seed, tally));
  }
  print("nested rings", tally);
  for (const char* verdict : {"valid", "rings_cross", "hole_outside", "parts_overlap"}) {
    EXPECT_GT(tally[verdict], 1000) << verdict;
  }
}

}  // namespace
}  // namespace dymsum::test
