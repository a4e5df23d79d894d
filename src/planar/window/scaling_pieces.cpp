#include "planar/window/scaling_stages.h"

#include <algorithm>
#include <cmath>

#include "planar/mask/segment_clip.h"

namespace dymsum::planar {

namespace {

/// A segment at both ends of the swept window: where it starts, and its vector.
struct SweptSegment {
  double ax[2], ay[2], ex[2], ey[2];
};

/// A position on a segment, as fractions of its length at both ends of the swept window.
struct CutPosition {
  double t[2];
};

SweptSegment swept_segment(const LiveSegment& s, const WindowFrame& swept) {
  SweptSegment e;
  for (int k = 0; k < 2; ++k) {
    const double tau = k == 0 ? swept.tau0 : swept.tau1, length = s.length(tau);
    e.ax[k] = s.x.at(tau) + swept.shift_x(tau);
    e.ay[k] = s.y.at(tau) + swept.shift_y(tau);
    e.ex[k] = s.dx * length;
    e.ey[k] = s.dy * length;
  }
  return e;
}

PieceEnds ends_between(const SweptSegment& s, const CutPosition& from, const CutPosition& to) {
  PieceEnds e{};
  for (int k = 0; k < 2; ++k) {
    e.ax[k] = s.ax[k] + from.t[k] * s.ex[k];
    e.ay[k] = s.ay[k] + from.t[k] * s.ey[k];
    e.bx[k] = s.ax[k] + to.t[k] * s.ex[k];
    e.by[k] = s.ay[k] + to.t[k] * s.ey[k];
  }
  return e;
}

/// Segments are cut inside dead cells that they meet at both ends of the window (and hence at every scale in between).
/// The cut is the midpoint of the chord at both ends and linear in between: the chords and the cell are convex in (x,
/// y, tau).
class PieceCutter {
 public:
  explicit PieceCutter(const CoveredCells& mask) : mask_(mask), grid_(mask.grid()), reach_(2 * kReach * grid_.cell) {}

  /// The cuts in order along the segment; valid until the next call.
  const std::vector<CutPosition>& cuts(const SweptSegment& s) {
    cuts_.clear();
    if (!any_covered(ends_between(s, {{0, 0}}, {{1, 1}}))) return cuts_;
    const SegmentClip first(s.ax[0], s.ay[0], s.ex[0], s.ey[0]), last(s.ax[1], s.ay[1], s.ex[1], s.ey[1]);
    for_each_cell_run(grid_, s.ax[0], s.ay[0], s.ax[0] + s.ex[0], s.ay[0] + s.ey[0], [&](int row, int from, int to) {
      for (int c = from; c <= to; ++c) {
        if (!mask_.covered(row, c)) continue;
        const SegmentClip::Part low = in_cell(first, row, c);
        if (!(low.to > low.from)) continue;
        if (const SegmentClip::Part high = in_cell(last, row, c); high.to > high.from)
          cuts_.push_back({{low.midpoint(), high.midpoint()}});
      }
    });
    std::sort(cuts_.begin(), cuts_.end(), [](const CutPosition& a, const CutPosition& b) {
      return a.t[0] != b.t[0] ? a.t[0] < b.t[0] : a.t[1] < b.t[1];
    });
    return cuts_;
  }

  /// Whether a live cell is near what the piece sweeps.
  bool live(const PieceEnds& e) const {
    const Cells near = cells_near(e);
    return mask_.any_live(near.row0, near.column0, near.row1, near.column1);
  }

 private:
  struct Cells {
    int row0, column0, row1, column1;
  };

  bool any_covered(const PieceEnds& e) const {
    const Cells near = cells_near(e);
    return mask_.any_covered(near.row0, near.column0, near.row1, near.column1);
  }

  Cells cells_near(const PieceEnds& e) const {
    const auto [x0, x1] = std::minmax({e.ax[0], e.ax[1], e.bx[0], e.bx[1]});
    const auto [y0, y1] = std::minmax({e.ay[0], e.ay[1], e.by[0], e.by[1]});
    return {grid_.row(y0 - reach_), grid_.column(x0 - reach_), grid_.row(y1 + reach_), grid_.column(x1 + reach_)};
  }

  SegmentClip::Part in_cell(const SegmentClip& segment, int row, int column) const {
    const double h = grid_.cell;
    return segment.within(column * h, row * h, (column + 1) * h, (row + 1) * h);
  }

  const CoveredCells& mask_;
  const Grid& grid_;
  double reach_;
  std::vector<CutPosition> cuts_;
};

}  // namespace

Array<PieceEnds> cut_pieces(Window& window, const WindowFrame& frame, const CoveredCells& mask, Scratch* memory) {
  Array<PieceEnds> all_ends(memory);
  Array<Piece> pieces(memory);  // windows are kept: their own list is no longer than it has to be
  all_ends.reserve(window.segments.size() + window.segments.size() / 4);
  pieces.reserve(all_ends.capacity());
  PieceCutter cutter(mask);
  const double width = frame.tau1 - frame.tau0;
  for (std::uint32_t n = 0; n < window.segments.size(); ++n) {
    LiveSegment& s = window.segments[n];
    const SweptSegment swept = swept_segment(s, frame);
    const std::vector<CutPosition>& cuts = cutter.cuts(swept);
    const auto linear = [&](const CutPosition& c) {
      const double u = c.t[0] * s.length(frame.tau0), v = c.t[1] * s.length(frame.tau1);
      const double slope = width > 0 ? (v - u) / width : 0;
      return Linear{u - slope * frame.tau0, slope};
    };
    s.first_piece = static_cast<std::uint32_t>(pieces.size());
    for (std::size_t k = 0; k <= cuts.size(); ++k) {
      const CutPosition from = k == 0 ? CutPosition{{0, 0}} : cuts[k - 1],
                        to = k == cuts.size() ? CutPosition{{1, 1}} : cuts[k];
      PieceEnds ends = ends_between(swept, from, to);
      if (!cuts.empty() && !cutter.live(ends)) continue;
      ends.dx = s.dx;
      ends.dy = s.dy;
      ends.error = kWindowSide * (std::abs(s.dx) + std::abs(s.dy)) * window.span();
      Piece p;
      p.segment = n;
      p.half = static_cast<std::uint8_t>(half_plane(s.dx, s.dy));
      p.head_cut = k > 0;
      p.tail_cut = k < cuts.size();
      if (p.head_cut) p.head = linear(from);
      if (p.tail_cut) p.tail = linear(to);
      pieces.push_back(p);
      all_ends.push_back(ends);
    }
    s.last_piece = static_cast<std::uint32_t>(pieces.size());
  }
  window.pieces.assign(pieces.begin(), pieces.end());
  return all_ends;
}

namespace {

// Narrows the interval of scales at which g(tau) = a + b tau > 0, where g is known up to `error`. False when it is
// provably empty. Sets `unsure` when doubles know nothing of g in the whole window.
bool narrow(const Linear& g, double error, double tau0, double tau1, Candidate& c, bool& unsure) {
  const double g0 = g.at(tau0), g1 = g.at(tau1);
  if (g0 > error && g1 > error) return true;
  if (g0 < -error && g1 < -error) return false;
  if (g.b == 0 || (std::abs(g0) <= error && std::abs(g1) <= error)) {
    c.in_low = INFINITY;  // exact signs decide at every scale
    unsure = true;
    return true;
  }
  // Beyond these values the sign is proved; the division and tau itself are rounded.
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
  const Linear end = window.end_position(p), rest{end.a - t.a, end.b - t.b};
  if (p.tail_cut) return narrow_at_cut(rest, tau0, tau1, c);
  return narrow(rest, error + p.tail_error, tau0, tau1, c, unsure[1]);
}

}  // namespace dymsum::planar
