#include "cspace/planner/path_points.h"

#include <algorithm>
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

// Shorter paths of the same kind: places where a path bends or turns are drawn towards the straight way between their
// neighbours, as far as that stays free. Every step is checked exactly.

namespace {

constexpr int kMostSweeps = 6;
constexpr std::size_t kMostAttempts = 600;  // a slice map or a pivot is asked a few times in each

double length(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }
Point between(Point a, Point b, double fraction) {
  return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
}

// The point of the segment from a to b that is nearest to p.
Point foot(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
  return between(a, b, std::clamp(t, 0.0, 1.0));
}

Point near(const Position& p) { return SlicePoint(p).at(); }
Position exactly(Point p) { return {exact::exact_value(p.x), exact::exact_value(p.y)}; }

}  // namespace

// Points first to last of a path are in one place, which is moved to `to` with them.
bool PathPoints::stays_free(const Points& path, std::size_t first, std::size_t last, const Position& to) {
  if (!glides(path[first].theta, path[first - 1].at, to)) return false;
  if (last + 1 < path.size() && !glides(path[last].theta, to, path[last + 1].at)) return false;
  pivot_.stand(to);
  for (std::size_t k = first + 1; k <= last; ++k) {
    const bool back = path[k].move == Waypoint::Move::clockwise;
    const auto d = back ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
    if (pivot_.stop(path[k - 1].theta, path[k].theta, d, touching_)) return false;
  }
  return true;
}

PathPoints::Points PathPoints::tightened(Points path) {
  std::size_t attempts = 0;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double gained = 0, whole = 0;
    for (std::size_t first = 1; first < path.size();) {
      std::size_t last = first;
      while (last + 1 < path.size() && path[last + 1].move != Waypoint::Move::translation) ++last;
      const bool moves = path[first].move == Waypoint::Move::translation && last + 1 < path.size();
      if (moves) gained += draw_in(path, first, last, attempts);
      whole += length(near(path[first - 1].at), near(path[last].at));
      first = last + 1;
    }
    // How long to go on: every path on the way is free and checked, so this decides nothing else.
    if (attempts >= kMostAttempts || gained <= 1e-3 * whole) break;
  }
  // A position may have been drawn to its neighbour.
  Points moving{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Position &a = path[k - 1].at, &b = path[k].at;
    if (path[k].move != Waypoint::Move::translation || a.x != b.x || a.y != b.y) moving.push_back(path[k]);
  }
  return moving;
}

// The sum of the ways before and after a position is a convex function of it, least on the segment between its
// neighbours: towards that and towards either of them it only falls. How much is gained.
double PathPoints::draw_in(Points& path, std::size_t first, std::size_t last, std::size_t& attempts) {
  const Point a = near(path[first - 1].at), b = near(path[last + 1].at);
  double gained = 0;
  for (int towards = 0; towards < 3; ++towards) {
    const Point p = near(path[first].at), goal = towards == 0 ? foot(a, b, p) : towards == 1 ? a : b;
    double now = length(a, p) + length(p, b);
    if (now <= length(a, b) * (1 + 1e-6)) break;
    double low = 0, high = 1;  // the farthest fraction that is free lies between, as far as is known
    for (int step = 0; step < 5 && attempts < kMostAttempts; ++step, ++attempts) {
      const double fraction = step == 0 && towards == 0 ? 1 : (low + high) / 2;
      const Point to = between(p, goal, fraction);
      const double then = length(a, to) + length(to, b);
      if (!(then < now)) break;
      if (!stays_free(path, first, last, exactly(to))) {
        high = fraction;
        continue;
      }
      for (std::size_t k = first; k <= last; ++k) path[k].at = exactly(to);
      gained += now - then;
      now = then;
      low = fraction;
      if (fraction == 1) return gained;
    }
  }
  return gained;
}

}  // namespace dymsum::planar
