// Pair finding: which pieces of a window may meet, and when they cross.
#include <algorithm>
#include <cmath>

#include "planar/scaling/edge_search.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

namespace {

/// Crossings known worse than this are left to exact signs at every scale. Any value is right.
constexpr double kKnownShare = 0x1p-8;

/// What a piece sweeps lies in its box, some of a cell wider than it.
struct PieceBox {
  double x0, x1, y0, y1;
  int column0, column1, row0, row1;  ///< of the mask
  std::uint32_t piece, first_strip, last_strip;
};

std::vector<PieceBox> boxes_of(const std::vector<PieceEnds>& ends, const Grid& g) {
  const double reach = 4 * kReach * g.cell;
  std::vector<PieceBox> boxes;
  boxes.reserve(ends.size());
  for (const PieceEnds& e : ends) {
    const Two x_low = least(e.ax, e.bx), x_high = most(e.ax, e.bx), y_low = least(e.ay, e.by),
              y_high = most(e.ay, e.by);
    const double x0 = std::min(x_low[0], x_low[1]) - reach, x1 = std::max(x_high[0], x_high[1]) + reach;
    const double y0 = std::min(y_low[0], y_low[1]) - reach, y1 = std::max(y_high[0], y_high[1]) + reach;
    boxes.push_back({x0, x1, y0, y1, g.column(x0), g.column(x1), g.row(y0), g.row(y1),
                     static_cast<std::uint32_t>(boxes.size()), 0, 0});
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const PieceBox& a, const PieceBox& b) { return a.x0 != b.x0 ? a.x0 < b.x0 : a.piece < b.piece; });
  return boxes;
}

/// Calls f(box, box) once for each pair of boxes that meet, until it returns false: a sweep in x in each of some
/// horizontal strips, twice as high as a box on the average. A pair belongs to the strip in which the higher one of the
/// two begins.
template <class F>
void for_each_close_pair(const std::vector<PieceEnds>& ends, const Grid& g, F&& f) {
  if (ends.empty()) return;
  std::vector<PieceBox> boxes = boxes_of(ends, g);
  double bottom = INFINITY, top = -INFINITY, total = 0;
  for (const PieceBox& b : boxes) {
    bottom = std::min(bottom, b.y0);
    top = std::max(top, b.y1);
    total += b.y1 - b.y0;
  }
  const double height = std::max(2 * total / static_cast<double>(boxes.size()), (top - bottom) / 4096);
  const auto strip = [&](double y) { return static_cast<std::uint32_t>((y - bottom) / height); };
  std::vector<std::uint32_t> start(strip(top) + 2, 0);
  for (PieceBox& b : boxes) {
    b.first_strip = strip(b.y0);
    b.last_strip = strip(b.y1);
    for (std::uint32_t s = b.first_strip; s <= b.last_strip; ++s) ++start[s + 1];
  }
  for (std::size_t s = 1; s < start.size(); ++s) start[s] += start[s - 1];
  std::vector<PieceBox> inside(start.back());
  std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
  for (const PieceBox& b : boxes)
    for (std::uint32_t s = b.first_strip; s <= b.last_strip; ++s) inside[at[s]++] = b;
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s + 1 < start.size(); ++s)
    for (std::uint32_t i = start[s]; i < start[s + 1]; ++i) {
      const PieceBox a = inside[i];
      // Half of them meet, which no processor foresees: they are collected without a branch.
      found.resize(std::max<std::size_t>(found.size(), start[s + 1] - i));
      std::size_t n = 0;
      for (std::uint32_t j = i + 1; j < start[s + 1] && inside[j].x0 <= a.x1; ++j) {
        const PieceBox& b = inside[j];
        found[n] = j;
        n += (b.y0 <= a.y1) & (b.y1 >= a.y0) & (std::max(a.first_strip, b.first_strip) == s);
      }
      for (std::size_t k = 0; k < n; ++k)
        if (!f(a, inside[found[k]])) return;
    }
}

/// Doubles prove at both ends of the window that one piece stays on one side of the other's line; sides are linear in
/// tau.
bool apart(const PieceEnds& line, const PieceEnds& e) {
  const Two dx = both(line.dx), dy = both(line.dy);
  const Two u = dx * (e.ay - line.ay) - dy * (e.ax - line.ax), v = dx * (e.by - line.ay) - dy * (e.bx - line.ax);
  const Two error = both(line.error);
  return (every(u > error) && every(v > error)) || (every(u < -error) && every(v < -error));
}

/// Between the vectors u and v of two pieces: the double of their cross product and its error.
struct Product {
  double value, error;
};
Product product(const LiveSegment& a, const LiveSegment& b) {
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  return {u - v, kEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow};
}

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

// Pieces meet in what their boxes share; where all of that is dead nothing matters.
bool Window::find_candidates(const SweptMask& mask, const WindowSettings& settings) {
  PiecePairs close;
  for_each_close_pair(ends_, mask.grid(), [&](const PieceBox& a, const PieceBox& b) {
    if (mask.live(std::max(a.row0, b.row0), b.column0, std::min(a.row1, b.row1), std::min(a.column1, b.column1)) == 0)
      return true;
    if (++pair_tests > settings.most_pairs) return false;
    const std::uint32_t i = std::min(a.piece, b.piece), j = std::max(a.piece, b.piece);
    if (pieces[i].segment != pieces[j].segment && !apart(ends_[i], ends_[j]) && !apart(ends_[j], ends_[i]))
      close.push_back({i, j});
    return true;
  });
  if (pair_tests > settings.most_pairs) return false;
  share_lines(close);
  EdgeSearch search(*this);
  for (const auto& [i, j] : close) test(i, j, mask, settings.covers ? &search : nullptr);
  return true;
}

void Window::test(std::uint32_t i, std::uint32_t j, const SweptMask& mask, EdgeSearch* search) {
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  const LiveSegment &a = segments[si], &b = segments[sj];
  const int sign = cross(si, sj);
  const WalkPair end_a = end_pair(pieces[i]), end_b = end_pair(pieces[j]);
  if (a.end == b.start || b.end == a.start || a.start == b.start || a.end == b.end || end_a == b.start ||
      end_b == a.start || end_a == end_b) {
    // They meet in the common end only, at every scale, unless they fold back onto each other.
    if (sign != 0) return;
    const bool same_way = base_.lattice->dot(exact(si).edge, exact(sj).edge) > 0;
    if (same_way == (a.start == b.start || a.end == b.end)) folds.push_back({si, sj});
    return;
  }
  Candidate c{};
  c.a = i;
  c.b = j;
  c.sign = sign;
  c.out_low = c.in_low = -INFINITY;
  c.out_high = c.in_high = INFINITY;
  c.error_a = c.error_b = INFINITY;
  if (sign == 0) return test_parallel(c);
  solve(c);
  if (!(c.error_a < kKnownShare && c.error_b < kKnownShare)) {
    c.in_low = INFINITY;  // nearly parallel: exact signs decide at every scale
    candidates.push_back(c);
    return;
  }
  std::array<bool, 2> at_a{}, at_b{};
  if (!bounds(i, c.ta, c.error_a, c, at_a) || !bounds(j, c.tb, c.error_b, c, at_b)) return;
  if (c.out_high <= frame_.tau0 || c.out_low >= frame_.tau1) return;
  // An end of one on the line of the other, throughout the window as far as doubles tell: at every scale?
  if ((at_a[0] || at_a[1] || at_b[0] || at_b[1]) && touch_always(c, at_a, at_b)) return;
  if (!dead_throughout(c, mask) && (search == nullptr || !covered_throughout(c, *search))) candidates.push_back(c);
}

// Crossings move along a line: those that do so in dead cells only are left out. Boundaries end at crossings on the
// boundary, so what passes the place of one in a dead cell is false on both sides of it.
bool Window::dead_throughout(const Candidate& c, const SweptMask& mask) const {
  const LiveSegment& a = segments[pieces[c.a].segment];
  const Grid& g = mask.grid();
  const double reach = 4 * kReach * g.cell + c.error_a * std::max(std::abs(a.dx), std::abs(a.dy));
  double x[2], y[2];
  for (int k = 0; k < 2; ++k) {
    const double tau = k == 0 ? std::max(c.out_low, frame_.tau0) : std::min(c.out_high, frame_.tau1), t = c.ta.at(tau);
    x[k] = a.x.at(tau) + t * a.dx + swept_.shift_x(tau);
    y[k] = a.y.at(tau) + t * a.dy + swept_.shift_y(tau);
  }
  return mask.live(g.row(std::min(y[0], y[1]) - reach), g.column(std::min(x[0], x[1]) - reach),
                   g.row(std::max(y[0], y[1]) + reach), g.column(std::max(x[0], x[1]) + reach)) == 0;
}

// The same where two edges cross there all the while (edge_search.h).
bool Window::covered_throughout(const Candidate& c, EdgeSearch& search) const {
  const LiveSegment& a = segments[pieces[c.a].segment];
  const auto at = [&](double tau) {
    const double t = c.ta.at(tau), t_error = c.error_a + kShare * std::max(1.0, tau);
    return EdgeSearch::Place{a.x.at(tau) + t * a.dx, a.y.at(tau) + t * a.dy,
                             t_error * std::max(std::abs(a.dx), std::abs(a.dy)) + kWindowPoint * span_, tau};
  };
  return search.find_or_spare(at(std::max(c.out_low, swept_.tau0)), at(std::min(c.out_high, swept_.tau1))).has_value();
}

// Parallel pieces can touch where their lines coincide.
void Window::test_parallel(Candidate c) {
  const LiveSegment &a = segments[pieces[c.a].segment], &b = segments[pieces[c.b].segment];
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  const Linear h{wx.a * a.dy - wy.a * a.dx, wx.b * a.dy - wy.b * a.dx};
  const double error = kWindowSide * span_ * (std::abs(a.dx) + std::abs(a.dy)), h0 = h.at(frame_.tau0),
               h1 = h.at(frame_.tau1);
  if ((h0 > error && h1 > error) || (h0 < -error && h1 < -error)) return;
  const bool close = std::abs(h0) <= error && std::abs(h1) <= error;
  if (close && always_on(pieces[c.a].segment, exact(b.start))) return touch_parallel(c.a, c.b);
  c.in_low = INFINITY;
  if (h.b != 0 && !close) {
    const double root = -h.a / h.b, wide = root_error(root, h.b, error, frame_.tau1);
    c.out_low = root - wide;
    c.out_high = root + wide;
  }
  candidates.push_back(c);
}

// Where two lines that are not parallel meet, on each of them; errors stay infinite where doubles know too little.
void Window::solve(Candidate& c) const {
  const LiveSegment &a = segments[pieces[c.a].segment], &b = segments[pieces[c.b].segment];
  const Product d = product(a, b);
  if (!(std::abs(d.value) > d.error)) return;
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  c.ta = {(wx.a * b.dy - wy.a * b.dx) / d.value, (wx.b * b.dy - wy.b * b.dx) / d.value};
  c.tb = {(wx.a * a.dy - wy.a * a.dx) / d.value, (wx.b * a.dy - wy.b * a.dx) / d.value};
  // Shares within the pieces are at most max(1, tau1).
  const double size = kWindowSide * span_, relative = d.error / std::abs(d.value),
               reach = 2 * std::max(1.0, frame_.tau1);
  if (!(relative < kKnownDenominator)) return;
  c.error_a = share_error(size * (std::abs(b.dx) + std::abs(b.dy)), std::abs(d.value), relative, reach);
  c.error_b = share_error(size * (std::abs(a.dx) + std::abs(a.dy)), std::abs(d.value), relative, reach);
}

bool Window::bounds(std::uint32_t piece, const Linear& t, double error, Candidate& c,
                    std::array<bool, 2>& unsure) const {
  const Piece& p = pieces[piece];
  const double tau0 = frame_.tau0, tau1 = frame_.tau1;
  const bool head = p.head_cut ? narrow_at_cut({t.a - p.head.a, t.b - p.head.b}, tau0, tau1, c)
                               : narrow(t, error, tau0, tau1, c, unsure[0]);
  if (!head) return false;
  const Linear end = end_place(p), rest{end.a - t.a, end.b - t.b};
  if (p.tail_cut) return narrow_at_cut(rest, tau0, tau1, c);
  return narrow(rest, error + p.tail_error, tau0, tau1, c, unsure[1]);
}

}  // namespace dymsum::planar
