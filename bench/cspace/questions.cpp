#include "cspace/questions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <vector>

#include "cspace/queries.h"
#include "dymsum/obstacle_queries.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

using Configurations = std::vector<Configuration>;

constexpr std::size_t kQueried = 100000, kChecked = 2000, kQuestions = 1000, kSamples = 10000;

/// Nanoseconds of processor time since cpu_ms() was `start`.
double since(double start) { return 1e6 * (cpu_ms() - start); }

/// Anywhere the robot could touch the obstacle.
Configurations configurations(const CspaceObstacle& obstacle, std::size_t count) {
  const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
  const auto [u0, v0, u1, v1] = bounds(obstacle.robot());
  const double reach = std::hypot(std::max(-u0, u1), std::max(-v0, v1));
  std::mt19937_64 random(43);
  std::uniform_real_distribution<double> x(x0 - reach, x1 + reach), y(y0 - reach, y1 + reach);
  std::uniform_real_distribution<double> theta(-std::numbers::pi, std::numbers::pi);
  Configurations all(count);
  for (Configuration& c : all) c = {x(random), y(random), theta(random)};
  return all;
}

/// contains: one after the other, in a batch, and against the slow exact test.
void contains_row(std::ostream& out, const QueryPair& pair) {
  const CspaceObstacle obstacle = CspaceObstacle::create(pair.robot, pair.obstacle).value();
  const ObstacleQueries queries(obstacle);
  const Configurations all = configurations(obstacle, kQueried);
  std::size_t inside = 0, wrong = 0;
  double start = cpu_ms();
  for (const Configuration& c : all) inside += queries.contains(c);
  const double single = since(start) / kQueried;
  start = cpu_ms();
  const std::vector<std::uint8_t> batch = queries.contains(all, 1);
  const double batched = since(start) / kQueried;
  start = cpu_ms();
  for (std::size_t k = 0; k < kChecked; ++k)
    wrong += obstacle.contains(all[k].x, all[k].y, Orientation::nearest(all[k].theta).value()) != (batch[k] != 0);
  const double slow = since(start) / kChecked;
  out << "| " << pair.name << " | " << std::lround(single) << " | " << std::lround(batched) << " | "
      << std::lround(slow) << " | " << 100 * inside / kQueried << " | " << kChecked << ", " << wrong << " |"
      << std::endl;
}

}  // namespace

void write_questions(const std::vector<TurningPair>& pairs, std::ostream& out) {
  std::vector<QueryPair> queried;
  for (const TurningPair& pair : pairs)
    for (const char* name : {"bar/circle", "bar/sewing", "star/star", "grate1/grate2"})
      if (pair.name == name) queried.push_back({pair.name, pair.robot, pair.obstacle});
  out << "| P/Q | contains ns, single | ns, in a batch | exact test ns | inside % | compared, different |\n"
         "|---|---|---|---|---|---|\n";
  for (const QueryPair& pair : queried) contains_row(out, pair);
  out << "\nClearance with its error, and the sampled penetration depth of the thesis. Wall time.\n\n";
  QueryTables tables(out, kQuestions, kSamples);
  tables.heading();
  for (const QueryPair& pair : queried) tables.row(pair);
  out << "\nTable 4.3 as the thesis prints it:\n\n"
         "| P/Q | mean error | query ms | precomputation s |\n|---|---|---|---|\n"
         "| bar/circle | 0.00004 | 7.8 | 50.1 |\n| bar/sewing | 0.00067 | 6.5 | 80.1 |\n"
         "| star/star | 0.0004 | 8.5 | 398.2 |\n| grate1/grate2 | 0.0001 | 12.0 | 862.2 |\n";
}

}  // namespace dymsum::bench
