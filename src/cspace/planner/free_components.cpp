#include "cspace/planner/free_components.h"

#include <algorithm>
#include <numbers>

#include "base/double_text.h"
#include "cspace/boundary/obstacle_state.h"

namespace dymsum::planar {

namespace {

std::string degrees_text(double radians, int digits) {
  return base::general_text(radians * 180 / std::numbers::pi, digits);
}

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
    const SearchStop stop = limits.query();
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
  std::string text =
      "component " + std::to_string(c.index) + (c.unbounded ? ", which reaches infinity" : ", which is enclosed");
  if (!c.all_angles)
    text += " and has angles from " + degrees_text(c.from, 6) + " to " + degrees_text(c.to, 6) + " degrees only";
  if (!c.shells.empty()) text += ", bounded by shell";
  for (const std::uint32_t s : c.shells) text += ' ' + std::to_string(s);
  return text;
}

std::string text_of(const SearchLimit& limit) {
  std::string text = limit.out_of_time
                         ? "the time limit of " + base::general_text(limit.seconds, 6) + " s was reached"
                         : "what joins them is passed along a curve alone, touching all the way, and not by "
                           "translations and rotations in place";
  const auto position = [](const Point& p) {
    return "(" + base::general_text(p.x, 10) + ", " + base::general_text(p.y, 10) + ")";
  };
  if (limit.passage)
    text += ", at the passage between " + degrees_text(limit.passage->from, 10) + " and " +
            degrees_text(limit.passage->to, 10) + " degrees from " + position(limit.passage->reached) + " to " +
            position(limit.passage->beyond);
  return text;
}

}  // namespace dymsum::planar
