#include "planar/scaling/window.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace dymsum::planar {

namespace {

// |d x (v - w)| computed in doubles from sums of window coordinates errs by at most this times |d|_1 span: the edge vector carries one
// rounding, a sum fixed + tau moving + shift at most six, twice, the difference, product and final difference one each.
constexpr double kSide = 0x1p-48;

}  // namespace

Window::Window(const ScalingBase& base, const ReducedConvolution& convolution, const WindowSettings& settings)
    : base_(base), frame_(settings.frame), swept_(settings.frame) {
  if (settings.shrink < 1) {
    const double middle = 0.5 * (frame_.tau0 + frame_.tau1), half = 0.5 * settings.shrink * (frame_.tau1 - frame_.tau0);
    swept_.tau0 = middle - half;
    swept_.tau1 = middle + half;
  }
  const std::uint32_t m = frame_.moving;
  span_ = std::max(base.width[1 - m], base.height[1 - m]) + 2 * frame_.tau1 * std::max(base.width[m], base.height[m]);
  const SweptMask mask(*base.lattice, base.operands, swept_, settings.cells, settings.mask);
  live.assign(convolution.size(), kNone);
  std::uint32_t id = 0;
  convolution.for_each([&](const WalkSegment& w) { add_segment(w, id++, mask); });
  add_pieces(mask);
  find_candidates(mask);
  make_nodes();
  link_pieces(convolution);
  entries_ = {};
}

Segment Window::exact(std::uint32_t s) const {
  const WalkSegment& w = segments[s].walk;
  return {base_.operands[w.side].edge(w.edge), base_.operands[1 - w.side].source[w.vertex]};
}

std::size_t Window::bytes() const {
  return segments.capacity() * sizeof(LiveSegment) + pieces.capacity() * (sizeof(Piece) + sizeof(Entry)) +
         candidates.capacity() * sizeof(Candidate) + (first_of.capacity() + of.capacity() + live.capacity()) * 4;
}

void Window::add_segment(const WalkSegment& w, std::uint32_t id, const SweptMask& mask) {
  const std::uint32_t m = frame_.moving;
  const Operand &o = base_.operands[w.side], &other = base_.operands[1 - w.side];
  const std::uint32_t a = o.source[w.edge], b = o.source[o.next[w.edge]], v = other.source[w.vertex];
  const Lattice& l = *base_.lattice;
  // The moving operand's vertices at the segment's ends; the fixed one's.
  const bool moving = w.side == m;
  const std::uint32_t move_a = moving ? a : v, move_b = moving ? b : v, rest_a = moving ? v : a, rest_b = moving ? v : b;
  const std::vector<double>&xm = l.points[m]->x, &ym = l.points[m]->y, &xf = l.points[1 - m]->x, &yf = l.points[1 - m]->y;
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const double tau : {swept_.tau0, swept_.tau1}) {
    const double sx = swept_.shift_x(tau), sy = swept_.shift_y(tau);
    const double ax = xf[rest_a] + tau * xm[move_a] + sx, bx = xf[rest_b] + tau * xm[move_b] + sx;
    const double ay = yf[rest_a] + tau * ym[move_a] + sy, by = yf[rest_b] + tau * ym[move_b] + sy;
    x0 = std::min({x0, ax, bx});
    x1 = std::max({x1, ax, bx});
    y0 = std::min({y0, ay, by});
    y1 = std::max({y1, ay, by});
  }
  const Grid& g = mask.grid();
  const double reach = 2 * kReach * g.cell;
  if (mask.live(g.row(y0 - reach), g.column(x0 - reach), g.row(y1 + reach), g.column(x1 + reach)) == 0) return;
  live[id] = static_cast<std::uint32_t>(segments.size());
  LiveSegment s;
  s.walk = w;
  s.moving = moving;
  s.x = {xf[rest_a], xm[move_a]};
  s.y = {yf[rest_a], ym[move_a]};
  s.dx = o.ex[w.edge];
  s.dy = o.ey[w.edge];
  const std::uint32_t next = o.next[w.edge];
  s.start = w.side == 0 ? WalkPair{w.edge, w.vertex} : WalkPair{w.vertex, w.edge};
  s.end = w.side == 0 ? WalkPair{next, w.vertex} : WalkPair{w.vertex, next};
  s.contact = w.side == 0 ? Contact{Contact::Kind::edge_of_p, o.edge_number[w.edge], other.vertex_number[w.vertex]}
                          : Contact{Contact::Kind::edge_of_q, other.vertex_number[w.vertex], o.edge_number[w.edge]};
  segments.push_back(s);
}

// Segments are cut inside dead cells that they meet at both ends of the window (and hence at every scale in between). The cut is the
// middle of the chord at both ends and linear in between: the chords and the cell are convex in (x, y, tau).
void Window::add_pieces(const SweptMask& mask) {
  const Grid& g = mask.grid();
  const double reach = 2 * kReach * g.cell;
  struct Cutting {
    double t0, t1;
  };
  std::vector<Cutting> cuts;
  const double width = swept_.tau1 - swept_.tau0;
  for (std::uint32_t n = 0; n < segments.size(); ++n) {
    LiveSegment& s = segments[n];
    double ax[2], ay[2], ex[2], ey[2];  // start and vector at both ends of the window
    for (int k = 0; k < 2; ++k) {
      const double tau = k == 0 ? swept_.tau0 : swept_.tau1, length = s.length(tau);
      ax[k] = s.x.at(tau) + swept_.shift_x(tau);
      ay[k] = s.y.at(tau) + swept_.shift_y(tau);
      ex[k] = s.dx * length;
      ey[k] = s.dy * length;
    }
    const double x0 = std::min({ax[0], ax[1], ax[0] + ex[0], ax[1] + ex[1]}), x1 = std::max({ax[0], ax[1], ax[0] + ex[0], ax[1] + ex[1]});
    const double y0 = std::min({ay[0], ay[1], ay[0] + ey[0], ay[1] + ey[1]}), y1 = std::max({ay[0], ay[1], ay[0] + ey[0], ay[1] + ey[1]});
    const int r0 = g.row(y0 - reach), r1 = g.row(y1 + reach), c0 = g.column(x0 - reach), c1 = g.column(x1 + reach);
    cuts.clear();
    const std::uint32_t cells = static_cast<std::uint32_t>(r1 - r0 + 1) * static_cast<std::uint32_t>(c1 - c0 + 1);
    if (mask.live(r0, c0, r1, c1) < cells)
      for_each_cell_run(g, ax[0], ay[0], ax[0] + ex[0], ay[0] + ey[0], [&](int row, int first, int last) {
        for (int c = first; c <= last; ++c) {
          if (!mask.dead(row, c)) continue;
          double middle[2];
          bool both = true;
          for (int k = 0; k < 2; ++k) {
            double t0 = 0, t1 = 1;
            const auto clip = [&](double from, double d, double low, double high) {
              if (d == 0) {
                if (from < low || from > high) t1 = -1;
                return;
              }
              const double u = (low - from) / d, v = (high - from) / d;
              t0 = std::max(t0, std::min(u, v));
              t1 = std::min(t1, std::max(u, v));
            };
            clip(ax[k], ex[k], c * g.cell, (c + 1) * g.cell);
            clip(ay[k], ey[k], row * g.cell, (row + 1) * g.cell);
            both &= t1 > t0;
            middle[k] = 0.5 * (t0 + t1);
          }
          if (both) cuts.push_back({middle[0], middle[1]});
        }
      });
    std::sort(cuts.begin(), cuts.end(), [](const Cutting& a, const Cutting& b) { return a.t0 < b.t0; });
    s.first_piece = static_cast<std::uint32_t>(pieces.size());
    const auto linear = [&](const Cutting& c) {
      const double u = c.t0 * s.length(swept_.tau0), v = c.t1 * s.length(swept_.tau1);
      const double slope = width > 0 ? (v - u) / width : 0;
      return Linear{u - slope * swept_.tau0, slope};
    };
    for (std::size_t k = 0; k <= cuts.size(); ++k) {
      const Cutting from = k == 0 ? Cutting{0, 0} : cuts[k - 1], to = k == cuts.size() ? Cutting{1, 1} : cuts[k];
      Entry e;
      const double low[2] = {from.t0, from.t1}, high[2] = {to.t0, to.t1};
      for (int q = 0; q < 2; ++q) {
        e.ax[q] = ax[q] + low[q] * ex[q];
        e.ay[q] = ay[q] + low[q] * ey[q];
        e.bx[q] = ax[q] + high[q] * ex[q];
        e.by[q] = ay[q] + high[q] * ey[q];
      }
      const double px0 = std::min({e.ax[0], e.ax[1], e.bx[0], e.bx[1]}), px1 = std::max({e.ax[0], e.ax[1], e.bx[0], e.bx[1]});
      const double py0 = std::min({e.ay[0], e.ay[1], e.by[0], e.by[1]}), py1 = std::max({e.ay[0], e.ay[1], e.by[0], e.by[1]});
      if (!cuts.empty() && mask.live(g.row(py0 - reach), g.column(px0 - reach), g.row(py1 + reach), g.column(px1 + reach)) == 0) continue;
      e.dx = s.dx;
      e.dy = s.dy;
      e.error = kSide * (std::abs(s.dx) + std::abs(s.dy)) * span_;
      Piece p;
      p.segment = n;
      p.head_cut = k > 0;
      p.tail_cut = k < cuts.size();
      if (p.head_cut) p.head = linear(from);
      if (p.tail_cut) p.tail = linear(to);
      pieces.push_back(p);
      entries_.push_back(e);
    }
    s.last_piece = static_cast<std::uint32_t>(pieces.size());
  }
}

void Window::find_candidates(const SweptMask& mask) {
  const Grid& g = mask.grid();
  const std::uint32_t n = static_cast<std::uint32_t>(pieces.size()), columns = static_cast<std::uint32_t>(g.columns);
  std::vector<std::uint32_t> cells, first_cell(n + 1, 0);  // live cells of each piece
  std::vector<std::uint32_t> start(std::size_t(g.rows) * columns + 1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Entry& e = entries_[i];
    const double x[4] = {e.ax[0], e.bx[0], e.bx[1], e.ax[1]}, y[4] = {e.ay[0], e.by[0], e.by[1], e.ay[1]};
    for_each_swept_run(g, x, y, 4 * kReach * g.cell, [&](int row, int first, int last) {
      for (int c = first; c <= last; ++c) {
        if (mask.dead(row, c)) continue;
        const std::uint32_t cell = static_cast<std::uint32_t>(row) * columns + static_cast<std::uint32_t>(c);
        cells.push_back(cell);
        ++start[cell + 1];
      }
    });
    first_cell[i + 1] = static_cast<std::uint32_t>(cells.size());
  }
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  std::vector<std::uint32_t> inside(cells.size());
  {
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = first_cell[i]; k < first_cell[i + 1]; ++k) inside[at[cells[k]]++] = i;
  }
  std::vector<std::uint32_t> stamp(n, kNone);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Entry& a = entries_[i];
    for (std::uint32_t k = first_cell[i]; k < first_cell[i + 1]; ++k)
      // Pieces of a cell are in order: only those behind i, each once.
      for (std::uint32_t q = start[cells[k] + 1]; q-- > start[cells[k]] && inside[q] > i;) {
        const std::uint32_t j = inside[q];
        if (stamp[j] == i) continue;
        stamp[j] = i;
        ++pair_tests;
        const Entry& b = entries_[j];
        const auto apart = [](const Entry& line, const Entry& e) {
          const double dx = line.dx, dy = line.dy;
          const double o1 = dx * (e.ay[0] - line.ay[0]) - dy * (e.ax[0] - line.ax[0]);
          const double o2 = dx * (e.by[0] - line.ay[0]) - dy * (e.bx[0] - line.ax[0]);
          const double o3 = dx * (e.ay[1] - line.ay[1]) - dy * (e.ax[1] - line.ax[1]);
          const double o4 = dx * (e.by[1] - line.ay[1]) - dy * (e.bx[1] - line.ax[1]);
          return (o1 > line.error && o2 > line.error && o3 > line.error && o4 > line.error) ||
                 (o1 < -line.error && o2 < -line.error && o3 < -line.error && o4 < -line.error);
        };
        if (apart(a, b) || apart(b, a)) continue;
        test(i, j);
      }
  }
}

namespace {

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

void Window::test(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  if (si == sj) return;
  const LiveSegment &a = segments[si], &b = segments[sj];
  const double u = a.dx * b.dy, v = a.dy * b.dx, d = u - v, d_error = 0x1p-50 * (std::abs(u) + std::abs(v)) + 0x1p-1000;
  int sign = d > d_error ? 1 : d < -d_error ? -1 : 0;
  if (sign == 0) sign = base_.lattice->cross(exact(si).edge, exact(sj).edge);
  if (a.end == b.start || b.end == a.start || a.start == b.start || a.end == b.end) {
    // They meet in the common end only, at every scale, unless they fold back onto each other.
    if (sign != 0) return;
    const bool same_way = base_.lattice->dot(exact(si).edge, exact(sj).edge) > 0;
    if (same_way == (a.start == b.start || a.end == b.end)) folds.push_back({si, sj});
    return;
  }
  Candidate c;
  c.a = i;
  c.b = j;
  c.sign = sign;
  c.out_low = c.in_low = -INFINITY;
  c.out_high = c.in_high = INFINITY;
  c.error_a = c.error_b = INFINITY;
  const double tau0 = frame_.tau0, tau1 = frame_.tau1;
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  const double size = kSide * span_;
  if (sign == 0) {
    // Parallel: they can touch where their lines coincide.
    const Linear h{wx.a * a.dy - wy.a * a.dx, wx.b * a.dy - wy.b * a.dx};
    const double error = size * (std::abs(a.dx) + std::abs(a.dy)), h0 = h.at(tau0), h1 = h.at(tau1);
    if ((h0 > error && h1 > error) || (h0 < -error && h1 < -error)) return;
    c.in_low = INFINITY;
    if (std::abs(h0) <= error && std::abs(h1) <= error && always_on(si, exact(b.start))) return touch_parallel(i, j);
    if (h.b != 0 && !(std::abs(h0) <= error && std::abs(h1) <= error)) {
      const double root = -h.a / h.b, wide = error / std::abs(h.b) * (1 + 0x1p-40) + 0x1p-49 * std::abs(root) + 0x1p-50 * tau1;
      c.out_low = root - wide;
      c.out_high = root + wide;
    }
    candidates.push_back(c);
    return;
  }
  if (std::abs(d) > d_error) {
    c.ta = {(wx.a * b.dy - wy.a * b.dx) / d, (wx.b * b.dy - wy.b * b.dx) / d};
    c.tb = {(wx.a * a.dy - wy.a * a.dx) / d, (wx.b * a.dy - wy.b * a.dx) / d};
    // Errors of the numerator, of the denominator relative to it, and of the three roundings here; values within the pieces are at most
    // max(1, tau1), and outside twice that a wrong value cannot become a right one as long as d is known to a quarter.
    const double relative = d_error / std::abs(d), reach = 2 * std::max(1.0, tau1);
    if (relative < 0.25) {
      c.error_a = 2 * (size * (std::abs(b.dx) + std::abs(b.dy)) / std::abs(d) + reach * relative) + 0x1p-48 * reach;
      c.error_b = 2 * (size * (std::abs(a.dx) + std::abs(a.dy)) / std::abs(d) + reach * relative) + 0x1p-48 * reach;
    }
  }
  if (!(c.error_a < 0x1p-8 && c.error_b < 0x1p-8)) {
    c.in_low = INFINITY;  // nearly parallel: exact signs decide at every scale
    candidates.push_back(c);
    return;
  }
  std::array<bool, 2> at_a{}, at_b{};
  if (!bounds(i, c.ta, c.error_a, c, at_a) || !bounds(j, c.tb, c.error_b, c, at_b)) return;
  if (c.out_high <= tau0 || c.out_low >= tau1) return;
  if (at_a[0] || at_a[1] || at_b[0] || at_b[1]) {
    // An end of one on the line of the other, throughout the window as far as doubles tell: at every scale?
    const bool a_on_b = (at_a[0] && always_on(sj, exact(a.start))) || (at_a[1] && always_on(sj, exact(a.end)));
    const bool b_on_a = (at_b[0] && always_on(si, exact(b.start))) || (at_b[1] && always_on(si, exact(b.end)));
    if (a_on_b && b_on_a) folds.push_back({si, sj});
    if (a_on_b || b_on_a) touching.push_back({si, sj});
    if (a_on_b && !b_on_a) add_touch(j, at_a[0] && always_on(sj, exact(a.start)) ? a.start : a.end, c.tb, c.error_b);
    if (b_on_a && !a_on_b) add_touch(i, at_b[0] && always_on(si, exact(b.start)) ? b.start : b.end, c.ta, c.error_a);
    if (a_on_b || b_on_a) return;
  }
  candidates.push_back(c);
}

bool Window::bounds(std::uint32_t piece, const Linear& t, double error, Candidate& c, std::array<bool, 2>& unsure) const {
  const Piece& p = pieces[piece];
  const double tau0 = frame_.tau0, tau1 = frame_.tau1;
  const bool head = p.head_cut ? narrow_at_cut({t.a - p.head.a, t.b - p.head.b}, tau0, tau1, c) : narrow(t, error, tau0, tau1, c, unsure[0]);
  if (!head) return false;
  if (p.tail_cut) return narrow_at_cut({p.tail.a - t.a, p.tail.b - t.b}, tau0, tau1, c);
  return narrow(segments[p.segment].moving ? Linear{-t.a, 1 - t.b} : Linear{1 - t.a, -t.b}, error, tau0, tau1, c, unsure[1]);
}

// A side is linear in s: zero at s = 1 and s = 2 is zero always.
bool Window::always_on(std::uint32_t segment, Pair v) {
  const Segment s = exact(segment);
  if (base_.lattice->side(s, v) != 0) return false;
  if (doubled_ == nullptr) {
    const ScaleValue two = scale_value(exact::BigRational(2));
    doubled_ = base_.lattice_at(base_.lattice_scale(two, two));
  }
  return doubled_->side(s, v) == 0;
}

void Window::add_touch(std::uint32_t piece, WalkPair v, const Linear& t, double error) {
  Candidate c;
  c.out_low = c.in_low = -INFINITY;
  c.out_high = c.in_high = INFINITY;
  std::array<bool, 2> unsure{};
  if (!bounds(piece, t, error, c, unsure) || c.out_high <= frame_.tau0 || c.out_low >= frame_.tau1) return;
  PersistentTouch touch;
  touch.piece = piece;
  touch.t = t;
  touch.error = error;
  touch.out_low = c.out_low;
  touch.in_low = c.in_low;
  touch.in_high = c.in_high;
  touch.out_high = c.out_high;
  touches.push_back(touch);
  touch_pair_.push_back(v);
}

// Two parallel segments on one line at every scale: each end inside the other one touches it.
void Window::touch_parallel(std::uint32_t i, std::uint32_t j) {
  const std::size_t before = touches.size();
  for (const auto& [on_piece, other] : {std::pair{i, j}, std::pair{j, i}}) {
    const LiveSegment &on = segments[pieces[on_piece].segment], &s = segments[pieces[other].segment];
    const double length = on.dx * on.dx + on.dy * on.dy, error = 2 * kSide * span_ * (std::abs(on.dx) + std::abs(on.dy)) / length + 0x1p-47 * std::max(1.0, frame_.tau1);
    for (const bool end : {false, true}) {
      const double f = end ? (s.moving ? 0 : 1) : 0, m = end && s.moving ? 1 : 0;  // the end lies one vector further, times tau if it moves
      const double ax = s.x.a + f * s.dx - on.x.a, ay = s.y.a + f * s.dy - on.y.a, bx = s.x.b + m * s.dx - on.x.b, by = s.y.b + m * s.dy - on.y.b;
      add_touch(on_piece, end ? s.end : s.start, {(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length}, error);
    }
  }
  if (touches.size() == before) return;
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  touching.push_back({si, sj});
  // Against each other they cover both sides of a line: a crack, unless inside.
  if (base_.lattice->dot(exact(si).edge, exact(sj).edge) < 0) folds.push_back({si, sj});
}

int Window::cross(std::uint32_t a, std::uint32_t b) const {
  const double u = segments[a].dx * segments[b].dy, v = segments[a].dy * segments[b].dx, bound = 0x1p-50 * (std::abs(u) + std::abs(v)) + 0x1p-1000;
  if (u - v > bound) return 1;
  if (u - v < -bound) return -1;
  return base_.lattice->cross(exact(a).edge, exact(b).edge);
}

// Touches grouped by their pair of vertices; segments through one node meet there only, so they are no candidates.
void Window::make_nodes() {
  const std::uint32_t n = static_cast<std::uint32_t>(pieces.size());
  head_ray.assign(n, kNone);
  tail_ray.assign(n, kNone);
  std::vector<std::uint32_t> order(touches.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto key = [&](std::uint32_t k) { return std::tuple{touches[k].piece, touch_pair_[k].p, touch_pair_[k].q}; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  order.erase(std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); }), order.end());
  std::vector<PersistentTouch> kept;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<PersistentNode::Ray>> at;
  for (const std::uint32_t k : order) {
    const auto id = static_cast<std::uint32_t>(kept.size());
    kept.push_back(touches[k]);
    auto& list = at[{touch_pair_[k].p, touch_pair_[k].q}];
    list.push_back({touches[k].piece, id, false, 0});
    list.push_back({touches[k].piece, id, true, 0});
  }
  touches = std::move(kept);
  touch_pair_ = {};
  first_touch.assign(n + 1, 0);
  for (const PersistentTouch& t : touches) ++first_touch[t.piece + 1];
  for (std::uint32_t i = 0; i < n; ++i) first_touch[i + 1] += first_touch[i];
  if (!at.empty())
    for (std::uint32_t i = 0; i < n; ++i) {
      const LiveSegment& s = segments[pieces[i].segment];
      if (!pieces[i].head_cut)
        if (const auto it = at.find({s.start.p, s.start.q}); it != at.end()) it->second.push_back({i, kNone, true, 0});
      if (!pieces[i].tail_cut)
        if (const auto it = at.find({s.end.p, s.end.q}); it != at.end()) it->second.push_back({i, kNone, false, 0});
    }
  std::set<std::pair<std::uint32_t, std::uint32_t>> together;
  for (auto& [v, list] : at) {
    const auto half = [&](const PersistentNode::Ray& r) {
      const LiveSegment& s = segments[pieces[r.piece].segment];
      return (s.dy > 0 || (s.dy == 0 && s.dx > 0) ? 0 : 1) ^ (r.out ? 0 : 1);
    };
    const auto turn = [&](const PersistentNode::Ray& a, const PersistentNode::Ray& b) {
      if (half(a) != half(b)) return half(a) < half(b) ? -1 : 1;
      return -cross(pieces[a.piece].segment, pieces[b.piece].segment) * (a.out == b.out ? 1 : -1);
    };
    std::sort(list.begin(), list.end(), [&](const PersistentNode::Ray& a, const PersistentNode::Ray& b) {
      const int c = turn(a, b);
      return c != 0 ? c < 0 : std::tie(a.piece, a.out) < std::tie(b.piece, b.out);
    });
    PersistentNode node;
    node.at = {v.first, v.second};
    node.first_ray = static_cast<std::uint32_t>(rays.size());
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k > 0 && turn(list[k - 1], list[k]) != 0) ++group;
      list[k].group = group;
      const std::uint32_t ray = static_cast<std::uint32_t>(rays.size());
      if (list[k].touch != kNone) {
        PersistentTouch& t = touches[list[k].touch];
        t.node = static_cast<std::uint32_t>(nodes.size());
        (list[k].out ? t.out_ray : t.in_ray) = ray;
      } else {
        (list[k].out ? head_ray : tail_ray)[list[k].piece] = ray;
      }
      rays.push_back(list[k]);
      node_of_ray.push_back(static_cast<std::uint32_t>(nodes.size()));
    }
    node.last_ray = static_cast<std::uint32_t>(rays.size());
    // Something that arrives along a ray on which something leaves: covered from both sides.
    for (std::uint32_t a = node.first_ray; a + 1 < node.last_ray; ++a)
      for (std::uint32_t b = a + 1; b < node.last_ray && rays[b].group == rays[a].group; ++b)
        if (rays[a].out != rays[b].out) folds.push_back({pieces[rays[a].piece].segment, pieces[rays[b].piece].segment});
    for (std::uint32_t a = node.first_ray; a < node.last_ray; ++a)
      for (std::uint32_t b = a + 1; b < node.last_ray; ++b)
        if (rays[a].touch != kNone && rays[b].touch != kNone && rays[a].piece != rays[b].piece)
          together.insert(std::minmax(rays[a].piece, rays[b].piece));
    nodes.push_back(node);
  }
  if (!together.empty())
    std::erase_if(candidates, [&](const Candidate& c) {
      if (c.sign == 0 || !together.contains(std::minmax(c.a, c.b))) return false;
      touching.push_back({pieces[c.a].segment, pieces[c.b].segment});
      return true;
    });
  first_of.assign(n + 1, 0);
  for (const Candidate& c : candidates) {
    ++first_of[c.a + 1];
    ++first_of[c.b + 1];
  }
  for (std::uint32_t i = 0; i < n; ++i) first_of[i + 1] += first_of[i];
  of.resize(first_of[n]);
  std::vector<std::uint32_t> fill(first_of.begin(), first_of.end() - 1);
  for (std::uint32_t c = 0; c < candidates.size(); ++c) {
    of[fill[candidates[c].a]++] = c;
    of[fill[candidates[c].b]++] = c;
  }
}

void Window::link_pieces(const ReducedConvolution& convolution) {
  for (LiveSegment& s : segments) {
    if (s.first_piece == s.last_piece || pieces[s.last_piece - 1].tail_cut) continue;
    Piece& p = pieces[s.last_piece - 1];
    const std::uint32_t id = convolution.next(s.walk);
    if (id == kNoRank || live[id] == kNone) continue;
    const LiveSegment& to = segments[live[id]];
    if (to.first_piece == to.last_piece || pieces[to.first_piece].head_cut) continue;
    p.next = to.first_piece;
    const double u = s.dx * to.dy, v = s.dy * to.dx, bound = 0x1p-50 * (std::abs(u) + std::abs(v)) + 0x1p-1000;
    p.next_turn = static_cast<std::int8_t>(
        u - v > bound ? 1 : u - v < -bound ? -1 : base_.lattice->cross(exact(p.segment).edge, exact(pieces[p.next].segment).edge));
  }
}

}  // namespace dymsum::planar
