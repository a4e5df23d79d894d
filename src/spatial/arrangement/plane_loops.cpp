#include "spatial/arrangement/plane_loops.h"

#include <algorithm>
#include <numeric>

namespace dymsum::spatial {

void PlaneLoops::run() {
  trace();
  find_components();
  nest();
}

void PlaneLoops::trace() {
  of_.assign(half_edges_.count(), kNoId);
  start_.clear();
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    if (of_[h] != kNoId) continue;
    const std::uint32_t loop = count();
    start_.push_back(h);
    for (std::uint32_t g = h; of_[g] == kNoId; g = half_edges_.next(g)) of_[g] = loop;
  }
}

void PlaneLoops::find_components() {
  const std::vector<PointId>& points = half_edges_.points();
  // Each component has two more points and loops than edges.
  const std::size_t components = (points.size() + count() - half_edges_.count() / 2) / 2;
  if (components == 1) component_.assign(count(), 0);
  else join();
  lowest_.assign(components, kNoId);
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    std::uint32_t& lowest = lowest_[component_[of_[half_edges_.first_out(v)]]];
    if (lowest == kNoId || before(points[v], points[lowest])) lowest = v;
  }
  outer_.resize(components);
  is_outer_.assign(count(), false);
  for (std::uint32_t c = 0; c < components; ++c) {
    outer_[c] = of_[half_edges_.last_around(lowest_[c])];
    is_outer_[outer_[c]] = true;
  }
}

/// Joins loops with a point in common: the two sides of every edge, and all half-edges out of a point.
void PlaneLoops::join() {
  parent_.resize(count());
  std::iota(parent_.begin(), parent_.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  };
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    parent_[root(of_[h])] = root(of_[h ^ 1]);
    parent_[root(of_[h])] = root(of_[half_edges_.first_beside(h)]);
  }
  component_.resize(count());
  index_.assign(count(), kNoId);
  std::uint32_t components = 0;
  for (std::uint32_t l = 0; l < count(); ++l) {
    const std::uint32_t r = root(l);
    if (index_[r] == kNoId) index_[r] = components++;
    component_[l] = index_[r];
  }
}

/// Lexicographic order of points of the plane.
bool PlaneLoops::before(PointId a, PointId b) const {
  const int s = points_.order(a, b, 0);
  return s != 0 ? s > 0 : points_.order(a, b, 1) > 0;
}

void PlaneLoops::nest() {
  home_.assign(components(), kNoId);
  if (components() < 2) return;
  find_boxes();
  for (std::uint32_t c = 0; c < components(); ++c) {
    around_.clear();
    for (std::uint32_t l = 0; l < count(); ++l)
      if (!is_outer_[l] && component_[l] != c && encloses(l, lowest_point(c))) around_.push_back(l);
    // The innermost: the one whose component is enclosed by all the others.
    std::size_t most = 0;
    for (const std::uint32_t l : around_) {
      std::size_t depth = 1;
      for (const std::uint32_t m : around_)
        depth += m != l && component_[m] != component_[l] && encloses(m, lowest_point(component_[l]));
      if (depth > most) most = depth, home_[c] = l;
    }
  }
}

void PlaneLoops::find_boxes() {
  box_.assign(count(), {});
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    const Approx& at = points_.approx(half_edges_.from(h));
    LoopBox& box = box_[of_[h]];
    const double x = points_.x(at), y = points_.y(at);
    box.low_x = std::min(box.low_x, x - at.radius), box.high_x = std::max(box.high_x, x + at.radius);
    box.low_y = std::min(box.low_y, y - at.radius), box.high_y = std::max(box.high_y, y + at.radius);
  }
}

/// Whether a point may lie in a loop, as far as their boxes show.
bool PlaneLoops::near(std::uint32_t loop, PointId p) const {
  const Approx& at = points_.approx(p);
  const LoopBox& box = box_[loop];
  const double x = points_.x(at), y = points_.y(at), r = at.radius;
  return x + r >= box.low_x && x - r <= box.high_x && y + r >= box.low_y && y - r <= box.high_y;
}

/// Whether a point that lies on no edge of a loop lies inside it: the edges to the left of it, at its height.
bool PlaneLoops::encloses(std::uint32_t loop, PointId p) const {
  if (!near(loop, p)) return false;
  bool inside = false;
  std::uint32_t h = start_[loop];
  do {
    const bool a_above = points_.order(p, half_edges_.from(h), 1) > 0;
    const bool b_above = points_.order(p, half_edges_.to(h), 1) > 0;
    if (a_above != b_above) {
      // Upward edges have the points to their right on their way's right.
      const int left = points_.left_of(half_edges_.edge(h).cut, p) * half_edges_.direction(h);
      if (b_above ? left < 0 : left > 0) inside = !inside;
    }
    h = half_edges_.next(h);
  } while (h != start_[loop]);
  return inside;
}

}  // namespace dymsum::spatial
