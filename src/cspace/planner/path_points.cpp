#include "cspace/planner/path_points.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dymsum::planar {
namespace {

using Move = Waypoint::Move;

bool same_position(const Position& a, const Position& b) { return a.x == b.x && a.y == b.y; }

Move move_of(TurnDirection d) { return d == TurnDirection::clockwise ? Move::clockwise : Move::counter_clockwise; }

}  // namespace

PathPoints::PathPoints(const CspaceObstacle& obstacle, PathLevels& levels, Touching touching)
    : levels_(levels), touching_(touching), pivot_(obstacle.robot(), obstacle.obstacle()) {}

void PathPoints::translate(Points& path, const Position& to) {
  const PathPoint from = path.back();
  levels_.let_go();
  const std::vector<Position> way = levels_.graph(levels_.add(from.theta)).way(from.at, to);
  for (std::size_t k = 1; k < way.size(); ++k)
    if (!same_position(path.back().at, way[k])) path.push_back({Move::translation, way[k], from.theta});
}

void PathPoints::rotate(Points& path, const Orientation& to, TurnDirection direction) {
  if (path.back().move == move_of(direction)) {
    path.back().theta = to;
    return;
  }
  path.push_back({move_of(direction), path.back().at, to});
}

bool PathPoints::glides(const Orientation& theta, const Position& from, const Position& to) {
  levels_.let_go();
  return levels_.map(levels_.add(theta)).passage(SlicePoint(from), SlicePoint(to), touching_ == Touching::allowed).free;
}

// The shorter way first.
std::optional<TurnDirection> PathPoints::turns(const Position& at, const Orientation& from, const Orientation& to) {
  const bool ahead = std::remainder(to.radians() - from.radians(), 2 * std::numbers::pi) >= 0;
  pivot_.stand(at);
  for (const bool way : {ahead, !ahead}) {
    const TurnDirection d = way ? TurnDirection::counter_clockwise : TurnDirection::clockwise;
    if (!pivot_.stop(from, to, d, touching_)) return d;
  }
  return std::nullopt;
}

PathPoints::Points PathPoints::direct(const PathPoint& from, const PathPoint& to, std::size_t most) {
  const bool stays = same_position(from.at, to.at), keeps = from.theta == to.theta;
  if (keeps) return glides(from.theta, from.at, to.at) ? Points{{Move::translation, to.at, to.theta}} : Points{};
  if (stays) {
    const auto d = turns(from.at, from.theta, to.theta);
    return d ? Points{{move_of(*d), to.at, to.theta}} : Points{};
  }
  if (most < 2) return {};
  if (glides(from.theta, from.at, to.at))
    if (const auto d = turns(to.at, from.theta, to.theta))
      return {{Move::translation, to.at, from.theta}, {move_of(*d), to.at, to.theta}};
  if (glides(to.theta, from.at, to.at))
    if (const auto d = turns(from.at, from.theta, to.theta))
      return {{move_of(*d), from.at, to.theta}, {Move::translation, to.at, to.theta}};
  return {};
}

// Fewer moves lead from every point to the farthest later one for which that works; a bounded number of attempts.
PathPoints::Points PathPoints::shortened(const Points& path) {
  constexpr std::size_t kMostAttempts = 400;
  std::size_t attempts = 0;
  Points few{path.front()};
  for (std::size_t k = 0; k + 1 < path.size();) {
    std::size_t next = k + 1;
    Points moves{path[k + 1]};
    for (std::size_t j = path.size() - 1; j > k + 1 && attempts < kMostAttempts; --j, ++attempts) {
      Points shortcut = direct(path[k], path[j], j - k - 1);
      if (shortcut.empty()) continue;
      moves = std::move(shortcut);
      next = j;
      break;
    }
    few.insert(few.end(), moves.begin(), moves.end());
    k = next;
  }
  return few;
}

void PathPoints::require_free(const Points& path) {
  for (std::size_t k = 1; k < path.size(); ++k) {
    const PathPoint &a = path[k - 1], &b = path[k];
    bool free = false;
    if (b.move == Move::translation) {
      free = a.theta == b.theta && glides(a.theta, a.at, b.at);
    } else {
      pivot_.stand(a.at);
      const auto d = b.move == Move::clockwise ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
      free = same_position(a.at, b.at) && !pivot_.stop(a.theta, b.theta, d, touching_);
    }
    if (!free) throw std::logic_error("plan: a piece of the path is not free");
  }
}

PathPoints::Points PathPoints::points(const PathEnd& start, const std::vector<PathStep>& steps, const PathEnd& goal) {
  Points path{{Move::start, start.at, start.theta}};
  for (const PathStep& step : steps) {
    translate(path, step.at);
    rotate(path, step.theta, step.direction);
  }
  translate(path, goal.at);
  for (std::size_t before = path.size() + 1; path.size() < before;) {
    before = path.size();
    path = shortened(path);
  }
  path = tightened(shortened(tightened(std::move(path))));
  require_free(path);
  return path;
}

}  // namespace dymsum::planar
