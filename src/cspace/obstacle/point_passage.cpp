#include "cspace/obstacle/point_passage.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "exact/orient.h"

namespace dymsum::planar {
namespace {

/// The direction from z to a point, or the opposite one.
struct SectorEnd {
  Point to;
  bool opposite = false;
};
struct Sector {
  SectorEnd from, to;  ///< counter-clockwise
};

class Around {
 public:
  explicit Around(Point z) : z_(z) {}

  bool passable(const Region& region) const {
    const std::vector<Sector> free = free_sectors(region);
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Sector opposite{{free[j].from.to, true}, {free[j].to.to, true}};
        if (starts_in(free[i].from, opposite) || starts_in(opposite.from, free[i])) return true;
      }
    return false;
  }

 private:
  struct Ray {
    Point to;
    bool out;  // along a ring, which has the region on its left
  };

  // What is filled lies counter-clockwise from a ring's way out to its way in.
  std::vector<Sector> free_sectors(const Region& region) const {
    std::vector<Ray> rays;
    const auto add = [&](const Ring& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()];
        if (a == z_ || inside_edge(a, b)) rays.push_back({b, true});
        if (b == z_ || inside_edge(a, b)) rays.push_back({a, false});
      }
    };
    for (const Part& part : region.parts()) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
    }
    const auto half = [&](Point p) { return p.y > z_.y || (p.y == z_.y && p.x > z_.x) ? 0 : 1; };
    std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
      return half(a.to) != half(b.to) ? half(a.to) < half(b.to) : exact::orient_sign(z_, a.to, b.to) > 0;
    });
    std::vector<Sector> free;
    for (std::size_t k = 0; k < rays.size(); ++k)
      if (!rays[k].out) free.push_back({{rays[k].to}, {rays[(k + 1) % rays.size()].to}});
    return free;
  }
  bool inside_edge(Point a, Point b) const {
    if (z_.x < std::min(a.x, b.x) || z_.x > std::max(a.x, b.x) || z_.y < std::min(a.y, b.y) ||
        z_.y > std::max(a.y, b.y))
      return false;
    return z_ != a && z_ != b && exact::orient_sign(a, b, z_) == 0;
  }

  int cross(const SectorEnd& a, const SectorEnd& b) const {
    return exact::orient_sign(z_, a.to, b.to) * (a.opposite == b.opposite ? 1 : -1);
  }
  bool ahead(const SectorEnd& a) const { return (a.to.x != z_.x ? a.to.x > z_.x : a.to.y > z_.y) != a.opposite; }
  // Counter-clockwise from a to b: 0 for no turn, 1 for less than a half one, 2 for a half one, 3 for more.
  int turn(const SectorEnd& a, const SectorEnd& b) const {
    const int c = cross(a, b);
    return c != 0 ? (c > 0 ? 1 : 3) : ahead(a) == ahead(b) ? 0 : 2;
  }
  // Whether u is in [from, to).
  bool starts_in(const SectorEnd& u, const Sector& s) const {
    const int a = turn(s.from, u), b = turn(s.from, s.to);
    return a != b ? a < b : (a == 1 || a == 3) && cross(u, s.to) > 0;
  }

  Point z_;
};

}  // namespace

std::optional<Point> point_passage(const Region& region) {
  for (const Point& z : region.touching_points())
    if (Around(z).passable(region)) return z;
  return std::nullopt;
}

}  // namespace dymsum::planar
