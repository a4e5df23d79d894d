// Pairs of segments that doubles do not decide: crossings, touches and common ends, exactly.
#include <algorithm>
#include <cmath>

#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

void CrossingFinder::add_touch(std::uint32_t segment, WalkPair pair) {
  const SoupBox& s = soup_.boxes[segment];
  const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
  const double x = p.x[pair.p] + q.x[pair.q], y = p.y[pair.p] + q.y[pair.q];
  const double dx = soup_.dx(segment), dy = soup_.dy(segment);
  const bool by_x = std::abs(dx) > std::abs(dy);
  const double t = by_x ? (x - s.ax) / dx : (y - s.ay) / dy;
  const double error = kTouchFractions * soup_.point_error / std::max(std::abs(dx), std::abs(dy)) + kFractionRoundings;
  out_.touches.push_back({segment, pair, std::clamp(t, 0.0, 1.0), static_cast<float>(error)});
}

// The side of the line of s = `line` on which pair v, rounded (x, y), lies.
inline int CrossingFinder::side(std::uint32_t s, WalkPair v, double x, double y) {
  if (soup_.lattice.exact_doubles) {
    const SoupBox& a = soup_.boxes[s];
    const double value = soup_.dx(s) * (y - a.ay) - soup_.dy(s) * (x - a.ax);
    return (value > 0) - (value < 0);
  }
  ++out_.exact_signs;
  if (soup_.integral()) return Soup::sign(soup_.side_value(s, x, y));
  return soup_.lattice.side(soup_.exact(s), soup_.exact(v));
}

// Whether v, rounded (x, y), which lies on the line of s, lies strictly between its ends.
inline bool CrossingFinder::between(std::uint32_t s, WalkPair v, double x, double y) {
  const Lattice& l = soup_.lattice;
  if (l.exact_doubles) {
    const SoupBox& a = soup_.boxes[s];
    const double dx = soup_.dx(s), dy = soup_.dy(s);
    return dx * (x - a.ax) + dy * (y - a.ay) > 0 && dx * (x - a.bx) + dy * (y - a.by) < 0;
  }
  out_.exact_signs += 2;
  if (soup_.integral()) {
    const std::int64_t along = soup_.along_value(s, x, y);
    return along > 0 && along < soup_.length_value(s);
  }
  const Pair at = soup_.exact(v);
  const Segment line = soup_.exact(s);
  return l.along(line, at) > 0 && l.along(reversed(line), at) > 0;
}

// At least one side is zero or too small for doubles.
void CrossingFinder::exact_test(std::uint32_t i, std::uint32_t j) {
  const SoupBox &a = soup_.boxes[i], &b = soup_.boxes[j];
  const WalkPair a0 = soup_.start(i), a1 = soup_.end(i), b0 = soup_.start(j), b1 = soup_.end(j);
  const bool in_chains = i < first_unchained_ && j < first_unchained_;
  const bool chained = in_chains && (a1 == b0 || b1 == a0 || a0 == b0 || a1 == b1 ||
                                     (chain_ != nullptr && (chain_->next(i) == j || chain_->next(j) == i)));
  // Segments of one chain share an end; they meet elsewhere only when they fold back onto each other.
  if (chained && soup_.cross(i, j) != 0) return;
  const Lattice& l = soup_.lattice;
  const bool exact_sums = soup_.exact_sums();
  const auto same = [&](double x, double y, WalkPair v, double to_x, double to_y, WalkPair to) {
    if (exact_sums) return x == to_x && y == to_y;
    // Two pairs may have one sum and yet be rounded differently.
    const double near = 2 * soup_.point_error;
    return std::abs(x - to_x) <= near && std::abs(y - to_y) <= near && l.same(soup_.exact(v), soup_.exact(to));
  };
  if (same(a.ax, a.ay, a0, b.ax, b.ay, b0) && same(a.bx, a.by, a1, b.bx, b.by, b1)) {
    // The same segment twice, which is everywhere in P + P.
    if (!in_chains || !(a0 == b0)) out_.same.emplace_back(a0, b0);
    if (!in_chains || !(a1 == b1)) out_.same.emplace_back(a1, b1);
    return;
  }
  const int s1 = side(i, b0, b.ax, b.ay), s2 = side(i, b1, b.bx, b.by);
  if (s1 * s2 > 0) return;
  const int s3 = side(j, a0, a.ax, a.ay), s4 = side(j, a1, a.bx, a.by);
  if (s3 * s4 > 0) return;
  if (s1 != 0 && s2 != 0 && s3 != 0 && s4 != 0) {
    // Opposite on both: the crossing parameters come from doubles that may be smaller than their error; keep t in [0,
    // 1].
    const double a_dx = soup_.dx(i), a_dy = soup_.dy(i), b_dx = soup_.dx(j), b_dy = soup_.dy(j);
    const double o1 = a_dx * (b.ay - a.ay) - a_dy * (b.ax - a.ax), o2 = a_dx * (b.by - a.ay) - a_dy * (b.bx - a.ax);
    const double o3 = b_dx * (a.ay - b.ay) - b_dy * (a.ax - b.ax), o4 = b_dx * (a.by - b.ay) - b_dy * (a.bx - b.ax);
    out_.rough = true;
    const auto signed_magnitude = [](double o, int s, double error) {
      return s * std::max(std::abs(o), error * kLeastSide);
    };
    const double a_error = soup_.error(i), b_error = soup_.error(j);
    add_crossing(i, j, signed_magnitude(o3, s3, b_error), signed_magnitude(o4, s4, b_error),
                 signed_magnitude(o1, s1, a_error), signed_magnitude(o2, s2, a_error));
    return;
  }
  const auto within = [&](std::uint32_t s, WalkPair from, WalkPair to, WalkPair v, double x, double y) {
    // v, at (x, y), lies on the line of s: register it if it lies on s.
    const SoupBox& box = soup_.boxes[s];
    if (same(x, y, v, box.ax, box.ay, from)) {
      if (!in_chains || !(v == from)) out_.same.emplace_back(v, from);
    } else if (same(x, y, v, box.bx, box.by, to)) {
      if (!in_chains || !(v == to)) out_.same.emplace_back(v, to);
    } else if (between(s, v, x, y)) {
      add_touch(s, v);
    }
  };
  if (s1 == 0) within(i, a0, a1, b0, b.ax, b.ay);
  if (s2 == 0) within(i, a0, a1, b1, b.bx, b.by);
  if (s3 == 0) within(j, b0, b1, a0, a.ax, a.ay);
  if (s4 == 0) within(j, b0, b1, a1, a.bx, a.by);
}

}  // namespace dymsum::planar
