#include "cspace/measure.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace dymsum::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Cycle = std::vector<Contact>;

constexpr std::size_t kSlabs = 50;
constexpr std::uint64_t kSeed = 2016;

bool before(const Contact& a, const Contact& b) { return std::tuple{a.kind, a.p, a.q} < std::tuple{b.kind, b.p, b.q}; }
bool smaller(const Cycle& a, const Cycle& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
}

/// Every cycle as the smallest of its rotations, sorted. A contact may be on a cycle twice.
std::vector<Cycle> canonical(std::vector<Cycle> cycles) {
  for (Cycle& cycle : cycles) {
    const auto first = std::min_element(cycle.begin(), cycle.end(), before);
    if (first == cycle.end()) continue;
    const Contact least = *first;
    Cycle best, turned = cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k, std::rotate(turned.begin(), turned.begin() + 1, turned.end()))
      if (turned.front() == least && (best.empty() || smaller(turned, best))) best = turned;
    cycle = std::move(best);
  }
  std::sort(cycles.begin(), cycles.end(), smaller);
  return cycles;
}

std::vector<Cycle> rings_of(const PlanarSum& sum) {
  std::vector<Cycle> cycles;
  const auto add = [&](const SumRing& ring) {
    Cycle& cycle = cycles.emplace_back();
    for (const SumVertex& v : ring.vertices) cycle.push_back(v.out);
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return canonical(std::move(cycles));
}

std::vector<Cycle> loops_of(const CspaceObstacle& obstacle, std::uint32_t slab) {
  std::vector<Cycle> cycles;
  for (const std::vector<std::uint32_t>& loop : obstacle.loops(slab)) {
    Cycle& cycle = cycles.emplace_back();
    for (const std::uint32_t patch : loop) cycle.push_back(obstacle.patches()[patch].contact);
  }
  return canonical(std::move(cycles));
}

}  // namespace

void compare_slabs(const CspaceObstacle& obstacle, std::size_t count, std::uint64_t seed, ObstacleRow& row) {
  std::vector<std::uint32_t> all(std::max<std::size_t>(1, obstacle.angles().size())), some;
  std::iota(all.begin(), all.end(), 0u);
  std::mt19937_64 random(seed);
  std::sample(all.begin(), all.end(), std::back_inserter(some), count, random);
  for (const std::uint32_t slab : some) {
    const PlanarSum slice = cspace_slice(obstacle.robot(), obstacle.obstacle(), obstacle.inside(slab)).value();
    row.slabs_different += loops_of(obstacle, slab) != rings_of(slice);
  }
  row.slabs_compared += some.size();
}

ObstacleRow measure_obstacle(const TurningPair& pair, int most, double budget_ms) {
  ObstacleRow row;
  row.name = pair.name;
  row.shapes = pair.shapes;
  row.thesis = pair.thesis;
  double used = 0;
  do {
    const Clock::time_point begin = Clock::now();
    const double start = cpu_ms();
    const CspaceObstacle obstacle = CspaceObstacle::create(pair.robot, pair.obstacle).value();
    row.cpu.ms.push_back(cpu_ms() - start);
    row.wall.ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    used += row.cpu.ms.back();
    if (row.cpu.ms.size() > 1) continue;
    row.work = obstacle.work();
    row.angles = obstacle.angles().size();
    row.patches = obstacle.patches().size();
    row.shells = obstacle.shells().size();
    row.cells = obstacle.free_cells().size();
    compare_slabs(obstacle, kSlabs, kSeed, row);
  } while (static_cast<int>(row.cpu.ms.size()) < most && used < budget_ms);
  return row;
}

}  // namespace dymsum::bench
