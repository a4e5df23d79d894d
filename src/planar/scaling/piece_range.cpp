#include "planar/scaling/piece_range.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

// Narrows the interval of scales at which g(tau) = a + b tau > 0, where g is known up to `error`. False when it is
// certainly empty. Sets `unsure` when doubles know nothing of g in the whole window.
bool narrow(const Linear& g, double error, double tau0, double tau1, Candidate& c, bool& unsure) {
  const double g0 = g.at(tau0), g1 = g.at(tau1);
  if (g0 > error && g1 > error) return true;
  if (g0 < -error && g1 < -error) return false;
  if (g.b == 0 || (std::abs(g0) <= error && std::abs(g1) <= error)) {
    c.in_low = INFINITY;  // exact signs decide at every scale
    unsure = true;
    return true;
  }
  // Beyond these values the sign is certain; the division and tau itself are rounded.
  const double root = -g.a / g.b, wide = root_error(root, g.b, error, tau1);
  if (g.b > 0) {
    c.out_low = std::max(c.out_low, root - wide);
    c.in_low = std::max(c.in_low, root + wide);
  } else {
    c.out_high = std::min(c.out_high, root + wide);
    c.in_high = std::min(c.in_high, root - wide);
  }
  return c.out_low < c.out_high;
}

// A cut lies in a dead cell, where nothing matters; only both pieces at it must agree: the same numbers, no error.
bool narrow_at_cut(const Linear& g, double tau0, double tau1, Candidate& c) {
  const double g0 = g.at(tau0), g1 = g.at(tau1);
  if (g0 > 0 && g1 > 0) return true;
  if (g0 <= 0 && g1 <= 0) return false;
  const double root = -g.a / g.b;
  if (g.b > 0) {
    c.out_low = std::max(c.out_low, root);
    c.in_low = std::max(c.in_low, root);
  } else {
    c.out_high = std::min(c.out_high, root);
    c.in_high = std::min(c.in_high, root);
  }
  return c.out_low < c.out_high;
}

}  // namespace

bool narrow_to_piece(const Window& window, std::uint32_t piece, const Linear& t, double error, Candidate& c,
                     std::array<bool, 2>& unsure) {
  const Piece& p = window.pieces[piece];
  const double tau0 = window.frame().tau0, tau1 = window.frame().tau1;
  const bool head = p.head_cut ? narrow_at_cut({t.a - p.head.a, t.b - p.head.b}, tau0, tau1, c)
                               : narrow(t, error, tau0, tau1, c, unsure[0]);
  if (!head) return false;
  const Linear end = window.end_place(p), rest{end.a - t.a, end.b - t.b};
  if (p.tail_cut) return narrow_at_cut(rest, tau0, tau1, c);
  return narrow(rest, error + p.tail_error, tau0, tau1, c, unsure[1]);
}

}  // namespace dymsum::planar
