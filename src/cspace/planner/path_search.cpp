#include "cspace/planner/path_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::planar {

namespace {}  // namespace

PathLinks::PathLinks(const CspaceObstacle& obstacle, PathLevels& levels, const JoinedComponents& joined)
    : obstacle_(obstacle), levels_(levels), joined_(joined) {
  const std::vector<FreeCell>& cells = obstacle.free_cells();
  for (std::uint32_t c = 0; c < cells.size(); ++c)
    for (const std::uint32_t event : {cells[c].begin, cells[c].end})
      if (event != Patch::kNone) at_event_[{event, root(c)}].push_back(c);
}

std::uint32_t PathLinks::root(std::uint32_t cell) const { return joined_.root(obstacle_.free_cells()[cell].component); }

bool PathLinks::may_join(std::uint32_t cell, std::uint32_t next, std::optional<std::uint32_t> event) const {
  if (cell == kUnknown || next == kUnknown || cell == next) return true;
  if (!event || root(cell) != root(next)) return false;
  const std::vector<FreeCell>& cells = obstacle_.free_cells();
  return cells[cell].end == *event || cells[next].begin == *event;
}

bool PathLinks::may_join(std::size_t k, std::uint32_t group, std::uint32_t next_group) {
  const std::size_t next = (k + 1) % levels_.size();
  const std::vector<std::uint32_t>&cells = levels_.cells(k, group), &beyond = levels_.cells(next, next_group);
  // Cracks alone have no cells; they are what is left of a passage.
  if (cells.empty() || beyond.empty()) return true;
  const std::optional<std::uint32_t> event = levels_.event_before_next(k);
  return std::any_of(cells.begin(), cells.end(), [&](std::uint32_t c) {
    return std::any_of(beyond.begin(), beyond.end(), [&](std::uint32_t d) { return may_join(c, d, event); });
  });
}

void PathLinks::aim(std::size_t k, std::uint32_t group) {
  const std::vector<FreeCell>& cells = obstacle_.free_cells();
  steps_.assign(cells.size(), static_cast<std::uint32_t>(cells.size()));
  std::vector<std::uint32_t> open;
  for (const std::uint32_t c : levels_.cells(k, group))
    if (c != kUnknown) {
      steps_[c] = 0;
      open.push_back(c);
    }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> left = at_event_;
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::uint32_t event : {cells[open[i]].begin, cells[open[i]].end}) {
      const auto at = left.find({event, root(open[i])});
      if (at == left.end()) continue;
      for (const std::uint32_t c : at->second)
        if (steps_[c] == far()) {
          steps_[c] = steps_[open[i]] + 1;
          open.push_back(c);
        }
      left.erase(at);
    }
}

std::uint32_t PathLinks::steps(std::size_t k, std::uint32_t group) {
  std::uint32_t least = far();
  for (const std::uint32_t c : levels_.cells(k, group))
    if (c != kUnknown) least = std::min(least, steps_[c]);
  return least;
}

namespace {

constexpr std::uint32_t kUnreached = SliceMap::kNone;

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

// The number of positions of a piece at which a rotation is tried: more and more as levels come closer, so that in the
// end it is tried at all.
std::size_t positions_at(std::uint32_t depth) { return std::size_t{12} << std::min(depth, 24u); }

}  // namespace

PathSearch::PathSearch(const CspaceObstacle& obstacle, PathLevels& levels, PathLinks& links, Touching touching)
    : levels_(levels), links_(links), touching_(touching), pivot_(obstacle.robot(), obstacle.obstacle()) {
  const Pose pose(obstacle.robot(), obstacle.obstacle());
  room_ = pose.reach() * pose.reach();
}

std::vector<std::uint32_t>& PathSearch::visits_at(std::size_t level) {
  std::vector<std::uint32_t>& v = visits_at_[levels_.level(level)];
  if (v.empty()) v.assign(levels_.graph(level).groups(), kUnreached);
  return v;
}

PathSearch::Outcome PathSearch::run(const PathEnd& start, const PathEnd& goal, const SearchLimits& limits) {
  const std::size_t begin = levels_.add(start.theta), end = levels_.add(goal.theta);
  goal_angle_ = goal.theta.radians();
  goal_level_ = levels_.level(end);
  goal_group_ = levels_.graph(end).group_at(SlicePoint(goal.at));
  links_.aim(end, goal_group_);
  visit({levels_.level(begin), levels_.graph(begin).group_at(SlicePoint(start.at)), 0, start.at, {}, 0});
  for (;;) {
    if (const std::optional<Outcome> ended = expand_all(limits)) return *ended;
    queue_stuck();
    const std::optional<Stuck> gap = next_stuck();
    if (!gap) return Outcome::nothing;
    refine(*gap);
  }
}

void PathSearch::visit(Visit v) {
  const auto index = static_cast<std::uint32_t>(visits_.size());
  visits_at(levels_.index_of(v.level))[v.group] = index;
  const double estimate = v.cost + turn_between(v.level->theta.radians(), goal_angle_);
  for (const TurnDirection d : {TurnDirection::counter_clockwise, TurnDirection::clockwise})
    open_.push({estimate, index, d});
  visits_.push_back(std::move(v));
}

// Expands until the goal is reached or nothing new is, with the levels there are.
std::optional<PathSearch::Outcome> PathSearch::expand_all(const SearchLimits& limits) {
  while (!open_.empty()) {
    const Open here = open_.top();
    open_.pop();
    const Visit& v = visits_[here.visit];
    if (v.level == goal_level_ && v.group == goal_group_) {
      last_ = here.visit;
      return Outcome::found;
    }
    const SearchStop stop = limits.query();
    if (stop == SearchStop::cancelled) return Outcome::cancelled;
    if (stop == SearchStop::out_of_time) {
      const std::size_t n = levels_.size(), k = levels_.index_of(v.level);
      touched_.insert(touched_.end(), {v.level, levels_.level((k + n - 1) % n)});
      return Outcome::out_of_time;
    }
    levels_.let_go();
    expand(here.visit, here.direction);
  }
  return std::nullopt;
}

// Pieces of a neighbouring level that are not reached, and to which this one may be joined.
std::vector<std::uint32_t> PathSearch::wanted(std::size_t level, std::uint32_t group, std::size_t to,
                                              TurnDirection direction) {
  std::vector<std::uint32_t> all;
  const auto groups = static_cast<std::uint32_t>(visits_at(to).size());
  for (std::uint32_t h = 0; h < groups; ++h) {
    if (reached(to, h)) continue;
    const bool ahead = direction == TurnDirection::counter_clockwise;
    if (ahead ? links_.may_join(level, group, h) : links_.may_join(to, h, group)) all.push_back(h);
  }
  return all;
}

void PathSearch::expand(std::uint32_t visit, TurnDirection direction) {
  const PathLevel* here = visits_[visit].level;
  const std::uint32_t group = visits_[visit].group;
  const Position arrival = visits_[visit].at;
  const std::size_t n = levels_.size(), level = levels_.index_of(here);
  const std::size_t to = direction == TurnDirection::counter_clockwise ? (level + 1) % n : (level + n - 1) % n;
  const PathLevel* low = direction == TurnDirection::counter_clockwise ? here : levels_.level(to);
  std::vector<std::uint32_t> missing = wanted(level, group, to, direction);
  if (missing.empty()) return;
  touched_.push_back(low);
  const auto left = [&] { return std::erase_if(missing, [&](auto h) { return reached(to, h); }), !missing.empty(); };
  const std::size_t positions = positions_at(depth_[low]);
  try_place(visit, to, direction, arrival);
  for (const Position& at : roomy(level, group, arrival, positions)) {
    if (!left()) return;
    try_place(visit, to, direction, at);
  }
  // Positions of the pieces over there that are still missing.
  for (const std::uint32_t h : std::vector<std::uint32_t>(missing)) {
    if (reached(to, h)) continue;
    for (const Position& at : roomy(to, h, arrival, positions))
      if (levels_.graph(level).group_at(SlicePoint(at)) == group && try_place(visit, to, direction, at)) break;
  }
}

// Positions of a group: the midpoints of trapezoids and the ends of cracks, those with room for the robot first, the
// near ones before the far ones.
std::vector<Position> PathSearch::roomy(std::size_t level, std::uint32_t group, const Position& near,
                                        std::size_t most) {
  const SliceGraph& graph = levels_.graph(level);
  const Point at = SlicePoint(near).at();
  std::vector<std::tuple<double, double, std::uint32_t>> order;
  for (std::uint32_t k = 0; k < graph.nodes(); ++k) {
    if (graph.group_of(k) != group) continue;
    const bool crack = k >= graph.trapezoids().size();
    const Point c = crack ? at : graph.trapezoids()[k].near;
    order.emplace_back(crack ? 0 : -std::min(room_, graph.trapezoids()[k].size), std::hypot(c.x - at.x, c.y - at.y), k);
  }
  std::sort(order.begin(), order.end());
  if (order.size() > most) order.resize(most);
  std::vector<Position> positions;
  for (const auto& [size, distance, k] : order)
    for (Position& position : graph.positions_of(k)) positions.push_back(std::move(position));
  return positions;
}

bool PathSearch::try_place(std::uint32_t from, std::size_t to, TurnDirection direction, const Position& at) {
  const std::uint32_t group = levels_.graph(to).group_at(SlicePoint(at));
  if (group == kUnreached || reached(to, group)) return false;
  ++rotations_;
  pivot_.stand(at);
  const Orientation &here = visits_[from].level->theta, &there = levels_.theta(to);
  if (pivot_.stop(here, there, direction, touching_)) return false;
  const double cost = visits_[from].cost + turn_between(here.radians(), there.radians());
  visit({levels_.level(to), group, from, at, direction, cost});
  return true;
}

std::vector<PathStep> PathSearch::steps() const {
  std::vector<PathStep> steps;
  for (std::uint32_t v = last_; visits_[v].from != v; v = visits_[v].from)
    steps.push_back({visits_[v].at, visits_[v].level->theta, visits_[v].direction});
  std::reverse(steps.begin(), steps.end());
  return steps;
}

// The gap after a level, if a piece of one of its levels is reached, and one of the other is not that it may be
// joined to.
std::optional<PathSearch::Stuck> PathSearch::stuck_at(const PathLevel* low) {
  const std::size_t k = levels_.index_of(low), next = (k + 1) % levels_.size();
  const PathLevel* high = levels_.level(next);
  Stuck gap{links_.far(), depth_[low], turn_between(low->theta.radians(), high->theta.radians()), low, high};
  bool stuck = false;
  for (std::uint32_t g = 0; g < visits_at(k).size(); ++g)
    for (std::uint32_t h = 0; h < visits_at(next).size(); ++h) {
      if (reached(k, g) == reached(next, h) || !links_.may_join(k, g, h)) continue;
      stuck = true;
      gap.steps = std::min({gap.steps, links_.steps(k, g), links_.steps(next, h)});
    }
  return stuck ? std::optional(gap) : std::nullopt;
}

void PathSearch::queue_stuck() {
  std::sort(touched_.begin(), touched_.end(), [](const auto* a, const auto* b) { return a->id < b->id; });
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const PathLevel* low : touched_) {
    levels_.let_go();
    if (const std::optional<Stuck> gap = stuck_at(low)) stuck_.push(*gap);
  }
  touched_.clear();
}

// The first of the queue that is still there and stuck: what is reached in the meantime may have settled it.
std::optional<PathSearch::Stuck> PathSearch::next_stuck() {
  while (!stuck_.empty()) {
    const Stuck gap = stuck_.top();
    stuck_.pop();
    const std::size_t k = levels_.index_of(gap.low);
    if (levels_.level((k + 1) % levels_.size()) == gap.high && stuck_at(gap.low)) return gap;
  }
  return std::nullopt;
}

void PathSearch::refine(const Stuck& gap) {
  ++refinements_;
  const std::vector<Orientation> more = levels_.between(levels_.index_of(gap.low));
  depth_[gap.low] = gap.depth + 1;
  for (const Orientation& theta : more) depth_[levels_.level(levels_.add(theta))] = gap.depth + 1;
  for (const auto& [level, direction] :
       {std::pair{gap.low, TurnDirection::counter_clockwise}, std::pair{gap.high, TurnDirection::clockwise}})
    for (const std::uint32_t v : visits_at(levels_.index_of(level)))
      if (v != kUnreached)
        open_.push({visits_[v].cost + turn_between(level->theta.radians(), goal_angle_), v, direction});
}

std::optional<PathBarrier> PathSearch::barrier() {
  queue_stuck();
  const std::optional<Stuck> gap = next_stuck();
  if (!gap) return std::nullopt;
  const std::size_t k = levels_.index_of(gap->low), next = (k + 1) % levels_.size();
  for (std::uint32_t g = 0; g < visits_at(k).size(); ++g)
    for (std::uint32_t h = 0; h < visits_at(next).size(); ++h) {
      if (reached(k, g) == reached(next, h) || !links_.may_join(k, g, h)) continue;
      const bool first = reached(k, g);
      const Position at = visits_[first ? visits_at(k)[g] : visits_at(next)[h]].at;
      const std::vector<Position> beyond = first ? roomy(next, h, at, 1) : roomy(k, g, at, 1);
      return PathBarrier{gap->low->theta, gap->high->theta, at, beyond.empty() ? at : beyond[0]};
    }
  return std::nullopt;
}

}  // namespace dymsum::planar
