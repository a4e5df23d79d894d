// Passages that are shut at one angle only: both walls come onto one line there, or a loop shrinks to a point, and they part again. Touching is
// no connection, so what lies before that angle and what lies behind it are two.
#include <algorithm>
#include <cmath>

#include "planar/rotation/obstacle_sweep.h"

namespace dymsum::planar {

// A node's stretch on its line at the event's angle, in shares of the length of the first one's segment, from that one's start.
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

// Whether walls of the other direction cover all of a node's stretch. In doubles where they leave a gap that is certain, else exactly.
bool ObstacleSweep::covered_now(std::uint32_t n, const std::vector<std::uint32_t>& opposite, Heading h) const {
  const auto [low, high, error] = stretch_now(n, n, h);
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
  std::optional<Fraction> at = end_along(signs_now(), line, sub_edge(n), false);
  const std::optional<Fraction> end = end_along(signs_now(), line, sub_edge(n), true);
  if (!at || !end) return false;
  for (bool grown = true; grown && signs_now().compare(*at, *end) < 0;) {
    grown = false;
    for (const std::uint32_t m : opposite) {
      const std::optional<Fraction> to = end_along(signs_now(), line, sub_edge(m), false), from = end_along(signs_now(), line, sub_edge(m), true);
      if (!to || !from || signs_now().compare(*from, *at) > 0 || signs_now().compare(*to, *at) <= 0) continue;
      at = to;
      grown = true;
    }
  }
  return signs_now().compare(*at, *end) >= 0;
}

// Those of `nodes` of which nothing borders on a face at the angle: of no length, or with walls of shut passages all along them. `all`: the
// nodes of that side of the angle.
std::vector<std::uint32_t> ObstacleSweep::shut_nodes(const std::vector<std::uint32_t>& nodes, const std::vector<std::uint32_t>& all) const {
  if (nodes.empty()) return {};
  const Heading h = Heading::of(theta_now_);
  std::vector<std::pair<double, std::uint32_t>> lines;
  for (const std::uint32_t n : all) lines.emplace_back(line_offset(n, h), n);
  std::sort(lines.begin(), lines.end());
  std::vector<std::uint32_t> shut, opposite;
  const double near = kLineNear * forms_.span();
  for (const std::uint32_t n : nodes) {
    // Turned round, a line has the opposite offset.
    const double offset = line_offset(n, h);
    opposite.clear();
    const WalkSegment& s = nodes_[n].segment;
    const Point d = forms_.direction(s, h);
    const auto first = std::lower_bound(lines.begin(), lines.end(), std::pair{-offset - near, std::uint32_t{0}});
    for (auto m = first; m != lines.end() && m->first <= -offset + near; ++m) {
      const WalkSegment& t = nodes_[m->second].segment;
      const Point e = forms_.direction(t, h);
      if (d.x * e.x + d.y * e.y < 0 && collinear(s, t, h)) opposite.push_back(m->second);
    }
    if (covered_now(n, opposite, h)) shut.push_back(n);
  }
  std::sort(shut.begin(), shut.end());
  return shut;
}

}  // namespace dymsum::planar
