// The sweep over pieces of segments.
#include <algorithm>
#include <cmath>

#include "base/box_sweep.h"
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

// The box of a piece, with the whole segment's vector.
SoupBox CrossingFinder::box_of(const SegmentPiece& piece) const {
  const SoupBox& b = soup_.boxes[piece.segment];
  const auto along = [](double from, double to, double d, double t) {
    return t == 1 ? to : std::clamp(from + t * d, std::min(from, to), std::max(from, to));
  };
  const auto at = [&](double t) { return Point{along(b.ax, b.bx, b.dx, t), along(b.ay, b.by, b.dy, t)}; };
  const Point from = at(piece.low), to = at(piece.high);
  return {from.x, from.y, to.x, to.y, b.dx, b.dy};
}

void CrossingFinder::sweep(std::span<const SegmentPiece> pieces, double reach) {
  pieces_ = pieces;
  piece_reach_ = reach;
  const auto n = static_cast<std::uint32_t>(pieces.size());
  const double per_quantum = quanta_per_unit();
  Array<BoxQuanta> boxes(n, soup_.memory);
  for (std::uint32_t k = 0; k < n; ++k) boxes[k] = quanta(box_of(pieces[k]), per_quantum);
  Array<std::uint32_t> follower(soup_.size(), soup_.memory);
  find_followers(follower.data());
  out_.pair_tests += sweep_boxes(
      boxes, soup_.memory,
      [&](std::uint32_t k, std::uint32_t i) {
        query(i, n);
        const std::uint32_t s = pieces[k].segment;
        return [&, s, next = follower[s]](std::uint32_t other) {
          const std::uint32_t t = pieces[other].segment;
          return t != next && follower[t] != s && t != s;
        };
      },
      [&](std::uint32_t k, std::span<const std::uint32_t> others) { meet_pieces(pieces[k], others); });
  finish();
}

}  // namespace dymsum::planar
