#include "shape/disc/disc_centres.h"

#include <algorithm>
#include <cmath>

#include "shape/disc/disc_oracle.h"

namespace dymsum::oracles {

namespace {

constexpr double kTangent = 1e-9;  // of what is under a root: curves that touch

Point along(Point a, Point direction, double t) { return {a.x + t * direction.x, a.y + t * direction.y}; }

}  // namespace

DiscCentres::DiscCentres(const Region& region, DiscSide side, double radius)
    : region_(region), side_(side), radius_(radius) {
  const auto add = [&](Point a, Point b) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Point d{(b.x - a.x) / length, (b.y - a.y) / length};
    for (const double r : {radius, -radius}) lines_.push_back({{a.x - r * d.y, a.y + r * d.x}, d});
  };
  const auto add_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      add(ring[i], ring[(i + 1) % ring.size()]);
      vertices_.push_back(ring[i]);
    }
  };
  for (const Part& part : region.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  for (const Polyline& line : region.polylines()) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) add(line[i], line[i + 1]);
    vertices_.insert(vertices_.end(), line.begin(), line.end());
  }
  vertices_.insert(vertices_.end(), region.points().begin(), region.points().end());
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Line &s = lines_[i], &t = lines_[j];
      const double cross = s.direction.x * t.direction.y - s.direction.y * t.direction.x;
      if (std::abs(cross) < 1e-9) continue;
      see(along(s.a, s.direction, ((t.a.x - s.a.x) * t.direction.y - (t.a.y - s.a.y) * t.direction.x) / cross));
    }
  for (const Line& line : lines_)
    for (const Point v : vertices_) meet(line, v);
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) meet(vertices_[i], vertices_[j]);
}

double DiscCentres::clearance(Point c) const {
  return side_ == DiscSide::outside ? distance(region_, c) : depth(region_, c);
}

void DiscCentres::meet(const Line& line, Point v) {
  const double t = (v.x - line.a.x) * line.direction.x + (v.y - line.a.y) * line.direction.y;
  const Point foot = along(line.a, line.direction, t);
  const double rest = radius_ * radius_ - (v.x - foot.x) * (v.x - foot.x) - (v.y - foot.y) * (v.y - foot.y);
  if (rest < -kTangent) return;
  const double half = std::sqrt(std::max(0.0, rest));
  see(along(foot, line.direction, half));
  see(along(foot, line.direction, -half));
}

void DiscCentres::meet(Point v, Point w) {
  const double d = std::hypot(w.x - v.x, w.y - v.y);
  if (d == 0) return;
  const double rest = radius_ * radius_ - d * d / 4;
  if (rest < -kTangent) return;
  const double half = std::sqrt(std::max(0.0, rest));
  const Point midpoint{(v.x + w.x) / 2, (v.y + w.y) / 2}, across{-(w.y - v.y) / d, (w.x - v.x) / d};
  see(along(midpoint, across, half));
  see(along(midpoint, across, -half));
}

std::optional<double> DiscCentres::nearest(Point z) const {
  if (is_centre(z)) return 0;
  std::optional<double> least;
  const auto see_centre = [&](Point c, bool known) {
    const double far = std::hypot(c.x - z.x, c.y - z.y);
    if ((!least || far < *least) && (known || is_centre(c))) least = far;
  };
  for (const Point c : corners_) see_centre(c, true);
  for (const Line& line : lines_) {
    const double t = (z.x - line.a.x) * line.direction.x + (z.y - line.a.y) * line.direction.y;
    see_centre(along(line.a, line.direction, t), false);
  }
  for (const Point v : vertices_) {
    const double far = std::hypot(z.x - v.x, z.y - v.y);
    if (far > 0) see_centre(along(v, {(z.x - v.x) / far, (z.y - v.y) / far}, radius_), false);
  }
  return least;
}

}  // namespace dymsum::oracles
