#include "planar/window/scaling_window.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"
#include "planar/operand/contact_of.h"
#include "planar/window/edge_search.h"
#include "planar/window/scaling_stages.h"

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
    : base_(base), frame_(settings.frame) {
  const WindowFrame swept = swept_frame(settings);
  const std::uint32_t m = frame_.moving;
  span_ = std::max(base.width[1 - m], base.height[1 - m]) + 2 * frame_.tau1 * std::max(base.width[m], base.height[m]);
  const CoveredCells mask = swept_cells(base, swept, settings.cells, settings.mask);
  Scratch memory;
  add_live(convolution, swept, mask, &memory);
  const Array<PieceEnds> ends = cut_pieces(*this, swept, mask, &memory);
  EdgeSearch search(*this);
  const auto touch_pairs =
      find_candidates(*this, swept, mask, ends, settings, {settings.covers ? &search : nullptr, settings.memory});
  abandoned = !touch_pairs || settings.stop.stop_requested();
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

}  // namespace dymsum::planar
