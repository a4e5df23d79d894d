#include "planar/window/scaling_stages.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dymsum::planar {
namespace {

// Of two such pieces one covers the other, or the one that ends first is handed on to the other where that begins. Each
// position stays covered: of the pieces through it take the one that ends last (of those the one that begins first);
// what stops it there would have to end later. Orders have to be proved throughout the window; where they are not, both
// pieces stay as they are.
class SharedLines {
 public:
  SharedLines(Window& window, TouchFinder& touches) : window_(window), touches_(touches) {}
  void settle(PiecePairs& close);

 private:
  struct Stop {
    std::uint32_t piece, at;  ///< a piece, and one that begins inside it
    Linear position;
  };
  void hand_on(const std::vector<Stop>& stops, PiecePairs& close);
  bool along_always(std::uint32_t i, std::uint32_t j);
  std::array<Linear, 2> ends_on(std::uint32_t piece, std::uint32_t other) const;
  double error_along(std::uint32_t piece) const;
  bool provably_before(const Linear& a, const Linear& b, double error) const;
  bool covers(std::uint32_t i, std::uint32_t j) const;
  std::optional<Linear> begins_inside(std::uint32_t i, std::uint32_t j) const;

  Window& window_;
  TouchFinder& touches_;
};

// Whether two pieces lie on one line at every scale, the same way.
bool SharedLines::along_always(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = window_.pieces[i].segment, sj = window_.pieces[j].segment;
  const LiveSegment &a = window_.segments[si], &b = window_.segments[sj];
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  if (std::abs(u - v) > kScaledEdgeCross * (std::abs(u) + std::abs(v)) || a.dx * b.dx + a.dy * b.dy < 0) return false;
  const double error = kWindowSide * window_.span() * (std::abs(a.dx) + std::abs(a.dy));
  for (const double tau : {window_.frame().tau0, window_.frame().tau1}) {
    const double side = (b.x.at(tau) - a.x.at(tau)) * a.dy - (b.y.at(tau) - a.y.at(tau)) * a.dx;
    if (std::abs(side) > error) return false;
  }
  return window_.cross(si, sj) == 0 && touches_.always_on(si, window_.exact(b.start));
}

double SharedLines::error_along(std::uint32_t piece) const {
  const LiveSegment& on = window_.segments[window_.pieces[piece].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  return kProjectedGap * window_.span() * (std::abs(on.dx) + std::abs(on.dy)) / length +
         kProjectionGap * std::max(1.0, window_.frame().tau1);
}

// The parameters at which another piece on the same line begins and ends, in multiples of this one's edge vector.
// Requires: neither has been handed on.
std::array<Linear, 2> SharedLines::ends_on(std::uint32_t piece, std::uint32_t other) const {
  const LiveSegment &on = window_.segments[window_.pieces[piece].segment],
                    &s = window_.segments[window_.pieces[other].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  const auto position = [&](const Linear& t) {
    const double ax = s.x.a + t.a * s.dx - on.x.a, ay = s.y.a + t.a * s.dy - on.y.a, bx = s.x.b + t.b * s.dx - on.x.b,
                 by = s.y.b + t.b * s.dy - on.y.b;
    return Linear{(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length};
  };
  return {position(window_.pieces[other].head_cut ? window_.pieces[other].head : Linear{}),
          position(window_.end_position(window_.pieces[other]))};
}

// Linear in tau: what holds at both ends of the window holds throughout.
bool SharedLines::provably_before(const Linear& a, const Linear& b, double error) const {
  return b.at(window_.frame().tau0) - a.at(window_.frame().tau0) > error &&
         b.at(window_.frame().tau1) - a.at(window_.frame().tau1) > error;
}

// Whether piece i covers piece j throughout the window; of two that are equal the first one does.
bool SharedLines::covers(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = window_.pieces[i], &b = window_.pieces[j];
  const auto [start, end] = ends_on(i, j);
  const double error = error_along(i);
  const bool same_start =
      !a.head_cut && !b.head_cut && window_.segments[a.segment].start == window_.segments[b.segment].start;
  const bool same_end =
      !a.tail_cut && !b.tail_cut && window_.segments[a.segment].end == window_.segments[b.segment].end;
  if (same_start && same_end) return i < j;
  return (same_start || provably_before(a.head_cut ? a.head : Linear{}, start, error)) &&
         (same_end || provably_before(end, window_.end_position(a), error));
}

// The parameter at which piece i ends if j begins inside it and ends after it throughout the window: there.
std::optional<Linear> SharedLines::begins_inside(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = window_.pieces[i], &b = window_.pieces[j];
  if (a.tail_cut || b.head_cut) return std::nullopt;
  const auto [from, to] = ends_on(i, j);
  const Linear start = a.head_cut ? a.head : Linear{}, end = window_.end_position(a);
  const double error = error_along(i);
  if (!provably_before(start, from, error) || !provably_before(from, end, error) || !provably_before(end, to, error))
    return std::nullopt;
  return from;
}

void SharedLines::settle(PiecePairs& close) {
  PiecePairs along;
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const bool is = along_always(pair[0], pair[1]);
    if (is) along.push_back(pair);
    return is;
  });
  if (along.empty()) return;
  for (const auto& [i, j] : along) {
    window_.touching.push_back({window_.pieces[i].segment, window_.pieces[j].segment});
    if (covers(i, j)) window_.pieces[j].covered = true;
    else if (covers(j, i)) window_.pieces[i].covered = true;
  }
  std::vector<Stop> stops;
  for (const auto& [i, j] : along) {
    if (window_.pieces[i].covered || window_.pieces[j].covered) continue;
    if (const auto position = begins_inside(i, j)) stops.push_back({i, j, *position});
    else if (const auto other = begins_inside(j, i)) stops.push_back({j, i, *other});
    else close.push_back({i, j});
  }
  hand_on(stops, close);
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const Piece &a = window_.pieces[pair[0]], &b = window_.pieces[pair[1]];
    if (a.covered || b.covered || a.handed_on || b.handed_on) window_.touching.push_back({a.segment, b.segment});
    return a.covered || b.covered;
  });
}

// Each piece ends at the first of its stops. Where it is not certain which one is first, any will do, and the others
// stay open.
void SharedLines::hand_on(const std::vector<Stop>& stops, PiecePairs& close) {
  for (const Stop& s : stops) {
    Piece& p = window_.pieces[s.piece];
    const double error = error_along(s.piece);
    if (p.handed_on && !provably_before(s.position, p.tail, error)) continue;
    p.handed_on = true;
    p.tail = s.position;
    p.tail_error = error;
    p.tail_at = window_.segments[window_.pieces[s.at].segment].start;
  }
  for (const Stop& s : stops) {
    const Piece& p = window_.pieces[s.piece];
    if (p.tail_at == window_.segments[window_.pieces[s.at].segment].start ||
        provably_before(p.tail, s.position, p.tail_error))
      continue;
    close.push_back({std::min(s.piece, s.at), std::max(s.piece, s.at)});
  }
}

}  // namespace

void share_lines(Window& window, TouchFinder& touches, PiecePairs& close) {
  SharedLines(window, touches).settle(close);
}

}  // namespace dymsum::planar
