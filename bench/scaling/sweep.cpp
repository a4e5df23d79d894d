#include "scaling/sweep.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>

#include "dymsum/orientation_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Windows made ahead by a second thread, where sums can: false elsewhere.
template <class Options>
bool use_threads(Options& options, int threads) {
  if constexpr (requires { options.threads = threads; }) options.threads = threads;
  return threads == 1 || requires { options.threads; };
}

/// What the two motions do differently.
struct Scaling {
  using Sum = ScalingSum;
  using Position = ScaleXY;
  static constexpr bool kRounds = true;  // regions at a position have rounded points

  explicit Scaling(const ScalingPair& pair) : pair_(pair) {
    MovingOptions options;
    options.mode = FrameMode::rebuild;
    static_.emplace(ScalingSum::create(pair.p, pair.q, options).value());
  }

  static void move(Sum& sum, const Position& at) { sum.set(at.x, at.y).value(); }
  const PlanarSum& from_scratch(const Position& at) {
    move(*static_, at);
    return static_->sum();
  }
  /// Of points rounded to doubles; nothing where rounding spoils the region.
  std::optional<std::pair<Region, Region>> regions(const Position& at) const {
    Result<Region> p = scaled(pair_.p, at.x.approx(), at.y.approx());
    if (!p) return std::nullopt;
    return std::pair{*std::move(p), Region::create(pair_.q.data()).value()};
  }
  PlanarSum sum_of(const std::pair<Region, Region>& made, const Position&) const {
    return minkowski_sum(made.first, made.second).value();
  }

 private:
  const ScalingPair& pair_;
  std::optional<ScalingSum> static_;
};

struct Turning {
  using Sum = RotatingSum;
  using Position = Orientation;
  static constexpr bool kRounds = false;

  explicit Turning(const ScalingPair& pair) : pair_(pair) {}

  static void move(Sum& sum, const Position& theta) { sum.set(theta).value(); }
  PlanarSum from_scratch(const Orientation& theta) const { return rotated_sum(pair_.p, pair_.q, theta).value(); }
  std::optional<std::pair<Region, Region>> regions(const Orientation&) const {
    return std::pair{Region::create(pair_.p.data()).value(), Region::create(pair_.q.data()).value()};
  }
  PlanarSum sum_of(const std::pair<Region, Region>& made, const Orientation& theta) const {
    return rotated_sum(made.first, made.second, theta).value();
  }

 private:
  const ScalingPair& pair_;
};

struct Round {
  std::vector<double> there, back;
  std::uint64_t windows = 0, rebuilt = 0, degenerate = 0;
};

/// Through all positions and back to the first one. The first frame holds the making of the sum.
template <class Motion>
std::optional<Round> run_round(const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
                               int threads) {
  MovingOptions options;
  if (!use_threads(options, threads)) return std::nullopt;
  const auto now = threads > 1 ? wall_ms : cpu_ms;
  const double clock = clock_ms();
  Round round;
  double start = now();
  auto sum = Motion::Sum::create(pair.p, pair.q, options).value();
  const auto frame = [&](const typename Motion::Position& position, std::vector<double>& ms) {
    Motion::move(sum, position);
    ms.push_back(std::max(now() - start - clock, 0.0));
    round.windows += sum.work().new_window;
    round.rebuilt += sum.work().rebuilt;
    round.degenerate += sum.work().degenerate;
    start = now();
  };
  for (const auto& position : positions) frame(position, round.there);
  for (std::size_t i = positions.size() - 1; i-- > 0;) frame(positions[i], round.back);
  return round;
}

template <class Motion>
void time_one_thread(SweepRow& row, const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
                     const SweepPlan& plan) {
  std::vector<Round> rounds;
  const double start = wall_ms();
  while (static_cast<int>(rounds.size()) < plan.rounds && (rounds.empty() || wall_ms() - start < plan.round_ms))
    rounds.push_back(*run_round<Motion>(pair, positions, 1));
  const auto medians = [&](std::vector<double> Round::*pass) {
    std::vector<double> ms;
    for (std::size_t i = 0; i < (rounds.front().*pass).size(); ++i) {
      std::vector<double> of_frame;
      for (const Round& round : rounds) of_frame.push_back((round.*pass)[i]);
      ms.push_back(quantile(of_frame, 0.5));
    }
    return ms;
  };
  row.there = medians(&Round::there);
  row.back = medians(&Round::back);
  row.windows = rounds.front().windows;
  row.rebuilt = rounds.front().rebuilt;
  row.degenerate = rounds.front().degenerate;
}

template <class Motion>
void time_two_threads(SweepRow& row, const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
                      const SweepPlan& plan) {
  const double start = wall_ms();
  for (int k = 0; k < plan.rounds && (k == 0 || wall_ms() - start < plan.round_ms); ++k) {
    const std::optional<Round> round = run_round<Motion>(pair, positions, 2);
    if (!round) return;
    row.two_there.insert(row.two_there.end(), round->there.begin(), round->there.end());
    row.two_back.insert(row.two_back.end(), round->back.begin(), round->back.end());
  }
}

/// Every so-manieth index, never the first: sums are there when they are made.
std::vector<std::size_t> some_of(std::size_t positions, std::size_t count) {
  std::vector<std::size_t> chosen;
  const std::size_t every = std::max<std::size_t>(1, positions / count);
  for (std::size_t i = std::max<std::size_t>(1, every / 2); i < positions; i += every) chosen.push_back(i);
  return chosen;
}

template <class Motion>
void time_statics(SweepRow& row, const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
                  const SweepPlan& plan) {
  Motion motion(pair);
  const double clock = clock_ms();
  const auto timed = [&](auto&& work) {
    const double start = cpu_ms();
    work();
    return std::max(cpu_ms() - start - clock, 0.0);
  };
  std::vector<double> fresh, rounded;
  motion.from_scratch(positions.back());  // prepares the operands, and is not where the sweep begins
  for (const auto& position : positions) row.statics.push_back(timed([&] { motion.from_scratch(position); }));
  for (const std::size_t i : some_of(positions.size(), plan.some / 3)) {
    std::optional<std::pair<Region, Region>> made;
    const double ms = timed([&] {
      made = motion.regions(positions[i]);
      if (made) motion.sum_of(*made, positions[i]);
    });
    if (!made) continue;
    fresh.push_back(ms);
    if (Motion::kRounds) rounded.push_back(timed([&] { motion.sum_of(*made, positions[i]); }));
  }
  row.fresh = spread(fresh);
  row.rounded = spread(rounded);
}

/// A round of its own.
template <class Motion>
void compare(SweepRow& row, const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
             const SweepPlan& plan, int threads) {
  MovingOptions options;
  if (!use_threads(options, threads)) return;
  auto sum = Motion::Sum::create(pair.p, pair.q, options).value();
  Motion motion(pair);
  const std::vector<std::size_t> chosen = some_of(positions.size(), plan.some);
  const auto check = [&](std::size_t i) {
    Motion::move(sum, positions[i]);
    if (!std::binary_search(chosen.begin(), chosen.end(), i)) return;
    const PlanarSum& answer = motion.from_scratch(positions[i]);
    ++row.compared;
    row.different += !(answer == sum.sum());
    row.vertices = std::max<std::uint64_t>(row.vertices, answer.vertex_count());
  };
  for (std::size_t i = 0; i < positions.size(); ++i) check(i);
  for (std::size_t i = positions.size() - 1; i-- > 0;) check(i);
}

template <class Motion>
SweepRow measure(const ScalingPair& pair, const std::vector<typename Motion::Position>& positions,
                 const SweepPlan& plan) {
  SweepRow row;
  row.name = pair.name;
  row.coordinates = plan.coordinates;
  row.steps = plan.steps;
  time_statics<Motion>(row, pair, positions, plan);
  time_one_thread<Motion>(row, pair, positions, plan);
  time_two_threads<Motion>(row, pair, positions, plan);
  for (const int threads : {1, 2}) compare<Motion>(row, pair, positions, plan, threads);
  return row;
}

}  // namespace

SweepRow measure_sweep(const ScalingPair& pair, const std::vector<ScaleXY>& scales, const SweepPlan& plan) {
  return measure<Scaling>(pair, scales, plan);
}
SweepRow measure_sweep(const ScalingPair& pair, const std::vector<Orientation>& thetas, const SweepPlan& plan) {
  return measure<Turning>(pair, thetas, plan);
}

}  // namespace dymsum::bench
