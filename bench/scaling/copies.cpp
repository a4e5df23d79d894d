#include "scaling/copies.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "versus/rival.h"

namespace dymsum::bench {
namespace {

constexpr int kCopies = 12;

double on_grid(double s) { return std::round(s * 0x1p14) * 0x1p-14; }

/// Every copy from scratch; the obstacles' regions are made outside the clock.
std::vector<PlanarSum> from_scratch(const std::vector<Region>& obstacles, const Region& q, Engine engine) {
  SumOptions options;
  options.engine = engine;
  std::vector<PlanarSum> sums;
  for (const Region& p : obstacles) sums.push_back(minkowski_sum(p, q, options).value());
  return sums;
}

void compare(CopiesRow& row, const std::vector<CopySum>& ours, const std::vector<PlanarSum>& theirs) {
  for (std::size_t i = 0; i < ours.size(); ++i) {
    ++row.compared;
    row.different += !(ours[i].sum == theirs[i]);
  }
}

}  // namespace

std::vector<CopiesPlan> twelve_copies() {
  // Not in order, as an environment lists them.
  CopiesPlan spread{"1/2 to 2", {}}, close{"within 12 %", {}}, four{"four sizes", {}};
  for (int k = 0; k < kCopies; ++k) {
    const int at = 5 * k % kCopies;
    spread.scales.push_back(on_grid(0.5 * std::pow(4.0, at / double(kCopies - 1))));
    close.scales.push_back(on_grid(1 + 0.01 * at));
    four.scales.push_back(on_grid(0.5 + 0.5 * (at % 4)));
  }
  return {spread, close, four};
}

CopiesRow measure_copies(const ScalingPair& pair, const CopiesPlan& plan, int rounds, bool baseline) {
  CopiesRow row;
  row.name = pair.name;
  row.sizes = plan.sizes;
  row.copies = plan.scales.size();
  row.distinct = std::set<double>(plan.scales.begin(), plan.scales.end()).size();
  row.segments = convolution_sizes(pair.p, negated(pair.q)).reduced;
  std::vector<ScaledCopy> copies;
  for (const double s : plan.scales) copies.push_back({Scale::of(s).value(), {}});
  MovingOptions options;
  options.reflect_q = true;
  Times ours, fresh, all_pairs;
  std::vector<CopySum> sums;
  for (int round = 0; round < rounds; ++round) {
    // Regions of their own each time: what sums keep of a region is charged to both.
    const Region master = Region::create(pair.p.data()).value(), robot = Region::create(pair.q.data()).value(),
                 q = negated(robot);
    std::vector<Region> obstacles;
    for (const double s : plan.scales) obstacles.push_back(scaled(master, s, s).value());
    double start = cpu_ms();
    sums = scaled_copies(master, robot, copies, options).value();
    ours.ms.push_back(cpu_ms() - start);
    start = cpu_ms();
    const std::vector<PlanarSum> answers = from_scratch(obstacles, q, Engine::fast);
    fresh.ms.push_back(cpu_ms() - start);
    compare(row, sums, answers);
    if (!baseline || round > 0) continue;
    start = cpu_ms();
    const std::vector<PlanarSum> slow = from_scratch(obstacles, q, Engine::brute);
    all_pairs.ms.push_back(cpu_ms() - start);
    compare(row, sums, slow);
  }
  for (const CopySum& copy : sums) {
    row.windows += copy.work.new_window;
    row.rebuilt += copy.work.rebuilt;
    row.vertices += copy.sum.vertex_count();
  }
  row.copies_ms = ours.median();
  row.static_ms = fresh.median();
  row.all_pairs_ms = all_pairs.median();
  return row;
}

}  // namespace dymsum::bench
