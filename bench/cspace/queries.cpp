#include "cspace/queries.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <random>
#include <sstream>
#include <vector>

#include "cspace/sampled_depth.h"
#include "spread.h"

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

std::vector<Configuration> around(const CspaceObstacle& obstacle, std::size_t count, std::uint64_t seed) {
  const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
  const auto [u0, v0, u1, v1] = bounds(obstacle.robot());
  const double reach = std::hypot(std::max(-u0, u1), std::max(-v0, v1));
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Configuration> all;
  while (all.size() < count)
    all.push_back({uniform(x0 - reach, x1 + reach), uniform(y0 - reach, y1 + reach), uniform(-M_PI, M_PI)});
  return all;
}

// The time of every question, sorted.
template <class F>
Spread timed(const std::vector<Configuration>& questions, F&& query) {
  std::vector<double> times;
  for (const Configuration& q : questions) {
    const Clock::time_point start = Clock::now();
    query(q);
    times.push_back(microseconds_since(start));
  }
  return spread(times);
}

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + shown(v);
  return text;
}

using Cells = std::vector<std::string>;

void write_row(std::ostream& out, const Cells& cells) {
  for (const std::string& cell : cells) out << "| " << cell << " ";
  out << "|" << std::endl;
}

void measure_contains(const ObstacleQueries& queries, const std::vector<Configuration>& questions, Cells& row) {
  const Clock::time_point start = Clock::now();
  queries.contains(questions, 1);
  const double batch = microseconds_since(start) / static_cast<double>(questions.size());
  const Spread times = timed(questions, [&](const Configuration& c) { queries.contains(c); });
  row.push_back(joined({batch, times.median}));
  row.push_back(std::to_string(queries.exact_answers()) + " of " + std::to_string(2 * questions.size()));
}

std::vector<Clearance> measure_clearance(const ObstacleQueries& queries, const std::vector<Configuration>& questions,
                                         Cells& row) {
  std::vector<Clearance> found;
  const auto query = [&](const Configuration& c) { found.push_back(queries.clearance(c)); };
  const Spread times = timed(questions, query);
  row.push_back(joined({times.mean, times.median, times.worst}));
  row.push_back(shown(static_cast<double>(queries.bounds_evaluated()) / static_cast<double>(questions.size())));
  double worst = 0;
  for (const Clearance& c : found) worst = std::max(worst, c.error);
  row.push_back(shown(worst));
  return found;
}

// Wrong: farther than the nearest patch by more than the exact answer errs and a descent leaves open.
void measure_sampled(const SampledDepth& sampled, const std::vector<Configuration>& questions,
                     const std::vector<Clearance>& exact, Cells& row) {
  std::vector<SampledAnswer> found;
  const auto query = [&](const Configuration& c) { found.push_back(sampled.clearance(c)); };
  row.push_back(shown(timed(questions, query).mean));
  const double count = static_cast<double>(questions.size());
  double error = 0, wrong = 0;
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const double off = found[k].distance - std::abs(exact[k].distance);
    error += off / count;
    wrong += off > exact[k].error + 1e-6 ? 100 / count : 0;
  }
  row.push_back(joined({error, wrong}));
}

// How long the nearest patches of all samples take by descents in every patch, from some of them.
double brute_seconds(const SampledDepth& sampled, const Configuration& from, std::size_t patches, std::size_t samples) {
  const std::size_t tried = std::min<std::size_t>(patches, 200);
  const Clock::time_point start = Clock::now();
  for (std::size_t k = 0; k < tried; ++k) sampled.distance(static_cast<std::uint32_t>(k), from);
  return microseconds_since(start) / 1e6 / static_cast<double>(tried) * static_cast<double>(patches * samples);
}

}  // namespace

void QueryTables::heading() {
  const Cells cells{"pair",
                    "patches",
                    "index ms, MB",
                    "contains us (mean of a batch, median)",
                    "exact answers",
                    "clearance us (mean, median, worst)",
                    "bounds a question",
                    "largest error",
                    "translations us",
                    "free angles us",
                    "sampled us",
                    "its mean error, wrong patch %",
                    "its precomputation s, by brute force"};
  write_row(out_, cells);
  write_row(out_, Cells(cells.size(), "---"));
}

void QueryTables::row(const QueryPair& pair) {
  const Result<CspaceObstacle> made = CspaceObstacle::create(pair.robot, pair.obstacle);
  if (!made) return write_row(out_, {pair.name, made.error().to_string()});
  const CspaceObstacle& obstacle = *made;
  const std::size_t patches = obstacle.patches().size();
  Clock::time_point start = Clock::now();
  const ObstacleQueries queries(obstacle);
  const double index_ms = microseconds_since(start) / 1000, megabytes = static_cast<double>(queries.bytes()) / 1e6;
  Cells cells{pair.name, std::to_string(patches), joined({index_ms, megabytes})};
  const std::vector<Configuration> some = around(obstacle, questions_, 2);
  measure_contains(queries, around(obstacle, 100 * questions_, 1), cells);
  const std::vector<Clearance> exact = measure_clearance(queries, some, cells);
  cells.push_back(shown(timed(some, [&](const Configuration& c) { queries.clearance(c, INFINITY); }).mean));
  cells.push_back(shown(timed(some, [&](const Configuration& c) { queries.free_angles(c.x, c.y); }).mean));
  start = Clock::now();
  const SampledDepth sampled(obstacle, queries, queries.gyration_radius(), around(obstacle, samples_, 3));
  const double precomputed = microseconds_since(start) / 1e6;
  measure_sampled(sampled, some, exact, cells);
  cells.push_back(joined({precomputed, brute_seconds(sampled, some[0], patches, samples_)}));
  write_row(out_, cells);
}

}  // namespace dymsum::bench
