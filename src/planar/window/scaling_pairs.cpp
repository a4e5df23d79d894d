#include "planar/window/scaling_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/box_sweep.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {
namespace {

// Pairs of tree nodes. Where operands overlap some edges that cross are soon found; where they do not, all would have
// to be looked at.
constexpr std::uint32_t kMostLooks = 128;
// After so many searches in vain only one of so many is made.
constexpr std::uint32_t kInVain = 4, kSpared = 4;

}  // namespace

// Whether the ends of an edge of the other operand lie on opposite sides of an edge, provably. Which end lies on which
// side is the same at both positions: edges keep their directions.
inline bool EdgeSearch::opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge,
                                 const PositionPair& at) const {
  const Operand &o = window_.base().operands[op], &other = window_.base().operands[1 - op];
  const Two own = scale(op, at), others = scale(1 - op, at), ex = both(o.ex[edge]), ey = both(o.ey[edge]);
  const Two bound = both(std::abs(o.ex[edge]) + std::abs(o.ey[edge])) * (at.error + both(kSearchSide * window_.span()));
  const Two px = own * both(o.x[edge]), py = own * both(o.y[edge]);
  const auto value = [&](std::uint32_t v) {
    return ex * (at.y - (py + others * both(other.y[v]))) - ey * (at.x - (px + others * both(other.x[v])));
  };
  const Two u = value(other_edge), v = value(other.next[other_edge]);
  return (every(u > bound) && every(v < -bound)) || (every(u < -bound) && every(v > bound));
}

bool EdgeSearch::cross(const CrossingEdges& edges, const PositionPair& at) const {
  return opposite(0, edges[0], edges[1], at) && opposite(1, edges[1], edges[0], at);
}

std::optional<CrossingEdges> EdgeSearch::find_or_spare(const Position& from, const Position& to) {
  const PositionPair at(from, to);
  if (const std::optional<CrossingEdges> known = find_recent(at)) return known;
  if (in_vain_ >= kInVain && ++in_vain_ < kInVain + kSpared) return std::nullopt;
  const std::optional<CrossingEdges> edges = find_new(at);
  in_vain_ = edges ? 0 : std::min(in_vain_ + 1, kInVain);
  return edges;
}

std::optional<CrossingEdges> EdgeSearch::find_new(const PositionPair& at) {
  for (const EdgeTree& p : window_.base().operands[0].trees())
    for (const EdgeTree& q : window_.base().operands[1].trees())
      if (const auto edges = find_in(p, q, at)) {
        remember(*edges);
        return edges;
      }
  return std::nullopt;
}

std::optional<CrossingEdges> EdgeSearch::find_in(const EdgeTree& p, const EdgeTree& q, const PositionPair& at) {
  const Two of_p = scale(0, at), of_q = scale(1, at);
  // The sum of two boxes does not hold one of the positions.
  const auto outside = [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    return any(of_p * both(a.x0) + of_q * both(b.x0) > at.x) | any(of_p * both(a.x1) + of_q * both(b.x1) < at.x) |
           any(of_p * both(a.y0) + of_q * both(b.y0) > at.y) | any(of_p * both(a.y1) + of_q * both(b.y1) < at.y);
  };
  std::uint32_t looked = 0;
  const auto apart = [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    return looked++ >= kMostLooks || outside(a, b);
  };
  std::optional<CrossingEdges> found;
  any_pair_of_leaves(p.nodes, 0, q.nodes, 0, apart, [&](const EdgeTree::Node& a, const EdgeTree::Node& b) {
    found = find_in_leaves(a, b, at);
    return found.has_value();
  });
  return found;
}

std::optional<CrossingEdges> EdgeSearch::find_in_leaves(const EdgeTree::Node& a, const EdgeTree::Node& b,
                                                        const PositionPair& at) const {
  const double of_p = scale(0, at)[0], of_q = scale(1, at)[0];
  for (std::uint32_t e = a.first; e < a.last; ++e) {
    const EdgeBox& u = window_.base().operands[0].boxes[e];
    // The box that an edge of Q has to reach, seen from e.
    const double x0 = at.x[0] - of_p * std::max(u.ax, u.bx), x1 = at.x[0] - of_p * std::min(u.ax, u.bx);
    const double y0 = at.y[0] - of_p * std::max(u.ay, u.by), y1 = at.y[0] - of_p * std::min(u.ay, u.by);
    if (of_q * b.x1 < x0 || of_q * b.x0 > x1 || of_q * b.y1 < y0 || of_q * b.y0 > y1) continue;
    for (std::uint32_t f = b.first; f < b.last; ++f) {
      const EdgeBox& v = window_.base().operands[1].boxes[f];
      const bool apart_x = of_q * std::max(v.ax, v.bx) < x0 || of_q * std::min(v.ax, v.bx) > x1;
      const bool apart_y = of_q * std::max(v.ay, v.by) < y0 || of_q * std::min(v.ay, v.by) > y1;
      if (!apart_x && !apart_y && cross({e, f}, at)) return CrossingEdges{e, f};
    }
  }
  return std::nullopt;
}

namespace {

/// Crossings known worse than this are left to exact signs at every scale. Any value is right.
constexpr double kKnownFraction = 0x1p-8;

/// What a piece sweeps lies in its box, some of a cell wider than it; in cells of the mask.
struct PieceBox {
  int row0, column0, row1, column1;
  std::uint32_t segment;
};

/// The boxes of pieces, in cells and in quanta.
struct PieceBoxes {
  PieceBoxes(const Window& window, const Array<PieceEnds>& ends, const Grid& g, Scratch* memory)
      : cells(memory), quanta(memory) {
    const double reach = 4 * kReach * g.cell, per_x = (kBoxQuanta - 1) / (g.columns * g.cell),
                 per_y = (kBoxQuanta - 1) / (g.rows * g.cell);
    // What is not less stays so: boxes that meet do in quanta too.
    const auto quantum = [](double v) { return static_cast<std::int16_t>(std::clamp(v, 0.0, kBoxQuanta - 1.0)); };
    cells.reserve(ends.size());
    quanta.reserve(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const PieceEnds& e = ends[i];
      const Two x_low = least(e.ax, e.bx), x_high = most(e.ax, e.bx), y_low = least(e.ay, e.by),
                y_high = most(e.ay, e.by);
      const double x0 = std::min(x_low[0], x_low[1]) - reach, x1 = std::max(x_high[0], x_high[1]) + reach;
      const double y0 = std::min(y_low[0], y_low[1]) - reach, y1 = std::max(y_high[0], y_high[1]) + reach;
      cells.push_back({g.row(y0), g.column(x0), g.row(y1), g.column(x1), window.pieces[i].segment});
      quanta.push_back({quantum(x0 * per_x), quantum(y0 * per_y), quantum(x1 * per_x), quantum(y1 * per_y)});
    }
  }
  Array<PieceBox> cells;
  Array<BoxQuanta> quanta;
};

/// Doubles prove at both ends of the window that one piece stays on one side of the other's line; sides are linear in
/// tau.
bool apart(const PieceEnds& line, const PieceEnds& e) {
  const Two dx = both(line.dx), dy = both(line.dy);
  const Two u = dx * (e.ay - line.ay) - dy * (e.ax - line.ax), v = dx * (e.by - line.ay) - dy * (e.bx - line.ax);
  const Two error = both(line.error);
  return (every(u > error) && every(v > error)) || (every(u < -error) && every(v < -error));
}

/// The double of the cross product of the vectors u and v of two pieces, and its error.
struct Product {
  double value, error;
};
Product product(const LiveSegment& a, const LiveSegment& b) {
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  return {u - v, kScaledEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow};
}

class PairTests {
 public:
  PairTests(Window& window, const WindowFrame& swept, const CoveredCells& mask, const CoverSearch& search)
      : window_(window), swept_(swept), mask_(mask), search_(search), touches_(window) {}
  bool run(const Array<PieceEnds>& ends, const WindowSettings& settings);
  const std::vector<WalkPair>& touch_pairs() const { return touches_.pairs(); }

 private:
  void test(std::uint32_t i, std::uint32_t j);
  bool dead_throughout(const Candidate& c) const;
  bool covered_throughout(const Candidate& c) const;
  bool bracket_nearly_parallel(Candidate& c) const;
  void test_parallel(Candidate c);
  void solve(Candidate& c) const;

  Window& window_;
  const WindowFrame& swept_;
  const CoveredCells& mask_;
  CoverSearch search_;
  TouchFinder touches_;
};

// Pieces meet in what their boxes share; where all of that is dead nothing matters.
bool PairTests::run(const Array<PieceEnds>& ends, const WindowSettings& settings) {
  const auto stopped = [&] { return window_.pair_tests > settings.most_pairs || settings.stop.stop_requested(); };
  std::uint32_t rounds = 0;
  const auto again = [&] {
    if (settings.again && ++rounds % 64 == 0) settings.again();
  };
  Scratch* const memory = ends.get_allocator().scratch();
  PiecePairs close(memory);
  const PieceBoxes boxes(window_, ends, mask_.grid(), memory);
  const auto meet = [&](std::uint32_t i, std::uint32_t j) {
    const PieceBox &a = boxes.cells[i], &b = boxes.cells[j];
    if (!mask_.any_live(std::max(a.row0, b.row0), std::max(a.column0, b.column0), std::min(a.row1, b.row1),
                        std::min(a.column1, b.column1)))
      return;
    ++window_.pair_tests;
    if (a.segment != b.segment && !apart(ends[i], ends[j]) && !apart(ends[j], ends[i]))
      close.push_back({std::min(i, j), std::max(i, j)});
  };
  sweep_boxes(
      std::span<const BoxQuanta>(boxes.quanta), memory,
      [&](std::uint32_t, std::uint32_t) {
        again();
        const bool go_on = !stopped();
        return [go_on](std::uint32_t) { return go_on; };
      },
      [&](std::uint32_t i, std::span<const std::uint32_t> others) {
        for (const std::uint32_t j : others) meet(i, j);
      });
  if (stopped()) return false;
  share_lines(window_, touches_, close);
  for (const auto& [i, j] : close) {
    again();
    if (settings.stop.stop_requested()) return false;
    test(i, j);
  }
  return true;
}

void PairTests::test(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = window_.pieces[i].segment, sj = window_.pieces[j].segment;
  const LiveSegment &a = window_.segments[si], &b = window_.segments[sj];
  const int sign = window_.cross(si, sj);
  const WalkPair end_a = window_.end_pair(window_.pieces[i]), end_b = window_.end_pair(window_.pieces[j]);
  if (a.end == b.start || b.end == a.start || a.start == b.start || a.end == b.end || end_a == b.start ||
      end_b == a.start || end_a == end_b) {
    // They meet in the common end only, at every scale, unless they fold back onto each other.
    if (sign != 0) return;
    const bool same_sense = window_.base().lattice->dot(window_.exact(si).edge, window_.exact(sj).edge) > 0;
    if (same_sense == (a.start == b.start || a.end == b.end)) window_.folds.push_back({si, sj});
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
  if (!(c.error_a < kKnownFraction && c.error_b < kKnownFraction)) {
    c.in_low = INFINITY;  // nearly parallel: exact signs decide wherever both lines are close
    if (bracket_nearly_parallel(c)) window_.candidates.push_back(c);
    return;
  }
  std::array<bool, 2> at_a{}, at_b{};
  if (!narrow_to_piece(window_, i, c.ta, c.error_a, c, at_a) || !narrow_to_piece(window_, j, c.tb, c.error_b, c, at_b))
    return;
  if (c.out_high <= window_.frame().tau0 || c.out_low >= window_.frame().tau1) return;
  // An end of one on the line of the other, throughout the window as far as doubles decide: at every scale?
  if ((at_a[0] || at_a[1] || at_b[0] || at_b[1]) && touches_.touch_always(c, at_a, at_b)) return;
  if (!dead_throughout(c) && (search_.edges == nullptr || !covered_throughout(c))) window_.candidates.push_back(c);
}

// Crossings move along a line: those that do so in dead cells only are left out. Boundaries end at crossings on the
// boundary, so what passes the position of one in a dead cell is false on both sides of it.
bool PairTests::dead_throughout(const Candidate& c) const {
  const LiveSegment& a = window_.segments[window_.pieces[c.a].segment];
  const Grid& g = mask_.grid();
  const double reach = 4 * kReach * g.cell + c.error_a * std::max(std::abs(a.dx), std::abs(a.dy));
  double x[2], y[2];
  for (int k = 0; k < 2; ++k) {
    const double tau = k == 0 ? std::max(c.out_low, window_.frame().tau0) : std::min(c.out_high, window_.frame().tau1),
                 t = c.ta.at(tau);
    x[k] = a.x.at(tau) + t * a.dx + swept_.shift_x(tau);
    y[k] = a.y.at(tau) + t * a.dy + swept_.shift_y(tau);
  }
  return !mask_.any_live(g.row(std::min(y[0], y[1]) - reach), g.column(std::min(x[0], x[1]) - reach),
                         g.row(std::max(y[0], y[1]) + reach), g.column(std::max(x[0], x[1]) + reach));
}

// The same where two edges cross there all the while (edge_search.h).
bool PairTests::covered_throughout(const Candidate& c) const {
  const LiveSegment& a = window_.segments[window_.pieces[c.a].segment];
  const auto at = [&](double tau) {
    const double t = c.ta.at(tau), t_error = c.error_a + kFraction * std::max(1.0, tau);
    return EdgeSearch::Position{a.x.at(tau) + t * a.dx, a.y.at(tau) + t * a.dy,
                                t_error * std::max(std::abs(a.dx), std::abs(a.dy)) + kWindowPoint * window_.span(),
                                tau};
  };
  const EdgeSearch::Position from = at(std::max(c.out_low, swept_.tau0)), to = at(std::min(c.out_high, swept_.tau1));
  if (search_.memory == nullptr) return search_.edges->find_or_spare(from, to).has_value();
  const LiveSegment& b = window_.segments[window_.pieces[c.b].segment];
  if (search_.memory->covers(a.id, b.id, *search_.edges, from, to)) return true;
  const std::optional<CrossingEdges> edges = search_.edges->find_or_spare(from, to);
  if (!edges) return false;
  search_.memory->remember(a.id, *edges);
  search_.memory->remember(b.id, *edges);
  return true;
}

// Segments that are nearly parallel cross only where the ends of each do not lie on one side of the other provably.
// Sides are linear in tau, so from either end of the window on they stay on one side until one of them may change its
// own. False where they never cross.
bool PairTests::bracket_nearly_parallel(Candidate& c) const {
  const double tau0 = window_.frame().tau0, tau1 = window_.frame().tau1;
  for (const auto& [i, j] : {std::pair{c.a, c.b}, std::pair{c.b, c.a}}) {
    const LiveSegment &line = window_.segments[window_.pieces[i].segment],
                      &other = window_.segments[window_.pieces[j].segment];
    const double error = kWindowSide * window_.span() * (std::abs(line.dx) + std::abs(line.dy));
    const Linear wx{other.x.a - line.x.a, other.x.b - line.x.b}, wy{other.y.a - line.y.a, other.y.b - line.y.b};
    const Linear from{line.dx * wy.a - line.dy * wx.a, line.dx * wy.b - line.dy * wx.b};
    const double along = line.dx * other.dy - line.dy * other.dx;
    const Linear to = other.moving ? Linear{from.a, from.b + along} : Linear{from.a + along, from.b};
    const auto beyond = [&](double tau) {
      const double s = from.at(tau), e = to.at(tau);
      return s > error && e > error ? 1 : s < -error && e < -error ? -1 : 0;
    };
    const int at_low = beyond(tau0), at_high = beyond(tau1);
    if (at_low != 0 && at_low == at_high) return false;
    double low = INFINITY, high = -INFINITY;
    for (const Linear& side : {from, to}) {
      const double root = -side.a / side.b, wide = root_error(root, side.b, error, tau1);
      if (at_low * side.b < 0) low = std::min(low, root - wide);
      if (at_high * side.b > 0) high = std::max(high, root + wide);
    }
    if (at_low != 0) c.out_low = std::max(c.out_low, low);
    if (at_high != 0) c.out_high = std::min(c.out_high, high);
  }
  return c.out_low < c.out_high;
}

// Parallel pieces can touch where their lines coincide.
void PairTests::test_parallel(Candidate c) {
  const LiveSegment &a = window_.segments[window_.pieces[c.a].segment],
                    &b = window_.segments[window_.pieces[c.b].segment];
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  const Linear h{wx.a * a.dy - wy.a * a.dx, wx.b * a.dy - wy.b * a.dx};
  const double error = kWindowSide * window_.span() * (std::abs(a.dx) + std::abs(a.dy)),
               h0 = h.at(window_.frame().tau0), h1 = h.at(window_.frame().tau1);
  if ((h0 > error && h1 > error) || (h0 < -error && h1 < -error)) return;
  const bool close = std::abs(h0) <= error && std::abs(h1) <= error;
  if (close && touches_.always_on(window_.pieces[c.a].segment, window_.exact(b.start)))
    return touches_.touch_parallel(c.a, c.b);
  c.in_low = INFINITY;
  if (h.b != 0 && !close) {
    const double root = -h.a / h.b, wide = root_error(root, h.b, error, window_.frame().tau1);
    c.out_low = root - wide;
    c.out_high = root + wide;
  }
  window_.candidates.push_back(c);
}

// Finds where two lines that are not parallel meet, on each of them; errors stay infinite where doubles know too
// little.
void PairTests::solve(Candidate& c) const {
  const LiveSegment &a = window_.segments[window_.pieces[c.a].segment],
                    &b = window_.segments[window_.pieces[c.b].segment];
  const Product d = product(a, b);
  if (!(std::abs(d.value) > d.error)) return;
  const Linear wx{b.x.a - a.x.a, b.x.b - a.x.b}, wy{b.y.a - a.y.a, b.y.b - a.y.b};
  c.ta = {(wx.a * b.dy - wy.a * b.dx) / d.value, (wx.b * b.dy - wy.b * b.dx) / d.value};
  c.tb = {(wx.a * a.dy - wy.a * a.dx) / d.value, (wx.b * a.dy - wy.b * a.dx) / d.value};
  // Shares within the pieces are at most max(1, tau1).
  const double size = kWindowSide * window_.span(), relative = d.error / std::abs(d.value),
               reach = 2 * std::max(1.0, window_.frame().tau1);
  if (!(relative < kKnownDenominator)) return;
  c.error_a = fraction_error(size * (std::abs(b.dx) + std::abs(b.dy)), std::abs(d.value), relative, reach);
  c.error_b = fraction_error(size * (std::abs(a.dx) + std::abs(a.dy)), std::abs(d.value), relative, reach);
}

}  // namespace

std::optional<std::vector<WalkPair>> find_candidates(Window& window, const WindowFrame& swept, const CoveredCells& mask,
                                                     const Array<PieceEnds>& ends, const WindowSettings& settings,
                                                     const CoverSearch& search) {
  PairTests tests(window, swept, mask, search);
  if (!tests.run(ends, settings)) return std::nullopt;
  return tests.touch_pairs();
}

}  // namespace dymsum::planar
