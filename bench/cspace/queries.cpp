#include "cspace/queries.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <random>
#include <sstream>

#include "cspace/sampled_depth.h"
#include "dymsum/shapes.h"

namespace dymsum::bench {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

std::string shown(double v, int digits = 3) {
  std::ostringstream text;
  text << std::setprecision(digits) << v;
  return text.str();
}

Region named(std::string_view name) {
  for (const shapes::Named& s : shapes::thesis_like_set())
    if (s.name == name) return s.region;
  return {};
}

std::vector<Configuration> around(const CspaceObstacle& obstacle, std::size_t count, std::uint64_t seed) {
  const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
  const auto [u0, v0, u1, v1] = bounds(obstacle.robot());
  const double reach = std::hypot(std::max(-u0, u1), std::max(-v0, v1));
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  std::vector<Configuration> all;
  while (all.size() < count)
    all.push_back({uniform(x0 - reach, x1 + reach), uniform(y0 - reach, y1 + reach), uniform(-M_PI, M_PI)});
  return all;
}

// The time of every question, sorted.
template <class F>
std::vector<double> timed(const std::vector<Configuration>& questions, F&& ask) {
  std::vector<double> times;
  for (const Configuration& q : questions) {
    const Clock::time_point start = Clock::now();
    ask(q);
    times.push_back(microseconds_since(start));
  }
  std::sort(times.begin(), times.end());
  return times;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double t : v) sum += t;
  return sum / static_cast<double>(v.size());
}

}  // namespace

std::vector<QueryPair> depth_pairs() {
  const Region bar = named("bar");
  return {{"bar/circle", bar, shapes::disc(32, bounds(bar)[2])},
          {"bar/sewing", bar, named("sewing")},
          {"star/star", named("star"), named("star")},
          {"grate 1/grate 2", named("G1"), named("G2")}};
}

void QueryTables::heading() {
  out_ << "| pair | patches | index ms, MB | contains us (mean of a batch, median) | exact | clearance us (mean, median, worst) | bounds a "
          "question | largest error | translations us | free angles us | sampled us | its mean error, wrong patch % | its "
          "precomputation s, by brute force |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

void QueryTables::row(const QueryPair& pair) {
  const Result<CspaceObstacle> made = CspaceObstacle::create(pair.robot, pair.obstacle);
  if (!made) {
    out_ << "| " << pair.name << " | " << made.error().to_string() << " |\n";
    return;
  }
  const CspaceObstacle& obstacle = *made;
  Clock::time_point start = Clock::now();
  const ObstacleQueries queries(obstacle);
  const double index_ms = microseconds_since(start) / 1000;
  const std::vector<Configuration> many = around(obstacle, 100 * questions_, 1), some = around(obstacle, questions_, 2);
  start = Clock::now();
  queries.contains(many, 1);
  const double batch = microseconds_since(start) / static_cast<double>(many.size());
  const std::vector<double> contains = timed(many, [&](const Configuration& c) { queries.contains(c); });
  const std::uint64_t exact = queries.exact_answers();
  std::vector<Clearance> found;
  const std::uint64_t before = queries.bounds_evaluated();
  const std::vector<double> clear = timed(some, [&](const Configuration& c) { found.push_back(queries.clearance(c)); });
  const double bounds_each = static_cast<double>(queries.bounds_evaluated() - before) / static_cast<double>(some.size());
  double worst = 0;
  for (const Clearance& c : found) worst = std::max(worst, c.error);
  const std::vector<double> moves = timed(some, [&](const Configuration& c) { queries.clearance(c, INFINITY); });
  const std::vector<double> angles = timed(some, [&](const Configuration& c) { queries.free_angles(c.x, c.y); });

  start = Clock::now();
  const SampledDepth sampled(obstacle, queries, queries.gyration_radius(), around(obstacle, samples_, 3));
  const double samples_s = microseconds_since(start) / 1e6;
  std::vector<SampledAnswer> estimates;
  const std::vector<double> estimate = timed(some, [&](const Configuration& c) { estimates.push_back(sampled.clearance(c)); });
  double error = 0, wrong = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const double off = estimates[k].distance - std::abs(found[k].distance);
    error += off / static_cast<double>(some.size());
    wrong += off > found[k].error + 1e-6 ? 100.0 / static_cast<double>(some.size()) : 0;
  }
  start = Clock::now();
  const std::size_t tried = std::min<std::size_t>(obstacle.patches().size(), 200);
  for (std::size_t k = 0; k < tried; ++k) sampled.distance(static_cast<std::uint32_t>(k), some[0]);
  const double brute_s = microseconds_since(start) / 1e6 / static_cast<double>(tried) *
                         static_cast<double>(obstacle.patches().size() * samples_);
  out_ << "| " << pair.name << " | " << obstacle.patches().size() << " | " << shown(index_ms) << ", "
       << shown(static_cast<double>(queries.bytes()) / 1e6) << " | " << shown(batch) << ", " << shown(contains[contains.size() / 2])
       << " | " << exact << " of " << 2 * many.size() << " | " << shown(mean(clear)) << ", " << shown(clear[clear.size() / 2]) << ", "
       << shown(clear.back()) << " | " << shown(bounds_each) << " | " << shown(worst) << " | " << shown(mean(moves)) << " | "
       << shown(mean(angles)) << " | " << shown(mean(estimate)) << " | " << shown(error) << ", " << shown(wrong) << " | "
       << shown(samples_s) << ", " << shown(brute_s) << " |" << std::endl;
}

}  // namespace dymsum::bench
