// What goes on along one line behind an event: a sub-edge that ends there and one that begins have a stretch in common.
// Exact at the event's angle, which is algebraic.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cspace/events/walk_numbers.h"
#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {

double ObstacleSweep::line_offset(std::uint32_t n, Heading h) const {
  const Point d = forms_.direction(nodes_[n].segment, h),
              from = forms_.place(TurningForms::start(nodes_[n].segment), h);
  return (d.x * from.y - d.y * from.x) / std::hypot(d.x, d.y);
}

// All pairs of an ended node and a new one that continues it. Their lines have one offset: nodes are looked up by it.
std::vector<std::pair<std::uint32_t, std::uint32_t>> ObstacleSweep::continued_stretches(
    const std::vector<std::uint32_t>& ended, const std::vector<std::uint32_t>& fresh) const {
  const Heading h = Heading::of(theta_now_);
  std::vector<std::pair<double, std::uint32_t>> lines;
  lines.reserve(fresh.size());
  for (const std::uint32_t m : fresh) lines.emplace_back(line_offset(m, h), m);
  std::sort(lines.begin(), lines.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  const double near = kLineNear * forms_.span();
  for (const std::uint32_t n : ended) {
    const double at = line_offset(n, h);
    const auto first = std::lower_bound(lines.begin(), lines.end(), std::pair{at - near, std::uint32_t{0}});
    for (auto m = first; m != lines.end() && m->first <= at + near; ++m)
      if (continues(n, m->second, h)) found.emplace_back(n, m->second);
  }
  return found;
}

// Whether an ended node and a new one have a stretch of a line in common at the event's angle, which is near h.
bool ObstacleSweep::continues(std::uint32_t n, std::uint32_t m, Heading h) const {
  const WalkSegment &s = nodes_[n].segment, &t = nodes_[m].segment;
  if (!on_one_line(s, t, h)) return false;
  const Point d = forms_.direction(s, h), base = forms_.place(TurningForms::start(s), h);
  const double length = std::hypot(d.x, d.y);
  double error = 0x1p-40 * forms_.span();
  // Places along the line in doubles; of nearly parallel lines they may be anywhere on the segment.
  const auto along = [&](std::uint32_t k, bool at_end) {
    const Node& node = nodes_[k];
    const Point from = forms_.place(TurningForms::start(node.segment), h), e = forms_.direction(node.segment, h);
    const Located at = place_on(forms_, node.segment, segment_of(at_end ? node.right : node.left), !at_end, h);
    error += std::isnan(at.error) ? INFINITY : at.error * forms_.length1(node.segment);
    const double u = std::clamp(at.t, 0.0, 1.0);
    return (d.x * (from.x + u * e.x - base.x) + d.y * (from.y + u * e.y - base.y)) / length;
  };
  const double low = std::max(along(n, false), along(m, false)), high = std::min(along(n, true), along(m, true));
  if (high - low > error) return true;
  if (high - low < -error) return false;
  for (const std::uint32_t end : {n, m}) {
    const std::optional<Fraction> to = end_along(signs_now(), s, sub_edge(end), true);
    for (const std::uint32_t start : {n, m}) {
      const std::optional<Fraction> from = end_along(signs_now(), s, sub_edge(start), false);
      // Lines that are parallel at every angle do not bound each other.
      if (!to || !from) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
      if (signs_now().compare(*to, *from) <= 0) return false;
    }
  }
  return true;
}

// Of one direction and on one line at the angle of the group: exactly, where doubles do not tell them apart.
bool ObstacleSweep::on_one_line(const WalkSegment& s, const WalkSegment& t, Heading h) const {
  const Point d = forms_.direction(s, h), e = forms_.direction(t, h);
  return d.x * e.x + d.y * e.y > 0 && collinear(s, t, h);
}

bool ObstacleSweep::collinear(const WalkSegment& s, const WalkSegment& t, Heading h) const {
  if (std::abs(forms_.cross(s, t).at(h)) > 0x1p-40 * forms_.length1(s) * forms_.length1(t)) return false;
  const TrigForm side = forms_.side(s, TurningForms::start(t));
  if (std::abs(side.at(h)) > 64 * forms_.side_error(s)) return false;
  if (crowded_ != nullptr)
    return crowded_->turn.on_line(s, TurningForms::start(t)) && crowded_->turn.on_line(s, forms_.end(t));
  const int chart = angles[now_].chart;
  if (s.side == t.side ? !forms_.parallel(s, t) : signs_now().sign(forms_.exact_cross(s, t, chart)) != 0) return false;
  return signs_now().sign(forms_.exact_side(s, TurningForms::start(t), chart)) == 0;
}

}  // namespace dymsum::planar
