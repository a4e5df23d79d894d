#include "cspace/rotation.h"

#include <algorithm>
#include <numbers>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/rotating_sum.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

RotatingSum rotating(const TurningPair& pair) {
  MovingOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;
  return RotatingSum::create(pair.obstacle, pair.robot, options).value();
}

void count(const RotatingSum& sum, double ms, std::vector<double>& windows, RotationRow& row) {
  const FrameWork& work = sum.work();
  if (work.new_window) windows.push_back(ms);
  row.windows += work.new_window;
  row.rebuilt += work.rebuilt;
  row.degenerate += work.degenerate;
  row.pieces += static_cast<double>(work.pieces) / row.steps;
  row.pairs += static_cast<double>(work.candidates) / row.steps;
  row.collision_tests += static_cast<double>(work.collision_tests) / row.steps;
  row.vertices += static_cast<double>(sum.sum().vertex_count()) / row.steps;
}

}  // namespace

RotationRow measure_rotation(const TurningPair& pair, int steps) {
  RotationRow row;
  row.name = pair.name;
  row.steps = steps;
  std::vector<Orientation> orientations;
  for (int k = 1; k <= steps; ++k)
    orientations.push_back(Orientation::nearest(2 * std::numbers::pi * k / steps, 1e-6).value());
  std::vector<double> updates, slices, windows;
  // Small frames take little longer than reading the clock.
  const double clock = clock_ms();
  RotatingSum sum = rotating(pair);
  for (const Orientation& theta : orientations) {
    const double start = cpu_ms();
    sum.set(theta).value();
    updates.push_back(std::max(cpu_ms() - start - clock, 0.0));
    count(sum, updates.back(), windows, row);
  }
  // Compared in a second turn, so that neither is timed with the other's data in the caches.
  RotatingSum again = rotating(pair);
  for (const Orientation& theta : orientations) {
    const double start = cpu_ms();
    const PlanarSum slice = cspace_slice(pair.robot, pair.obstacle, theta).value();
    slices.push_back(std::max(cpu_ms() - start - clock, 0.0));
  }
  for (const Orientation& theta : orientations) {
    again.set(theta).value();
    ++row.compared;
    row.different += !(again.sum() == cspace_slice(pair.robot, pair.obstacle, theta).value());
  }
  row.update_ms = spread(updates);
  row.static_ms = spread(slices);
  row.window_ms = spread(windows).median;
  return row;
}

}  // namespace dymsum::bench
