#include "families/measure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dymsum/rotating_sum.h"
#include "dymsum/rotation_family.h"
#include "dymsum/scaling_family.h"
#include "dymsum/scaling_sum.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

constexpr int kRounds = 3;

FamilyOptions family_options(const ScalingPair& pair) {
  FamilyOptions options;
  options.moving = pair.q_scales ? MovingOperand::q : MovingOperand::p;
  return options;
}

/// Sums from scratch at exact scales, of operands that have been summed before.
ScalingSum sums_from_scratch(const ScalingPair& pair) {
  MovingOptions options;
  options.moving = pair.q_scales ? MovingOperand::q : MovingOperand::p;
  options.mode = FrameMode::rebuild;
  return ScalingSum::create(pair.p, pair.q, options).value();
}

/// The median of queries, of many in a row: one takes no longer than reading the clock.
template <class Family, class Parameter>
double query_ms(const Family& family, const Parameter& at, double clock) {
  constexpr int kInARow = 32;
  std::vector<double> ms;
  std::size_t parts = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double start = cpu_ms();
    for (int k = 0; k < kInARow; ++k) parts += family.at(at).value().parts.size();
    ms.push_back(std::max(cpu_ms() - start - clock, 0.0) / kInARow);
  }
  if (parts == 0) throw std::runtime_error("a query failed");
  return spread(ms).median;
}

/// The median of sums from scratch at a parameter; one that stays would be no frame.
template <class Sum, class Parameter>
double scratch_ms(Sum& scratch, const Parameter& at, const Parameter& other, double clock) {
  std::vector<double> ms;
  for (int round = 0; round < kRounds; ++round) {
    if (!scratch.set(other)) throw std::runtime_error("a frame failed");
    const double start = cpu_ms();
    if (!scratch.set(at)) throw std::runtime_error("a frame failed");
    ms.push_back(std::max(cpu_ms() - start - clock, 0.0));
  }
  return spread(ms).median;
}

/// Queries of a family against sums from scratch.
template <class Family, class Sum, class Parameter>
void compare_queries(const Family& family, Sum& scratch, const std::vector<Parameter>& queries, const Parameter& first,
                     FamilyRow& row) {
  row.events = family.work().events;
  row.visible = family.work().visible;
  row.names = family.work().names;
  row.bytes = family.work().bytes;
  const double clock = clock_ms();
  std::vector<double> at, statics;
  row.least = INFINITY;
  Parameter other = first;
  for (const Parameter& query : queries) {
    if (query == other) continue;
    at.push_back(query_ms(family, query, clock));
    statics.push_back(scratch_ms(scratch, query, other, clock));
    other = query;
    row.least = std::min(row.least, statics.back() / std::max(at.back(), 1e-6));
    const PlanarSum sum = family.at(query).value();
    row.vertices = std::max<std::uint64_t>(row.vertices, sum.vertex_count());
    ++row.compared;
    row.different += !(sum == scratch.sum());
  }
  row.at_ms = spread(at);
  row.static_ms = spread(statics);
}

double all_pairs_ms(const ScalingPair& pair, const FamilyPlan& plan) {
  std::vector<double> ms;
  for (std::size_t k = 0; k < plan.all_pairs; ++k) {
    const double s = plan.scales[k * plan.scales.size() / plan.all_pairs].approx();
    const Region p = pair.q_scales ? pair.p : scaled(pair.p, s, s).value(),
                 q = pair.q_scales ? scaled(pair.q, s, s).value() : pair.q;
    SumOptions brute;
    brute.engine = Engine::brute;
    const double start = cpu_ms();
    if (!minkowski_sum(p, q, brute)) throw std::runtime_error("a sum failed");
    ms.push_back(cpu_ms() - start);
  }
  return spread(ms).mean;
}

}  // namespace

std::vector<Scale> scales_in(double low, double high, std::size_t count) {
  std::vector<Scale> scales;
  std::uint64_t state = 20261130;
  for (std::size_t k = 0; k < count; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double s = low + (high - low) * static_cast<double>(state >> 33) * 0x1p-31;
    scales.push_back(Scale::of(std::clamp(std::round(s * 0x1p12) * 0x1p-12, low, high)).value());
  }
  return scales;
}

std::vector<Scale> tenths(std::size_t count) {
  std::vector<Scale> scales;
  std::uint64_t state = 20130607;
  for (std::size_t k = 0; k < count; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const auto tenth = static_cast<double>(1 + (state >> 33) % 100);
    scales.push_back(Scale::of(std::round(tenth / 10 * 0x1p12) * 0x1p-12).value());
  }
  return scales;
}

FamilyRow measure_family(const ScalingPair& pair, const FamilyPlan& plan) {
  FamilyRow row;
  row.name = pair.name;
  row.interval = plan.low.exact().to_string() + " to " + plan.high.exact().to_string();
  const double start = cpu_ms();
  const ScalingFamily family = ScalingFamily::create(pair.p, pair.q, plan.low, plan.high, family_options(pair)).value();
  row.making_ms = cpu_ms() - start;
  ScalingSum scratch = sums_from_scratch(pair);
  compare_queries(family, scratch, plan.scales, Scale(), row);
  row.scratch_ms = all_pairs_ms(pair, plan);
  return row;
}

FamilyRow measure_turn(const ScalingPair& pair, std::size_t count) {
  FamilyRow row;
  row.name = pair.name;
  row.interval = "a whole turn";
  const double start = cpu_ms();
  const RotationFamily family = RotationFamily::create(pair.p, pair.q).value();
  row.making_ms = cpu_ms() - start;
  MovingOptions options;
  options.mode = FrameMode::rebuild;
  RotatingSum scratch = RotatingSum::create(pair.p, pair.q, options).value();
  std::vector<Orientation> thetas;
  for (const Scale& s : scales_in(0.001, 6.25, count))
    thetas.push_back(Orientation::nearest(s.approx(), 0x1p-20).value());
  compare_queries(family, scratch, thetas, Orientation(), row);
  return row;
}

}  // namespace dymsum::bench
