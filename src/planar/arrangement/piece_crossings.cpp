// The sweep over pieces of segments.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box_lanes.h"
#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

// Parameters t of a and u of b are the same doubles whenever the two are compared, and pieces of a segment are
// disjoint: one pair of pieces owns a crossing. One outside covered cells lies in pieces of both by more than the
// reach.
CrossingFinder::Owned CrossingFinder::owned_by_pieces(std::uint32_t a, std::uint32_t b, double t, double u) const {
  const auto length = [&](std::uint32_t s) { return std::abs(soup_.dx(s)) + std::abs(soup_.dy(s)); };
  if (!(soup_.parameter_error(a, b) * length(a) < piece_reach_ &&
        soup_.parameter_error(b, a) * length(b) < piece_reach_))
    return Owned::unsure;
  const auto holds = [](const SegmentPiece& piece, double at) { return at >= piece.low && at <= piece.high; };
  return holds(*piece_, t) && holds(*other_piece_, u) ? Owned::yes : Owned::no;
}

void CrossingFinder::sweep(std::span<const SegmentPiece> pieces, double reach) {
  pieces_ = pieces;
  piece_reach_ = reach;
  const auto n = static_cast<std::uint32_t>(pieces.size());
  const double per_quantum = quanta_per_unit();
  Array<BoxQuanta> boxes(n, soup_.memory);
  Array<std::uint64_t> order(n, soup_.memory);
  for (std::uint32_t k = 0; k < n; ++k) {
    const SegmentPiece& piece = pieces[k];
    const SoupBox& b = soup_.boxes[piece.segment];
    const auto along = [](double from, double to, double d, double t) {
      return t == 1 ? to : std::clamp(from + t * d, std::min(from, to), std::max(from, to));
    };
    const auto at = [&](double t) { return Point{along(b.ax, b.bx, b.dx, t), along(b.ay, b.by, b.dy, t)}; };
    const Point from = at(piece.low), to = at(piece.high);
    boxes[k] = quanta({from.x, from.y, to.x, to.y, b.dx, b.dy}, per_quantum);
    order[k] = left_order(boxes[k].x0, k);
  }
  sort_by_left(order);
  const std::size_t padded = std::size_t{n} + 2 * kLanes;
  Array<std::int16_t> sides(3 * padded, soup_.memory);
  std::int16_t *x0 = sides.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::uint32_t k = 0; k < n; ++k) {
    const BoxQuanta& b = boxes[order[k] & 0xffffffff];
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  for (std::size_t k = n; k < padded; ++k) {
    x0[k] = y0[k] = std::numeric_limits<std::int16_t>::max();
    y1[k] = -1;
  }
  Array<std::uint32_t> follower(soup_.size(), soup_.memory);
  find_followers(follower.data());
  for (std::uint32_t i = 0; i < n && !stopped; ++i) {
    if (poll != nullptr && i % 256 == 255 && !(*poll)(double(i) / n)) stopped = true;
    const auto k = static_cast<std::uint32_t>(order[i]);
    const std::uint32_t s = pieces[k].segment, next = follower[s];
    const std::int16_t right = boxes[k].x1;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i];
    near_.clear();
    std::uint32_t j = i + 1;
    for (; x0[j] <= right; j += kLanes) {
      const Lanes apart = (load_lanes(y0 + j) > high) | (low > load_lanes(y1 + j));
      for (auto hits = zero_lanes(apart); hits != 0; hits &= hits - 1) {
        const auto other = static_cast<std::uint32_t>(order[j + lane_of(hits)]);
        const std::uint32_t t = pieces[other].segment;
        if (t != next && follower[t] != s && t != s) near_.push_back(other);
      }
    }
    out_.pair_tests += j - i - 1;
    meet_pieces(pieces[k], near_);
  }
  finish();
}

}  // namespace dymsum::planar
