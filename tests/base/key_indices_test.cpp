#include "base/scratch.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace dymsum {
namespace {

// Few keys and many, close together and far apart.
TEST(KeyIndices, NumbersKeysInTheOrderInWhichTheyCome) {
  constexpr std::uint32_t kSeed = 3;
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  for (const std::uint64_t spread : {std::uint64_t{8}, std::uint64_t{40}, std::uint64_t{3000}, ~std::uint64_t{0}}) {
    KeyIndices numbers(nullptr);
    std::map<std::uint64_t, std::uint32_t> expected;
    for (int step = 0; step < 5000; ++step) {
      const std::uint64_t key = random() % spread;
      const auto it = expected.find(key);
      ASSERT_EQ(numbers.find(key), it == expected.end() ? KeyIndices::kMissing : it->second);
      if (random() % 3 == 0) continue;
      const auto [number, fresh] = numbers.add(key);
      ASSERT_EQ(fresh, it == expected.end());
      if (fresh) expected.emplace(key, static_cast<std::uint32_t>(expected.size()));
      ASSERT_EQ(number, expected.at(key));
      ASSERT_EQ(numbers.keys()[number], key);
    }
    ASSERT_EQ(numbers.keys().size(), expected.size());
  }
}

}  // namespace
}  // namespace dymsum
