#include "planar/rotation/path_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::planar {
namespace {

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

}  // namespace

PathSearch::PathSearch(const CspaceObstacle& obstacle, PathLevels& levels, Touching touching,
                       std::function<bool(std::uint32_t, std::uint32_t)> joined)
    : obstacle_(obstacle),
      levels_(levels),
      touching_(touching),
      joined_(std::move(joined)),
      pivot_(obstacle.robot(), obstacle.obstacle()) {
  const Pose pose(obstacle.robot(), obstacle.obstacle());
  room_ = pose.reach() * pose.reach();
}

std::vector<PathSearch::Visit>& PathSearch::visits(std::uint32_t level) {
  std::vector<Visit>& v = visits_[level];
  if (v.empty()) v.resize(levels_.graph(level).groups());
  return v;
}

PathSearch::Outcome PathSearch::round(const PathEnd& start, const PathEnd& goal, std::size_t places,
    const Progress& progress) {
  levels_.add(start.theta);
  const auto last = static_cast<std::uint32_t>(levels_.add(goal.theta));
  const auto begin = static_cast<std::uint32_t>(levels_.add(start.theta));  // the goal's may have moved it
  visits_.assign(levels_.size(), {});
  open_.clear();
  steps_.clear();
  goal_angle_ = goal.theta.radians();
  const std::uint32_t group = levels_.graph(begin).group_at(SlicePoint(start.at));
  const std::uint32_t wanted = levels_.graph(last).group_at(SlicePoint(goal.at));
  visits(begin)[group] = {true, begin, group, start.at, {}, 0};
  open_.push_back({0, begin, group});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end());
    const Open here = open_.back();
    open_.pop_back();
    if (here.level == last && here.group == wanted) {
      collect(last, wanted);
      return Outcome::found;
    }
    if (progress && !progress("search", 0)) return Outcome::cancelled;
    expand(here.level, here.group, TurnDirection::counter_clockwise, places);
    expand(here.level, here.group, TurnDirection::clockwise, places);
  }
  return Outcome::nothing;
}

// Trapezoids of a group: those with room for the robot first, the near ones before the far ones.
std::vector<Position> PathSearch::roomy(std::uint32_t level, std::uint32_t group, const Position& near,
    std::size_t most) {
  const SliceGraph& graph = levels_.graph(level);
  const Point at = SlicePoint(near).at();
  std::vector<std::tuple<double, double, std::uint32_t>> order;
  for (std::uint32_t k = 0; k < graph.trapezoids().size(); ++k) {
    if (graph.group_of(k) != group) continue;
    const Point c = graph.trapezoids()[k].near;
    order.emplace_back(-std::min(room_, graph.trapezoids()[k].size), std::hypot(c.x - at.x, c.y - at.y), k);
  }
  std::sort(order.begin(), order.end());
  if (order.size() > most) order.resize(most);
  std::vector<Position> places;
  for (const auto& [size, distance, k] : order) places.push_back(graph.trapezoids()[k].centre);
  return places;
}

bool PathSearch::try_place(std::uint32_t from, std::uint32_t group, std::uint32_t to, TurnDirection direction,
    const Position& at) {
  const std::uint32_t reached = levels_.graph(to).group_at(SlicePoint(at));
  if (reached == SliceMap::kNone || visits(to)[reached].reached) return false;
  ++rotations_;
  pivot_.stand(at);
  if (pivot_.stop(levels_.theta(from), levels_.theta(to), direction, touching_)) return false;
  const double cost = visits(from)[group].cost + turn_between(levels_.theta(from).radians(),
      levels_.theta(to).radians());
  visits(to)[reached] = {true, from, group, at, direction, cost};
  open_.push_back({cost + turn_between(levels_.theta(to).radians(), goal_angle_), to, reached});
  std::push_heap(open_.begin(), open_.end());
  return true;
}

void PathSearch::expand(std::uint32_t level, std::uint32_t group, TurnDirection direction, std::size_t places) {
  const auto n = static_cast<std::uint32_t>(levels_.size());
  const std::uint32_t to = direction == TurnDirection::counter_clockwise ? (level + 1) % n : (level + n - 1) % n;
  if (to == level) return;
  const auto unreached = [&] { return std::ranges::count(visits(to), false, &Visit::reached); };
  if (unreached() == 0) return;
  const Position arrival = visits(level)[group].at;
  try_place(level, group, to, direction, arrival);
  for (const Position& at : roomy(level, group, arrival, places)) {
    if (unreached() == 0) return;
    try_place(level, group, to, direction, at);
  }
  // Places of the pieces over there that are still missing.
  for (std::uint32_t g = 0; g < visits(to).size(); ++g) {
    if (visits(to)[g].reached) continue;
    for (const Position& at : roomy(to, g, arrival, places))
      if (levels_.graph(level).group_at(SlicePoint(at)) == group && try_place(level, group, to, direction, at)) break;
  }
}

void PathSearch::collect(std::uint32_t level, std::uint32_t group) {
  for (;;) {
    const Visit& v = visits(level)[group];
    if (v.from_level == level && v.from_group == group) break;
    steps_.push_back({v.at, levels_.theta(level), v.direction});
    level = v.from_level;
    group = v.from_group;
  }
  std::reverse(steps_.begin(), steps_.end());
}

// Whether pieces of two free cells at neighbouring levels may be joined between them.
bool PathSearch::neighbours(std::uint32_t level, std::uint32_t cell, std::uint32_t next,
    std::uint32_t next_cell) const {
  if (cell == SliceMap::kNone || next_cell == SliceMap::kNone || cell == next_cell) return true;
  const std::vector<FreeCell>& cells = obstacle_.free_cells();
  if (!joined_(cells[cell].component, cells[next_cell].component)) return false;
  const std::optional<std::uint32_t> slab = levels_.slab(level), next_slab = levels_.slab(next);
  if (!slab || !next_slab) return true;
  return slab != next_slab && (cells[cell].end == *next_slab || cells[next_cell].begin == *next_slab);
}

// Whether a piece of one of two neighbouring levels is reached, and one of the other is not that it may be joined to.
bool PathSearch::mismatch(std::uint32_t level, std::uint32_t next) {
  for (std::uint32_t g = 0; g < visits(level).size(); ++g)
    for (std::uint32_t h = 0; h < visits(next).size(); ++h) {
      if (visits(level)[g].reached == visits(next)[h].reached) continue;
      for (const std::uint32_t c : levels_.cells(level, g))
        for (const std::uint32_t d : levels_.cells(next, h))
          if (neighbours(level, c, next, d)) return true;
    }
  return false;
}

void PathSearch::refine() {
  std::vector<Orientation> more;
  const auto n = static_cast<std::uint32_t>(levels_.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    if (!mismatch(k, (k + 1) % n)) continue;
    const std::vector<Orientation> between = levels_.between(k);
    more.insert(more.end(), between.begin(), between.end());
  }
  for (const Orientation& theta : more) levels_.add(theta);
}

}  // namespace dymsum::planar
