// The slow answer to a planner: which poses of a grid certified balls join.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

#include "dymsum/cspace_obstacle.h"

namespace dymsum {

// The slow answer: a grid of poses in doubles, joined where the distance of robot and obstacle exceeds what the step
// moves.
class FloodFill {
 public:
  FloodFill(const CspaceObstacle& c, double reach, int steps, int turns)
      : c_(c), reach_(reach), steps_(steps), turns_(turns), gap_(static_cast<std::size_t>(steps) * steps * turns, -1) {
    for (const Part& part : c.robot().parts())
      for (const Point& p : part.outer) radius_ = std::max(radius_, std::hypot(p.x, p.y));
  }
  Configuration at(int i, int j, int k) const {
    return {-reach_ + 2 * reach_ * i / (steps_ - 1), -reach_ + 2 * reach_ * j / (steps_ - 1),
            -std::numbers::pi + 2 * std::numbers::pi * (k + 0.5) / turns_};
  }
  double gap(int i, int j, int k) {
    double& g = gap_[static_cast<std::size_t>((k * steps_ + i) * steps_ + j)];
    if (g >= 0) return g;
    const Configuration q = at(i, j, k);
    return g = c_.contains(q.x, q.y, *Orientation::nearest(q.theta, 1e-9)) ? 0 : std::max(0.0, distance(q) - 1e-6);
  }
  // The numbers of all poses that are reached from one.
  std::vector<bool> reached(std::array<int, 3> from) {
    std::vector<bool> seen(gap_.size(), false);
    std::queue<std::array<int, 3>> open;
    const auto number = [&](const std::array<int, 3>& n) {
      return static_cast<std::size_t>((n[2] * steps_ + n[0]) * steps_ + n[1]);
    };
    seen[number(from)] = true;
    open.push(from);
    const double step = 2 * reach_ / (steps_ - 1), turn = radius_ * 2 * std::numbers::pi / turns_;
    while (!open.empty()) {
      const auto n = open.front();
      open.pop();
      for (int d = 0; d < 6; ++d) {
        std::array<int, 3> m = n;
        m[static_cast<std::size_t>(d / 2)] += d % 2 == 0 ? 1 : -1;
        if (m[0] < 0 || m[1] < 0 || m[0] >= steps_ || m[1] >= steps_) continue;
        m[2] = (m[2] + turns_) % turns_;
        if (seen[number(m)] || std::max(gap(n[0], n[1], n[2]), gap(m[0], m[1], m[2])) <= (d < 4 ? step : turn))
          continue;
        seen[number(m)] = true;
        open.push(m);
      }
    }
    return seen;
  }

 private:
  double distance(Configuration q) const {
    double least = 1e300;
    const auto segments = [](const Region& r, auto visit) {
      for (const Part& part : r.parts()) {
        const auto ring = [&](const Ring& v) {
          for (std::size_t k = 0; k < v.size(); ++k) visit(v[k], v[(k + 1) % v.size()]);
        };
        ring(part.outer);
        for (const Ring& hole : part.holes) ring(hole);
      }
    };
    const auto point = [](Point a, Point b, Point p) {
      const double dx = b.x - a.x, dy = b.y - a.y,
                   s = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      return std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy);
    };
    const double cosine = std::cos(q.theta), sine = std::sin(q.theta);
    const auto moved = [&](Point p) { return Point{q.x + cosine * p.x - sine * p.y, q.y + sine * p.x + cosine * p.y}; };
    segments(c_.robot(), [&](Point a, Point b) {
      a = moved(a), b = moved(b);
      segments(c_.obstacle(), [&](Point u, Point v) { least = std::min({least, point(a, b, u), point(u, v, a)}); });
    });
    return least;
  }
  const CspaceObstacle& c_;
  double reach_, radius_ = 0;
  int steps_, turns_;
  std::vector<double> gap_;
};

}  // namespace dymsum
