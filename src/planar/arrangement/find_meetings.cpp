#include "planar/arrangement/find_meetings.h"

#include <algorithm>
#include <cmath>

#include "base/box_sweep.h"
#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

// Pairs of segments that doubles do not decide: crossings, touches and common ends, exactly.

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

// The sweep over pieces of segments.

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

namespace {

// A sweep is cheaper than filling a grid for few segments, and for more of them while each has not too many others
// above and below it: as many as widths of segments add up to that of the sum.
bool sweep_pays(const Soup& soup) {
  constexpr std::size_t kFew = 4000;
  constexpr double kBeside = 250;
  if (soup.size() < kFew) return true;
  double widths = 0;
  for (const SoupBox& b : soup.boxes) widths += std::abs(b.dx);
  return widths < kBeside * soup.lattice.span;
}

Grid plain_grid(const Lattice& lattice, std::size_t segments) {
  const double width = lattice.points[0]->width + lattice.points[1]->width;
  const double height = lattice.points[0]->height + lattice.points[1]->height;
  const double longer = std::max(width, height);
  Grid g;
  const int cells = grid_size(segments);
  g.cell = longer / cells;
  g.per_cell = cells / longer;
  g.columns = static_cast<int>(width * g.per_cell) + 1;
  g.rows = static_cast<int>(height * g.per_cell) + 1;
  return g;
}

}  // namespace

Meetings all_meetings(const Soup& soup, const Chain* chain, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder(soup, meetings, chain, &poll).all_pairs();
  return meetings;
}

Meetings every_meeting(const Soup& soup, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder finder(soup, meetings, nullptr, &poll);
  if (sweep_pays(soup)) {
    finder.sweep();
  } else {
    Array<CoveredMark> none(soup.memory);
    finder.grid(plain_grid(soup.lattice, soup.size()), nullptr, none);
  }
  return meetings;
}

MarkedMeetings open_meetings(const Soup& soup, const Chain& chain, const KnownCover& cover, const Poll& poll) {
  MarkedMeetings found{Meetings(soup.memory), Array<CoveredMark>(soup.memory)};
  CrossingFinder finder(soup, found.meetings, &chain, &poll);
  if (sweep_pays(soup)) finder.sweep(cover.mask);
  else if (cover.mask != nullptr) finder.grid(cover.mask->grid(), cover.mask, found.marks);
  else finder.grid(plain_grid(soup.lattice, soup.size()), nullptr, found.marks);
  return found;
}

Meetings piece_meetings(const Soup& soup, const Chain& chain, std::span<const SegmentPiece> pieces,
                        const FineCells& cells, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder(soup, meetings, &chain, &poll).sweep(pieces, kReach / 2 * cells.grid().cell);
  return meetings;
}

}  // namespace dymsum::planar
