#include "planar/window/scaling_window.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"
#include "planar/mask/interior_mask.h"
#include "planar/operand/operand.h"
#include "planar/window/scaling_pairs.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {
namespace {

WindowFrame swept_frame(const WindowSettings& settings) {
  WindowFrame swept = settings.frame;
  if (settings.shrink < 1) {
    const double midpoint = 0.5 * (swept.tau0 + swept.tau1), half = 0.5 * settings.shrink * (swept.tau1 - swept.tau0);
    swept.tau0 = midpoint - half;
    swept.tau1 = midpoint + half;
  }
  return swept;
}

}  // namespace

Window::Window(const OperandPair& base, const ReducedConvolution& convolution, const WindowSettings& settings)
    : edges_prove(settings.edges_prove), base_(base), frame_(settings.frame) {
  const WindowFrame swept = swept_frame(settings);
  const std::uint32_t m = frame_.moving;
  span_ = std::max(base.width[1 - m], base.height[1 - m]) + 2 * frame_.tau1 * std::max(base.width[m], base.height[m]);
  const CoveredCells mask = swept_cells(base, swept, settings.cells, settings.mask);
  Scratch memory;
  add_live(convolution, swept, mask, &memory);
  if (!base.regular) add_without_area();
  const Array<PieceEnds> ends = cut_pieces(*this, swept, mask, &memory);
  EdgeSearch search(*this);
  const auto touch_pairs =
      find_candidates(*this, swept, mask, ends, settings,
                      {settings.covers && settings.edges_prove ? &search : nullptr, settings.memory});
  abandoned = !touch_pairs || settings.stop.stop_requested();
  if (abandoned) return;
  make_nodes(*this, *touch_pairs);
  if (settings.covers && settings.edges_prove) drop_covered_nodes(*this, swept);
  index(candidates, pieces.size());
  link_pieces(convolution);
}

Segment Window::exact(std::uint32_t s) const {
  const WalkSegment& w = segments[s].walk;
  return {base_.operands[w.side].edge(w.edge), base_.operands[1 - w.side].source[w.vertex]};
}

std::size_t Window::bytes() const {
  return bytes_of(segments, pieces, candidates, touches, nodes, rays, folds, touching, first_touch, head_ray, tail_ray,
                  node_of_ray, first_of, of, live);
}

namespace {

/// What edges or vertices of an operand sweep in a window, in cells of its grid. A segment sweeps the sum of what its
/// edge and its vertex do.
struct SweptBoxes {
  struct Box {
    double row0, column0, row1, column1;
  };
  /// `ends`: of every edge, its ends; otherwise of every vertex.
  SweptBoxes(const OperandPair& base, std::uint32_t op, const WindowFrame& swept, const Grid& grid, bool ends) {
    const Operand& o = base.operands[op];
    const bool moves = op == swept.moving;
    boxes.reserve(o.size());
    for (std::uint32_t v = 0; v < o.size(); ++v) {
      const std::uint32_t w = ends ? o.next[v] : v;
      Box b{INFINITY, INFINITY, -INFINITY, -INFINITY};
      for (const double tau : {swept.tau0, swept.tau1})
        for (const std::uint32_t i : {v, w}) {
          const double x = moves ? tau * o.x[i] + swept.shift_x(tau) : o.x[i],
                       y = moves ? tau * o.y[i] + swept.shift_y(tau) : o.y[i];
          b = {std::min(b.row0, y), std::min(b.column0, x), std::max(b.row1, y), std::max(b.column1, x)};
        }
      boxes.push_back(
          {b.row0 * grid.per_cell, b.column0 * grid.per_cell, b.row1 * grid.per_cell, b.column1 * grid.per_cell});
    }
  }
  std::vector<Box> boxes;
};

}  // namespace

// Those that come near a live cell.
void Window::add_live(const ReducedConvolution& convolution, const WindowFrame& swept, const CoveredCells& mask,
                      Scratch* memory) {
  live.assign(convolution.size(), kNone);
  const Grid& g = mask.grid();
  constexpr double reach = 2 * kReach;
  std::vector<SweptBoxes> edges, vertices;
  for (std::uint32_t op = 0; op < 2; ++op) {
    edges.emplace_back(base_, op, swept, g, true);
    vertices.emplace_back(base_, op, swept, g, false);
  }
  Array<LiveSegment> found(memory);
  std::uint32_t id = 0;
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> turn,
                                std::uint32_t lo, std::uint32_t count) {
    const SweptBoxes::Box at = vertices[1 - side].boxes[v];
    for (std::uint32_t k = 0, i = lo; k < count; ++k, ++id, i = i + 1 == turn.size() ? 0 : i + 1) {
      const SweptBoxes::Box& e = edges[side].boxes[turn[i]];
      const auto row = [&](double r) { return std::clamp(static_cast<int>(r), 0, g.rows - 1); };
      const auto column = [&](double c) { return std::clamp(static_cast<int>(c), 0, g.columns - 1); };
      if (mask.any_live(row(at.row0 + e.row0 - reach), column(at.column0 + e.column0 - reach),
                        row(at.row1 + e.row1 + reach), column(at.column1 + e.column1 + reach))) {
        live[id] = static_cast<std::uint32_t>(found.size());
        found.push_back(segment({side, turn[i], v}, id));
      }
    }
  });
  segments.assign(found.begin(), found.end());
}

// They are in no convolution, and have the ids after its own.
void Window::add_without_area() {
  SumsWithoutArea sums = sums_without_area(base_.operands[0], base_.operands[1]);
  for (const WalkSegment& w : sums.segments) {
    segments.push_back(segment(w, static_cast<std::uint32_t>(live.size())));
    live.push_back(static_cast<std::uint32_t>(segments.size() - 1));
  }
  points = std::move(sums.points);
}

LiveSegment Window::segment(const WalkSegment& w, std::uint32_t id) const {
  const Operand& o = base_.operands[w.side];
  const std::uint32_t next = o.next[w.edge];
  LiveSegment s;
  s.walk = w;
  s.id = id;
  s.moving = w.side == frame_.moving;
  s.dx = o.ex[w.edge];
  s.dy = o.ey[w.edge];
  s.start = w.side == 0 ? WalkPair{w.edge, w.vertex} : WalkPair{w.vertex, w.edge};
  s.end = w.side == 0 ? WalkPair{next, w.vertex} : WalkPair{w.vertex, next};
  const MovingPoint from = position(s.start);
  s.x = from.x;
  s.y = from.y;
  s.contact = contact_of(w, base_.operands[0], base_.operands[1]);
  return s;
}

int Window::cross(std::uint32_t a, std::uint32_t b) const {
  const double u = segments[a].dx * segments[b].dy, v = segments[a].dy * segments[b].dx,
               bound = kScaledEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow;
  if (u - v > bound) return 1;
  if (u - v < -bound) return -1;
  return base_.lattice->cross(exact(a).edge, exact(b).edge);
}

void Window::link_pieces(const ReducedConvolution& convolution) {
  for (LiveSegment& s : segments) {
    if (s.first_piece == s.last_piece) continue;
    Piece& p = pieces[s.last_piece - 1];
    if (p.tail_cut || p.handed_on || p.covered) continue;
    const std::uint32_t id = convolution.next(s.walk);
    if (id == kNoRank || live[id] == kNone) continue;
    const LiveSegment& to = segments[live[id]];
    if (to.first_piece == to.last_piece || pieces[to.first_piece].head_cut || pieces[to.first_piece].covered) continue;
    p.next = to.first_piece;
    p.next_turn = static_cast<std::int8_t>(cross(p.segment, pieces[p.next].segment));
  }
}

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
