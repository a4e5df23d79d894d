#include "cspace/planner/free_components.h"

#include <algorithm>
#include <numbers>
#include <sstream>

#include "cspace/boundary/obstacle_state.h"

namespace dymsum::planar {

namespace {

std::uint32_t component_count(const CspaceObstacle& obstacle) {
  std::uint32_t count = 0;
  for (const FreeCell& cell : obstacle.free_cells()) count = std::max(count, cell.component + 1);
  return count;
}

}  // namespace

JoinedComponents::JoinedComponents(const CspaceObstacle& obstacle) : classes_(component_count(obstacle)) {}

SearchStop JoinedComponents::join_touching(const CspaceObstacle& obstacle, PathLevels& levels,
                                           const SearchLimits& limits) {
  constexpr int kAtATime = 64;  // slices after the last look at the clock: few are made in any case
  int looked = 0;
  const std::vector<FreeCell>& cells = obstacle.free_cells();
  for (const auto& [a, b] : ObstacleInternals::of(obstacle).touching_cells)
    classes_.join(cells[a].component, cells[b].component);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels.slab(k)) continue;
    const SearchStop stop = limits.ask();
    if (stop == SearchStop::cancelled || (stop == SearchStop::out_of_time && ++looked % kAtATime == 0)) return stop;
    levels.let_go();
    const SliceGraph& graph = levels.graph(k);
    if (graph.groups() >= graph.faces() + levels.map(k).cracks().size()) continue;
    for (std::uint32_t g = 0; g < graph.groups(); ++g) {
      const std::vector<std::uint32_t> together = levels.components(k, g);
      for (const std::uint32_t c : together)
        if (c != SliceMap::kNone && together[0] != SliceMap::kNone) classes_.join(together[0], c);
    }
  }
  return SearchStop::none;
}

FreeComponent described(const CspaceObstacle& obstacle, std::uint32_t component) {
  FreeComponent c;
  c.index = component;
  const std::size_t slabs = obstacle.angles().size();
  std::vector<bool> covered(slabs, false);
  for (const FreeCell& cell : obstacle.free_cells()) {
    if (cell.component != component) continue;
    c.unbounded = c.unbounded || cell.unbounded;
    if (cell.begin == Patch::kNone || cell.begin == cell.end) {
      c.all_angles = true;
      continue;
    }
    for (std::size_t k = cell.begin; k != cell.end; k = (k + 1) % slabs) covered[k] = true;
  }
  c.all_angles = c.all_angles || std::find(covered.begin(), covered.end(), false) == covered.end();
  for (std::size_t k = 0; k < slabs && !c.all_angles; ++k) {
    if (covered[k] && !covered[(k + slabs - 1) % slabs]) c.from = obstacle.angles()[k].theta;
    if (!covered[k] && covered[(k + slabs - 1) % slabs]) c.to = obstacle.angles()[k].theta;
  }
  for (std::uint32_t k = 0; k < obstacle.shells().size(); ++k)
    if (obstacle.shells()[k].free_component == component) c.shells.push_back(k);
  return c;
}

std::string text_of(const FreeComponent& c) {
  std::ostringstream text;
  const auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
  text.precision(6);
  text << "component " << c.index << (c.unbounded ? ", which reaches infinity" : ", which is enclosed");
  if (!c.all_angles) text << " and has angles from " << degrees(c.from) << " to " << degrees(c.to) << " degrees only";
  if (!c.shells.empty()) text << ", bounded by shell";
  for (const std::uint32_t s : c.shells) text << ' ' << s;
  return text.str();
}

std::string text_of(const SearchLimit& limit) {
  std::ostringstream text;
  const auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
  if (limit.out_of_time) text << "the time limit of " << limit.seconds << " s was reached";
  else
    text << "what joins them is passed along a curve alone, touching all the way, and not by translations and "
            "rotations in place";
  text.precision(10);
  if (limit.passage)
    text << ", at the passage between " << degrees(limit.passage->from) << " and " << degrees(limit.passage->to)
         << " degrees from (" << limit.passage->reached.x << ", " << limit.passage->reached.y << ") to ("
         << limit.passage->beyond.x << ", " << limit.passage->beyond.y << ")";
  return text.str();
}

}  // namespace dymsum::planar
