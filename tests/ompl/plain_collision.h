// Whether two regions overlap and how far they are apart, in plain doubles from their edges: shares nothing with the
// library but the data, and knows poses for what they are only up to kDoubt.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dymsum/cspace_obstacle.h"

namespace dymsum::sampling {

inline constexpr double kDoubt = 1e-9;

struct Edge {
  Point a, b;
};

inline std::vector<Edge> edges_of(const Region& region) {
  std::vector<Edge> edges;
  const auto add = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) edges.push_back({ring[k], ring[(k + 1) % ring.size()]});
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return edges;
}

class PlainCollision {
 public:
  PlainCollision(const Region& robot, const Region& obstacle) : robot_(edges_of(robot)), obstacle_(edges_of(obstacle)) {
    for (const Edge& e : robot_) reach_ = std::max(reach_, std::hypot(e.a.x, e.a.y));
  }

  double reach() const { return reach_; }

  /// By more than about kDoubt: edges cross well inside both, or a corner is well inside the other region.
  bool overlaps(const Configuration& at) const {
    const std::vector<Edge> robot = placed(at);
    for (const Edge& e : robot)
      for (const Edge& f : obstacle_)
        if (apart(e, f.a) * apart(e, f.b) < 0 && apart(f, e.a) * apart(f, e.b) < 0) return true;
    const auto any_inside = [](const std::vector<Edge>& corners, const std::vector<Edge>& region) {
      return std::any_of(corners.begin(), corners.end(), [&](const Edge& e) {
        return inside(e.a, region) || inside({(e.a.x + e.b.x) / 2, (e.a.y + e.b.y) / 2}, region);
      });
    };
    return any_inside(robot, obstacle_) || any_inside(obstacle_, robot);
  }

  /// The distance of the boundaries.
  double gap(const Configuration& at) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Edge& e : placed(at))
      for (const Edge& f : obstacle_) {
        if (apart(e, f.a) * apart(e, f.b) < 0 && apart(f, e.a) * apart(f, e.b) < 0) return 0;
        least = std::min({least, distance(e.a, f), distance(e.b, f), distance(f.a, e), distance(f.b, e)});
      }
    return least;
  }

 private:
  std::vector<Edge> placed(const Configuration& at) const {
    const double c = std::cos(at.theta), s = std::sin(at.theta);
    const auto moved = [&](Point p) { return Point{at.x + c * p.x - s * p.y, at.y + s * p.x + c * p.y}; };
    std::vector<Edge> edges;
    for (const Edge& e : robot_) edges.push_back({moved(e.a), moved(e.b)});
    return edges;
  }
  // -1, 1 for a point on the right or the left of a line, 0 near it.
  static int apart(const Edge& e, Point p) {
    const double x = e.b.x - e.a.x, y = e.b.y - e.a.y;
    const double off = (x * (p.y - e.a.y) - y * (p.x - e.a.x)) / std::hypot(x, y);
    return off > kDoubt ? 1 : off < -kDoubt ? -1 : 0;
  }
  static double distance(Point p, const Edge& e) {
    const double x = e.b.x - e.a.x, y = e.b.y - e.a.y;
    const double t = std::clamp(((p.x - e.a.x) * x + (p.y - e.a.y) * y) / (x * x + y * y), 0.0, 1.0);
    return std::hypot(p.x - e.a.x - t * x, p.y - e.a.y - t * y);
  }
  static bool inside(Point p, const std::vector<Edge>& region) {
    bool odd = false;
    for (const Edge& e : region) {
      if (distance(p, e) <= kDoubt) return false;
      if ((e.a.y > p.y) != (e.b.y > p.y) && p.x < e.a.x + (p.y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x)) odd = !odd;
    }
    return odd;
  }
  std::vector<Edge> robot_, obstacle_;
  double reach_ = 0;
};

}  // namespace dymsum::sampling
