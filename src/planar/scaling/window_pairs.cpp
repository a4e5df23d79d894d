// Pair finding: which pieces of a window may meet, and when they cross.
#include <algorithm>
#include <cmath>

#include "planar/scaling/window.h"

namespace dymsum::planar {

namespace {

/// The live cells that each piece's sweep comes near: [first[i], first[i + 1]) of `cells`; and the pieces of each cell in order:
/// [start[c], start[c + 1]) of `inside`.
struct PieceCells {
  std::vector<std::uint32_t> cells, first, start, inside;
};

PieceCells cells_of(const std::vector<PieceEnds>& ends, const SweptMask& mask) {
  const Grid& g = mask.grid();
  const std::uint32_t n = static_cast<std::uint32_t>(ends.size()), columns = static_cast<std::uint32_t>(g.columns);
  PieceCells of;
  of.first.assign(n + 1, 0);
  of.start.assign(std::size_t(g.rows) * columns + 1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const PieceEnds& e = ends[i];
    const double x[4] = {e.ax[0], e.bx[0], e.bx[1], e.ax[1]}, y[4] = {e.ay[0], e.by[0], e.by[1], e.ay[1]};
    for_each_swept_run(g, x, y, 4 * kReach * g.cell, [&](int row, int first, int last) {
      for (int c = first; c <= last; ++c) {
        if (mask.dead(row, c)) continue;
        const std::uint32_t cell = static_cast<std::uint32_t>(row) * columns + static_cast<std::uint32_t>(c);
        of.cells.push_back(cell);
        ++of.start[cell + 1];
      }
    });
    of.first[i + 1] = static_cast<std::uint32_t>(of.cells.size());
  }
  for (std::size_t c = 1; c < of.start.size(); ++c) of.start[c] += of.start[c - 1];
  of.inside.resize(of.cells.size());
  std::vector<std::uint32_t> at(of.start.begin(), of.start.end() - 1);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = of.first[i]; k < of.first[i + 1]; ++k) of.inside[at[of.cells[k]]++] = i;
  return of;
}

/// Doubles prove at both ends of the window that one piece stays on one side of the other's line; sides are linear in tau.
bool apart(const PieceEnds& line, const PieceEnds& e) {
  const double dx = line.dx, dy = line.dy;
  const double o1 = dx * (e.ay[0] - line.ay[0]) - dy * (e.ax[0] - line.ax[0]);
  const double o2 = dx * (e.by[0] - line.ay[0]) - dy * (e.bx[0] - line.ax[0]);
  const double o3 = dx * (e.ay[1] - line.ay[1]) - dy * (e.ax[1] - line.ax[1]);
  const double o4 = dx * (e.by[1] - line.ay[1]) - dy * (e.bx[1] - line.ax[1]);
  return (o1 > line.error && o2 > line.error && o3 > line.error && o4 > line.error) ||
         (o1 < -line.error && o2 < -line.error && o3 < -line.error && o4 < -line.error);
}

/// Between the vectors u and v of two pieces: the double of their cross product and its error.
struct Product {
  double value, error;
};
Product product(const LiveSegment& a, const LiveSegment& b) {
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  return {u - v, 0x1p-50 * (std::abs(u) + std::abs(v)) + 0x1p-1000};
}

// Narrows the interval of scales at which g(tau) = a + b tau > 0, where g is known up to `error`. False when it is certainly empty. Sets
// `unsure` when doubles know nothing of g in the whole window.
bool narrow(const Linear& g, double error, double tau0, double tau1, Candidate& c, bool& unsure) {
  const double g0 = g.at(tau0), g1 = g.at(tau1);
  if (g0 > error && g1 > error) return true;
  if (g0 < -error && g1 < -error) return false;
  const double slack = 0x1p-50 * tau1;
  if (g.b == 0 || (std::abs(g0) <= error && std::abs(g1) <= error)) {
    c.in_low = INFINITY;  // exact signs decide at every scale
    unsure = true;
    return true;
  }
  // Beyond these values the sign is certain; the division and tau itself are rounded.
  const double root = -g.a / g.b, wide = error / std::abs(g.b) * (1 + 0x1p-40) + 0x1p-49 * std::abs(root) + slack;
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

void Window::find_candidates(const SweptMask& mask) {
  const PieceCells of = cells_of(ends_, mask);
  const std::uint32_t n = static_cast<std::uint32_t>(pieces.size());
  std::vector<std::uint32_t> stamp(n, kNone);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = of.first[i]; k < of.first[i + 1]; ++k)
      // Pieces of a cell are in order: only those behind i, each once.
      for (std::uint32_t q = of.start[of.cells[k] + 1]; q-- > of.start[of.cells[k]] && of.inside[q] > i;) {
        const std::uint32_t j = of.inside[q];
        if (stamp[j] == i) continue;
        stamp[j] = i;
        ++pair_tests;
        if (!apart(ends_[i], ends_[j]) && !apart(ends_[j], ends_[i])) test(i, j);
      }
}

void Window::test(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  if (si == sj) return;
  const LiveSegment &a = segments[si], &b = segments[sj];
  const int sign = cross(si, sj);
  if (a.end == b.start || b.end == a.start || a.start == b.start || a.end == b.end) {
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
  if (!(c.error_a < 0x1p-8 && c.error_b < 0x1p-8)) {
    c.in_low = INFINITY;  // nearly parallel: exact signs decide at every scale
    candidates.push_back(c);
    return;
  }
  std::array<bool, 2> at_a{}, at_b{};
  if (!bounds(i, c.ta, c.error_a, c, at_a) || !bounds(j, c.tb, c.error_b, c, at_b)) return;
  if (c.out_high <= frame_.tau0 || c.out_low >= frame_.tau1) return;
  // An end of one on the line of the other, throughout the window as far as doubles tell: at every scale?
  if ((at_a[0] || at_a[1] || at_b[0] || at_b[1]) && touch_always(c, at_a, at_b)) return;
  candidates.push_back(c);
}

// Parallel pieces can touch where their lines coincide.
void Window::test_parallel(Candidate c) {
  const LiveSegment &a = segments[pieces[c.a].segment], &b = segments[pieces[c.b].segment];
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  const Linear h{wx.a * a.dy - wy.a * a.dx, wx.b * a.dy - wy.b * a.dx};
  const double error = kWindowSide * span_ * (std::abs(a.dx) + std::abs(a.dy)), h0 = h.at(frame_.tau0), h1 = h.at(frame_.tau1);
  if ((h0 > error && h1 > error) || (h0 < -error && h1 < -error)) return;
  const bool close = std::abs(h0) <= error && std::abs(h1) <= error;
  if (close && always_on(pieces[c.a].segment, exact(b.start))) return touch_parallel(c.a, c.b);
  c.in_low = INFINITY;
  if (h.b != 0 && !close) {
    const double root = -h.a / h.b, wide = error / std::abs(h.b) * (1 + 0x1p-40) + 0x1p-49 * std::abs(root) + 0x1p-50 * frame_.tau1;
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
  // Errors of the numerator, of the denominator relative to it, and of the three roundings here; values within the pieces are at most
  // max(1, tau1), and outside twice that a wrong value cannot become a right one as long as d is known to a quarter.
  const double size = kWindowSide * span_, relative = d.error / std::abs(d.value), reach = 2 * std::max(1.0, frame_.tau1);
  if (!(relative < 0.25)) return;
  c.error_a = 2 * (size * (std::abs(b.dx) + std::abs(b.dy)) / std::abs(d.value) + reach * relative) + 0x1p-48 * reach;
  c.error_b = 2 * (size * (std::abs(a.dx) + std::abs(a.dy)) / std::abs(d.value) + reach * relative) + 0x1p-48 * reach;
}

bool Window::bounds(std::uint32_t piece, const Linear& t, double error, Candidate& c, std::array<bool, 2>& unsure) const {
  const Piece& p = pieces[piece];
  const double tau0 = frame_.tau0, tau1 = frame_.tau1;
  const bool head = p.head_cut ? narrow_at_cut({t.a - p.head.a, t.b - p.head.b}, tau0, tau1, c) : narrow(t, error, tau0, tau1, c, unsure[0]);
  if (!head) return false;
  if (p.tail_cut) return narrow_at_cut({p.tail.a - t.a, p.tail.b - t.b}, tau0, tau1, c);
  return narrow(segments[p.segment].moving ? Linear{-t.a, 1 - t.b} : Linear{1 - t.a, -t.b}, error, tau0, tau1, c, unsure[1]);
}

}  // namespace dymsum::planar
