// Segments that lie along each other, the same way, at every scale: where several cover a place, one goes on and the
// others stop there.
//
// Of two such pieces one covers the other, or the one that ends first is handed on to the other where that begins. Each
// place stays covered: of the pieces through it take the one that ends last (of those the one that begins first); what
// stops it there would have to end later. Orders have to be certain throughout the window; where they are not, both
// pieces stay as they are.
#include <algorithm>
#include <cmath>
#include <optional>

#include "planar/scaling/window.h"

namespace dymsum::planar {

// Whether two pieces lie on one line at every scale, the same way.
bool Window::along_always(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  const LiveSegment &a = segments[si], &b = segments[sj];
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  if (std::abs(u - v) > kEdgeCross * (std::abs(u) + std::abs(v)) || a.dx * b.dx + a.dy * b.dy < 0) return false;
  const double error = kWindowSide * span_ * (std::abs(a.dx) + std::abs(a.dy));
  for (const double tau : {frame_.tau0, frame_.tau1}) {
    const double side = (b.x.at(tau) - a.x.at(tau)) * a.dy - (b.y.at(tau) - a.y.at(tau)) * a.dx;
    if (std::abs(side) > error) return false;
  }
  return cross(si, sj) == 0 && always_on(si, exact(b.start));
}

double Window::error_along(std::uint32_t piece) const {
  const LiveSegment& on = segments[pieces[piece].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  return 4 * kWindowSide * span_ * (std::abs(on.dx) + std::abs(on.dy)) / length +
         kProjectionGap * std::max(1.0, frame_.tau1);
}

// Where another piece on the same line begins and ends, in multiples of this one's edge vector. Requires: neither has
// been handed on.
std::array<Linear, 2> Window::ends_on(std::uint32_t piece, std::uint32_t other) const {
  const LiveSegment &on = segments[pieces[piece].segment], &s = segments[pieces[other].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  const auto place = [&](const Linear& t) {
    const double ax = s.x.a + t.a * s.dx - on.x.a, ay = s.y.a + t.a * s.dy - on.y.a, bx = s.x.b + t.b * s.dx - on.x.b,
                 by = s.y.b + t.b * s.dy - on.y.b;
    return Linear{(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length};
  };
  return {place(pieces[other].head_cut ? pieces[other].head : Linear{}), place(end_place(pieces[other]))};
}

// Linear in tau: what holds at both ends of the window holds throughout.
bool Window::certainly_before(const Linear& a, const Linear& b, double error) const {
  return b.at(frame_.tau0) - a.at(frame_.tau0) > error && b.at(frame_.tau1) - a.at(frame_.tau1) > error;
}

// Whether piece i covers piece j throughout the window; of two that are equal the first one does.
bool Window::covers(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = pieces[i], &b = pieces[j];
  const auto [start, end] = ends_on(i, j);
  const double error = error_along(i);
  const bool same_start = !a.head_cut && !b.head_cut && segments[a.segment].start == segments[b.segment].start;
  const bool same_end = !a.tail_cut && !b.tail_cut && segments[a.segment].end == segments[b.segment].end;
  if (same_start && same_end) return i < j;
  return (same_start || certainly_before(a.head_cut ? a.head : Linear{}, start, error)) &&
         (same_end || certainly_before(end, end_place(a), error));
}

// Where piece i ends if j begins inside it and ends behind it throughout the window: there.
std::optional<Linear> Window::begins_inside(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = pieces[i], &b = pieces[j];
  if (a.tail_cut || b.head_cut) return std::nullopt;
  const auto [from, to] = ends_on(i, j);
  const Linear start = a.head_cut ? a.head : Linear{}, end = end_place(a);
  const double error = error_along(i);
  if (!certainly_before(start, from, error) || !certainly_before(from, end, error) || !certainly_before(end, to, error))
    return std::nullopt;
  return from;
}

// Settles the pairs that lie along each other; what stays open stays in `close`. What stops counting still has to be
// known where something touches at one scale.
void Window::share_lines(PiecePairs& close) {
  PiecePairs along;
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const bool is = along_always(pair[0], pair[1]);
    if (is) along.push_back(pair);
    return is;
  });
  if (along.empty()) return;
  for (const auto& [i, j] : along) {
    touching.push_back({pieces[i].segment, pieces[j].segment});
    if (covers(i, j)) pieces[j].covered = true;
    else if (covers(j, i)) pieces[i].covered = true;
  }
  std::vector<Stop> stops;
  for (const auto& [i, j] : along) {
    if (pieces[i].covered || pieces[j].covered) continue;
    if (const auto place = begins_inside(i, j)) stops.push_back({i, j, *place});
    else if (const auto other = begins_inside(j, i)) stops.push_back({j, i, *other});
    else close.push_back({i, j});
  }
  hand_on(stops, close);
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const Piece &a = pieces[pair[0]], &b = pieces[pair[1]];
    if (a.covered || b.covered || a.handed_on || b.handed_on) touching.push_back({a.segment, b.segment});
    return a.covered || b.covered;
  });
}

// Each piece ends at the first of its stops. Where it is not certain which one is first, any will do, and the others
// stay open.
void Window::hand_on(const std::vector<Stop>& stops, PiecePairs& close) {
  for (const Stop& s : stops) {
    Piece& p = pieces[s.piece];
    const double error = error_along(s.piece);
    if (p.handed_on && !certainly_before(s.place, p.tail, error)) continue;
    p.handed_on = true;
    p.tail = s.place;
    p.tail_error = error;
    p.tail_at = segments[pieces[s.at].segment].start;
  }
  for (const Stop& s : stops) {
    const Piece& p = pieces[s.piece];
    if (p.tail_at == segments[pieces[s.at].segment].start || certainly_before(p.tail, s.place, p.tail_error)) continue;
    close.push_back({std::min(s.piece, s.at), std::max(s.piece, s.at)});
  }
}

}  // namespace dymsum::planar
