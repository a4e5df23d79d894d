#include "planar/scaling/window.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"
#include "planar/operand/contact_of.h"
#include "planar/scaling/edge_search.h"
#include "planar/scaling/window_nodes.h"
#include "planar/scaling/window_pairs.h"

namespace dymsum::planar {

namespace {

WindowFrame swept_frame(const WindowSettings& settings) {
  WindowFrame swept = settings.frame;
  if (settings.shrink < 1) {
    const double middle = 0.5 * (swept.tau0 + swept.tau1), half = 0.5 * settings.shrink * (swept.tau1 - swept.tau0);
    swept.tau0 = middle - half;
    swept.tau1 = middle + half;
  }
  return swept;
}

}  // namespace

Window::Window(const OperandPair& base, const ReducedConvolution& convolution, const WindowSettings& settings)
    : base_(base), frame_(settings.frame) {
  const WindowFrame swept = swept_frame(settings);
  const std::uint32_t m = frame_.moving;
  span_ = std::max(base.width[1 - m], base.height[1 - m]) + 2 * frame_.tau1 * std::max(base.width[m], base.height[m]);
  const SweptMask mask(*base.lattice, base.operands, swept, settings.cells, settings.mask);
  live.assign(convolution.size(), kNone);
  std::uint32_t id = 0;
  convolution.for_each([&](const WalkSegment& w) { add_segment(w, id++, swept, mask); });
  const std::vector<PieceEnds> ends = cut_pieces(*this, swept, mask);
  EdgeSearch search(*this);
  const auto touch_pairs =
      find_candidates(*this, swept, mask, ends, settings.most_pairs, settings.covers ? &search : nullptr);
  abandoned = !touch_pairs;
  if (abandoned) return;
  make_nodes(*this, *touch_pairs);
  if (settings.covers) drop_covered_nodes(*this, swept);
  index(candidates, pieces.size());
  link_pieces(convolution);
}

Segment Window::exact(std::uint32_t s) const {
  const WalkSegment& w = segments[s].walk;
  return {base_.operands[w.side].edge(w.edge), base_.operands[1 - w.side].source[w.vertex]};
}

std::size_t Window::bytes() const {
  return segments.capacity() * sizeof(LiveSegment) + pieces.capacity() * (sizeof(Piece) + sizeof(PieceEnds)) +
         candidates.capacity() * sizeof(Candidate) + (first_of.capacity() + of.capacity() + live.capacity()) * 4;
}

void Window::add_segment(const WalkSegment& w, std::uint32_t id, const WindowFrame& swept, const SweptMask& mask) {
  const std::uint32_t m = frame_.moving;
  const Operand &o = base_.operands[w.side], &other = base_.operands[1 - w.side];
  const std::uint32_t a = o.source[w.edge], b = o.source[o.next[w.edge]], v = other.source[w.vertex];
  const Lattice& l = *base_.lattice;
  // The moving operand's vertices at the segment's ends; the fixed one's.
  const bool moving = w.side == m;
  const std::uint32_t move_a = moving ? a : v, move_b = moving ? b : v, rest_a = moving ? v : a,
                      rest_b = moving ? v : b;
  const std::vector<double>&xm = l.points[m]->x, &ym = l.points[m]->y, &xf = l.points[1 - m]->x,
        &yf = l.points[1 - m]->y;
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const double tau : {swept.tau0, swept.tau1}) {
    const double sx = swept.shift_x(tau), sy = swept.shift_y(tau);
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
  s.contact = contact_of(w, base_.operands[0], base_.operands[1]);
  segments.push_back(s);
}

int Window::cross(std::uint32_t a, std::uint32_t b) const {
  const double u = segments[a].dx * segments[b].dy, v = segments[a].dy * segments[b].dx,
               bound = kEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow;
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

}  // namespace dymsum::planar
