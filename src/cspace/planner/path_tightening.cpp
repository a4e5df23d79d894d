// Shorter paths of the same kind: places where a path bends or turns are drawn towards the straight way between their
// neighbours, as far as that stays free. Every step is checked exactly.
#include "cspace/planner/path_points.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
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
