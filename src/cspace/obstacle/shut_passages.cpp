// Passages that are shut at one angle only: both walls come onto one line there, or a loop shrinks to a point, and they
// part again. Touching is no connection, so what lies before that angle and what lies behind it are two.
#include <algorithm>
#include <cmath>

#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {

// A node's stretch on its line at the event's angle, in shares of the length of the first one's segment, from that
// one's start.
std::array<double, 3> ObstacleSweep::stretch_now(std::uint32_t on, std::uint32_t n, Heading h) const {
  const WalkSegment &line = nodes_[on].segment, &s = nodes_[n].segment;
  const Point d = forms_.direction(line, h), base = forms_.place(TurningForms::start(line), h);
  const Point from = forms_.place(TurningForms::start(s), h), e = forms_.direction(s, h);
  const double length = std::hypot(d.x, d.y);
  double error = 0x1p-40 * forms_.span();
  const auto along = [&](bool at_start) {
    const Located at = place_on(forms_, s, segment_of(at_start ? nodes_[n].left : nodes_[n].right), at_start, h);
    error += std::isnan(at.error) ? INFINITY : at.error * forms_.length1(s);
    const double u = std::clamp(at.t, 0.0, 1.0);
    return (d.x * (from.x + u * e.x - base.x) + d.y * (from.y + u * e.y - base.y)) / length;
  };
  const double first = along(true), last = along(false);
  return {std::min(first, last), std::max(first, last), error};
}

ObstacleSweep::Lines ObstacleSweep::lines_of(const std::vector<std::uint32_t>& nodes) const {
  const Heading h = Heading::of(theta_now_);
  Lines lines;
  for (const std::uint32_t n : nodes) lines.emplace_back(line_offset(n, h), n);
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Walls of the other direction on the line of a node.
std::vector<std::uint32_t> ObstacleSweep::opposite_walls(std::uint32_t n, const Lines& side, Heading h) const {
  // Turned round, a line has the opposite offset.
  const double offset = line_offset(n, h), near = kLineNear * forms_.span();
  const WalkSegment& s = nodes_[n].segment;
  const Point d = forms_.direction(s, h);
  std::vector<std::uint32_t> opposite;
  const auto first = std::lower_bound(side.begin(), side.end(), std::pair{-offset - near, std::uint32_t{0}});
  for (auto m = first; m != side.end() && m->first <= -offset + near; ++m) {
    const WalkSegment& t = nodes_[m->second].segment;
    const Point e = forms_.direction(t, h);
    if (d.x * e.x + d.y * e.y < 0 && collinear(s, t, h)) opposite.push_back(m->second);
  }
  return opposite;
}

// Whether nothing of the stretch that nodes of one line share borders on a face at the angle: it has no length, or
// walls of the other direction cover it, which are those of `side`, of one side of the angle. (What is covered from
// before is covered at the angle, hence from behind.) In doubles where they leave a gap that is certain, else exactly.
bool ObstacleSweep::shut_now(const std::vector<std::uint32_t>& nodes, const Lines& side) const {
  const Heading h = Heading::of(theta_now_);
  const std::uint32_t n = nodes[0];
  const std::vector<std::uint32_t> opposite = opposite_walls(n, side, h);
  double low = -INFINITY, high = INFINITY, error = 0;
  for (const std::uint32_t m : nodes) {
    const auto [from, to, off] = stretch_now(n, m, h);
    low = std::max(low, from);
    high = std::min(high, to);
    error += off;
  }
  if (opposite.empty() && high - low > 2 * error) return false;
  double reach = low, errors = error;
  std::vector<std::array<double, 3>> stretches;
  for (const std::uint32_t m : opposite) stretches.push_back(stretch_now(n, m, h));
  std::sort(stretches.begin(), stretches.end());
  for (const auto& [from, to, off] : stretches) {
    errors = std::max(errors, error + off);
    if (from <= reach + 2 * errors) reach = std::max(reach, to);
  }
  if (high - reach > 2 * errors) return false;
  const WalkSegment& line = nodes_[n].segment;
  const SignsAt& signs = signs_now();
  std::optional<Fraction> at, end;
  for (const std::uint32_t m : nodes) {
    const std::optional<Fraction> from = end_along(signs, line, sub_edge(m), false),
                                  to = end_along(signs, line, sub_edge(m), true);
    if (!from || !to) return false;
    if (!at || signs.compare(*from, *at) > 0) at = from;
    if (!end || signs.compare(*to, *end) < 0) end = to;
  }
  for (bool grown = true; grown && signs.compare(*at, *end) < 0;) {
    grown = false;
    for (const std::uint32_t m : opposite) {
      const std::optional<Fraction> to = end_along(signs, line, sub_edge(m), false),
                                    from = end_along(signs, line, sub_edge(m), true);
      if (!to || !from || signs.compare(*from, *at) > 0 || signs.compare(*to, *at) <= 0) continue;
      at = to;
      grown = true;
    }
  }
  return signs.compare(*at, *end) >= 0;
}

}  // namespace dymsum::planar
