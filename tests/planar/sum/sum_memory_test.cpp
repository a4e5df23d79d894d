// Limits of memory of planar computations: an error that says what would have been held, or the result of no limit.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "dymsum/planar_local_sum.h"
#include "dymsum/planar_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"

namespace dymsum {
namespace {

Region lying(const Region& region) {
  RegionData data = region.data();
  for (Part& part : data.parts)
    for (Point& p : part.outer) p = {-p.y, p.x};
  return Region::create(data).value();
}

Region tilted(const Region& region) {
  RegionData data = region.data();
  for (Part& part : data.parts)
    for (Point& p : part.outer) p = {0.96 * p.x - 0.28 * p.y, 0.28 * p.x + 0.96 * p.y};
  return Region::create(data).value();
}

/// The least power of two bytes that suffice; every smaller one is refused, and says so.
template <class T>
std::uint64_t least_limit(const std::function<Result<T>(std::uint64_t)>& made,
                          const std::function<bool(const T&)>& right) {
  for (std::uint64_t limit = 1024; limit <= std::uint64_t{1} << 32; limit *= 2) {
    const Result<T> result = made(limit);
    if (result) {
      EXPECT_TRUE(right(*result)) << limit;
      return limit;
    }
    EXPECT_EQ(result.error().code, ErrorCode::out_of_memory) << result.error().to_string();
    EXPECT_NE(result.error().message.find(" of memory, the limit is "), std::string::npos) << result.error().message;
  }
  ADD_FAILURE() << "no limit suffices";
  return 0;
}

TEST(SumMemory, SumsFitOrSayWhatTheyTake) {
  const Region p = shapes::comb(30, 2, 1, 40), q = lying(shapes::comb(24, 3, 1, 50));
  for (const Engine engine : {Engine::fast, Engine::winding}) {
    const auto with = [&](std::uint64_t limit) {
      SumOptions options;
      options.engine = engine, options.memory = limit;
      return options;
    };
    const PlanarSum free = minkowski_sum(p, q, with(0)).value();
    const std::uint64_t least =
        least_limit<PlanarSum>([&](std::uint64_t limit) { return minkowski_sum(p, q, with(limit)); },
                               [&](const PlanarSum& sum) { return sum == free; });
    EXPECT_GT(least, std::uint64_t{1} << 16) << "more than the operands";
    if (engine == Engine::fast) {
      EXPECT_LE(least, 4 * free.stats.peak_bytes + 4 * free.vertex_count() * sizeof(SumVertex));
      EXPECT_GE(2 * least, free.stats.peak_bytes / 2);
    }
    const Error error = minkowski_sum(p, q, with(1024)).error();
    EXPECT_NE(error.message.find("the sum of 120 and 96 vertices takes at least "), std::string::npos) << error.message;
    EXPECT_NE(error.message.find(" bytes; in the stage '"), std::string::npos) << error.message;
    EXPECT_EQ(nfp(p, q, with(1024)).error().code, ErrorCode::out_of_memory);
    EXPECT_EQ(erode(shapes::grate(20, 4, 1, 60), lying(shapes::comb(24, 0.125, 0.0625, 1)), with(1024)).error().code,
              ErrorCode::out_of_memory);
  }
}

template <class Moving, class Move>
void expect_frames(const Region& p, const Region& q, const Move& move) {
  MovingOptions options;
  Moving free = Moving::create(p, q, options).value();
  const auto all = [&](Moving& sum) -> Result<int> {
    int windows = 0;
    for (int k = 1; k <= 12; ++k) {
      const Result<FrameChanges> moved = move(sum, k);
      if (!moved) return moved.error();
      EXPECT_TRUE(move(free, k).ok());
      EXPECT_EQ(sum.sum(), free.sum()) << k;
      windows += sum.work().new_window;
    }
    return windows;
  };
  int least_windows = -1, most_windows = 0;
  const std::uint64_t least = least_limit<int>(
      [&](std::uint64_t limit) -> Result<int> {
        options.memory = limit;
        Result<Moving> made = Moving::create(p, q, options);
        if (!made) return made.error();
        Moving sum = std::move(made).value();
        return all(sum);
      },
      [&](const int& windows) {
        least_windows = windows;
        return true;
      });
  options.memory = 1024 * least;
  Moving large = Moving::create(p, q, options).value();
  most_windows = all(large).value();
  EXPECT_GT(most_windows, 0);
  EXPECT_LE(least_windows, most_windows) << "windows that do not fit are not made";
}

TEST(SumMemory, MovingSumsGoWithoutWindowsThatDoNotFit) {
  const Region p = shapes::star(40, 2, 5), q = shapes::gear(30, 2, 3);
  expect_frames<ScalingSum>(p, q, [](ScalingSum& sum, int k) { return sum.set(1 + 0.001 * k); });
  expect_frames<RotatingSum>(p, q,
                             [](RotatingSum& sum, int k) { return sum.set(Orientation::nearest(0.002 * k).value()); });
}

TEST(SumMemory, EventsOfScalesFitOrSayWhatTheyTake) {
  const Region p = shapes::star(20, 3, 5), q = tilted(shapes::star(18, 3, 5));
  const Scale from, to = Scale::of(1.03125).value();
  const auto events = [&](std::uint64_t limit) -> Result<std::vector<ScaleEvent>> {
    MovingOptions options;
    options.memory = limit;
    const Result<ScalingSum> sum = ScalingSum::create(p, q, options);
    if (!sum) return sum.error();
    return sum->events(from, to);
  };
  const std::vector<ScaleEvent> free = events(0).value();
  EXPECT_GT(free.size(), 3u);
  least_limit<std::vector<ScaleEvent>>(events, [&](const std::vector<ScaleEvent>& some) {
    return some.size() == free.size() && some.back().parameter == free.back().parameter;
  });
}

TEST(SumMemory, PartsOfSumsFitOrSayWhatTheyTake) {
  const Region p = shapes::comb(30, 3, 0.5, 30), q = tilted(shapes::comb(30, 3, 0.5, 30));
  const auto part = [&](std::uint64_t limit) -> Result<PlanarLocalPart> {
    PlanarLocalOptions options;
    options.memory = limit;
    Result<PlanarLocalSum> sum = PlanarLocalSum::create(p, q, options);
    if (!sum) return sum.error();
    PlanarLocalSum made = std::move(sum).value();
    return made.in(PlanarBox{{-40, -20}, {120, 80}});
  };
  const PlanarLocalPart free = part(0).value();
  EXPECT_GT(free.edges.size(), 50u);
  least_limit<PlanarLocalPart>(part, [&](const PlanarLocalPart& some) { return some == free; });
}

}  // namespace
}  // namespace dymsum
