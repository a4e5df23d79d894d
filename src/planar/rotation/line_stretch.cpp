// What goes on along one line behind an event: a sub-edge that ends there and one that begins have a stretch in common. Exact at the event's
// angle, which is algebraic.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planar/rotation/obstacle_sweep.h"
#include "planar/rotation/walk_numbers.h"

namespace dymsum::planar {

using exact::Polynomial;

int ObstacleSweep::sign_now(const exact::Polynomial& p) const { return p.is_zero() ? 0 : exact::sign_at(angles[now_].t, p); }

// Where a node begins or ends along the line of s, times |d_s|^2: the start of its segment and a share of its vector, which is a crossing's
// side / cross. Where the crossing line runs along this one at the angle, both are zero and their derivatives tell the limit.
std::optional<Fraction> ObstacleSweep::place_along(const WalkSegment& s, std::uint32_t n, bool at_end) const {
  const int chart = angles[now_].chart;
  const Node& node = nodes_[n];
  const WalkSegment &t = node.segment, by = segment_of(at_end ? node.right : node.left);
  const Pair start = TurningForms::start(t), end = forms_.end(t);
  const Polynomial one(std::vector<exact::Big>{exact::Big(exact::BigInteger(1))});
  if (at_end && meet_at_ends(forms_, t, by)) return Fraction{forms_.exact_along(s, TurningForms::start(s), end, chart), one};
  const Polynomial base = forms_.exact_along(s, TurningForms::start(s), start, chart);
  if (!at_end && meet_at_ends(forms_, by, t)) return Fraction{base, one};
  Polynomial side = forms_.exact_side(by, start, chart), cross = forms_.exact_cross(t, by, chart);
  if (sign_now(cross) == 0) {
    if (sign_now(side) != 0) return std::nullopt;
    side = side.derivative();
    cross = cross.derivative();
    if (sign_now(cross) == 0) return std::nullopt;
  }
  return Fraction{sum_of(product(base, cross), product(side, forms_.exact_along(s, start, end, chart)), 1), cross};
}

int ObstacleSweep::compare_now(const Fraction& x, const Fraction& y) const {
  return sign_now(sum_of(product(x.num, y.den), product(y.num, x.den), -1)) * sign_now(x.den) * sign_now(y.den);
}

double ObstacleSweep::line_offset(std::uint32_t n, Heading h) const {
  const Point d = forms_.direction(nodes_[n].segment, h), from = forms_.place(TurningForms::start(nodes_[n].segment), h);
  return (d.x * from.y - d.y * from.x) / std::hypot(d.x, d.y);
}

// All pairs of an ended node and a new one that continues it. Their lines have one offset: nodes are looked up by it.
std::vector<std::pair<std::uint32_t, std::uint32_t>> ObstacleSweep::continued_stretches(const std::vector<std::uint32_t>& ended,
                                                                                        const std::vector<std::uint32_t>& fresh) const {
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
    const Located at = place_on(node.segment, segment_of(at_end ? node.right : node.left), !at_end, h);
    error += std::isnan(at.error) ? INFINITY : at.error * forms_.length1(node.segment);
    const double u = std::clamp(at.t, 0.0, 1.0);
    return (d.x * (from.x + u * e.x - base.x) + d.y * (from.y + u * e.y - base.y)) / length;
  };
  const double low = std::max(along(n, false), along(m, false)), high = std::min(along(n, true), along(m, true));
  if (high - low > error) return true;
  if (high - low < -error) return false;
  for (const std::uint32_t end : {n, m}) {
    const std::optional<Fraction> to = place_along(s, end, true);
    for (const std::uint32_t start : {n, m}) {
      const std::optional<Fraction> from = place_along(s, start, false);
      // Lines that are parallel at every angle do not bound each other.
      if (!to || !from) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
      if (compare_now(*to, *from) <= 0) return false;
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
  if (crowded_ != nullptr) return crowded_->turn.on_line(s, TurningForms::start(t)) && crowded_->turn.on_line(s, forms_.end(t));
  const int chart = angles[now_].chart;
  if (s.side == t.side ? !forms_.parallel(s, t) : sign_now(forms_.exact_cross(s, t, chart)) != 0) return false;
  return sign_now(forms_.exact_side(s, TurningForms::start(t), chart)) == 0;
}

}  // namespace dymsum::planar
