#include "planar/rotation/turn_window.h"

#include <algorithm>

namespace dymsum::planar {
namespace {

bool meets_box(Point a, Point b, double x0, double y0, double x1, double y1) {
  double low = 0, high = 1;
  const auto clip = [&](double from, double d, double lo, double hi) {
    if (d == 0) return from >= lo && from <= hi;
    double u = (lo - from) / d, v = (hi - from) / d;
    if (u > v) std::swap(u, v);
    low = std::max(low, u);
    high = std::min(high, v);
    return low <= high;
  };
  return clip(a.x, b.x - a.x, x0, x1) && clip(a.y, b.y - a.y, y0, y1);
}

Raster fixed_raster(const TurningForms& forms, const Grid& cells) {
  const Operand& o = forms.operand(0);
  Raster raster(cells.rows, cells.columns);
  Bitmap boundary(cells.rows, cells.columns);
  CentreWindings windings(cells);
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = forms.points(0)[i], b = forms.points(0)[o.next[i]];
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) { raster.touch.set_run(r, first, last); });
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) { boundary.set_run(r, first, last); }, kRim);
    windings.add_edge(a.x, a.y, b.x, b.y);
  }
  windings.fill(boundary, raster);
  return raster;
}

}  // namespace

TurnGrid::TurnGrid(const TurningForms& forms, int cells)
    : forms(forms), grid({forms.width(), 2 * forms.reach()}, {forms.height(), 2 * forms.reach()}, cells), fixed(fixed_raster(forms, grid.part[0])), cells(cells) {}

// Inner: farther from the boundary than any of its points moves. Touched at every angle: at the middle, an edge comes
// into what remains of the cell when a rim as wide as the edge moves is taken off.
DeadCells dead_cells(const TurnGrid& base, const std::vector<Point>& turned, double half) {
  const TurningForms& forms = base.forms;
  const Grid& cells = base.grid.part[1];
  const Operand& o = forms.operand(1);
  Raster raster(cells.rows, cells.columns);
  Bitmap boundary(cells.rows, cells.columns);
  CentreWindings windings(cells);
  const double shift = forms.reach();
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a{turned[i].x + shift, turned[i].y + shift}, b{turned[o.next[i]].x + shift, turned[o.next[i]].y + shift};
    const double reach = std::max(moved(turned[i], half), moved(turned[o.next[i]], half)) + 0x1p-48 * forms.span();
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) { boundary.set_run(r, first, last); }, kRim + reach * cells.per_cell);
    windings.add_edge(a.x, a.y, b.x, b.y);
    if (2 * reach >= cells.cell) continue;
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) {
      for (int c = first; c <= last; ++c)
        if (meets_box(a, b, c * cells.cell + reach, r * cells.cell + reach, (c + 1) * cells.cell - reach, (r + 1) * cells.cell - reach)) raster.touch.set_run(r, c, c);
    });
  }
  windings.fill(boundary, raster);
  return DeadCells(base.grid.whole, base.fixed, raster);
}

TurnWindow::TurnWindow(const TurnGrid& base, const TurnCatalog& catalog, const TurnRange& r, bool mask) : range(r), forms_(base.forms) {
  low = range.theta(range.t_low) - 0x1p-48;
  high = range.theta(range.t_high) + 0x1p-48;
  middle = (low + high) / 2;
  half = (high - low) / 2 * (1 + 0x1p-40);
  heading = Heading::of(middle);
  for (const Point& p : forms_.points(1)) turned.push_back({heading.c * p.x - heading.s * p.y, heading.s * p.x + heading.c * p.y});
  const DeadCells dead = mask ? dead_cells(base, turned, half) : DeadCells(base.grid.whole);
  const Grid& g = dead.grid();
  const double shift = forms_.reach(), reach = 2 * kReach * g.cell;
  catalog.for_each(low, high, [&](const WalkSegment& s) {
    ++all_segments;
    const Box b = box(s);
    if (dead.live(g.row(b.y0 + shift - reach), g.column(b.x0 + shift - reach), g.row(b.y1 + shift + reach), g.column(b.x1 + shift + reach)) == 0) return;
    segments.push_back(s);
    boxes_.push_back(b);
  });
  find_meetings(dead);
}

TurnWindow::Box TurnWindow::box(const WalkSegment& s) const {
  const Pair from = TurningForms::start(s), to = forms_.end(s);
  const std::vector<Point>& q = forms_.points(0);
  Box b;
  b.ax = q[from.p].x + turned[from.q].x;
  b.ay = q[from.p].y + turned[from.q].y;
  b.bx = q[to.p].x + turned[to.q].x;
  b.by = q[to.p].y + turned[to.q].y;
  b.reach = std::max(moved(turned[from.q], half), moved(turned[to.q], half)) + 0x1p-48 * forms_.span();
  b.x0 = std::min(b.ax, b.bx) - b.reach;
  b.x1 = std::max(b.ax, b.bx) + b.reach;
  b.y0 = std::min(b.ay, b.by) - b.reach;
  b.y1 = std::max(b.ay, b.by) + b.reach;
  return b;
}

// Each end of one on the same side of the other's line at every angle: they cannot meet.
bool TurnWindow::may_meet(std::uint32_t i, std::uint32_t j) const {
  const auto apart = [&](const WalkSegment& s, const WalkSegment& t) {
    const double error = forms_.side_error(s);
    const TrigForm u = forms_.side(s, TurningForms::start(t)), v = forms_.side(s, forms_.end(t));
    const double a = u.at(heading), b = v.at(heading);
    if ((a > 0) != (b > 0)) return false;
    return u.far_from_zero(heading, half, error) && v.far_from_zero(heading, half, error);
  };
  return !apart(segments[i], segments[j]) && !apart(segments[j], segments[i]);
}

void TurnWindow::find_meetings(const DeadCells& dead) {
  const Grid& g = dead.grid();
  const double shift = forms_.reach();
  std::vector<std::uint32_t> start(static_cast<std::size_t>(g.rows) * g.columns + 2, 0), entries;
  const auto runs = [&](auto&& f) {
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      const Box& b = boxes_[i];
      for_each_cell_run(g, b.ax + shift, b.ay + shift, b.bx + shift, b.by + shift, [&](int r, int first, int last) {
        for (int c = first; c <= last; ++c)
          if (!dead.dead(r, c)) f(static_cast<std::size_t>(r) * g.columns + c, i);
      }, kReach + b.reach * g.per_cell);
    }
  };
  runs([&](std::size_t cell, std::uint32_t) { ++start[cell + 2]; });
  for (std::size_t k = 2; k < start.size(); ++k) start[k] += start[k - 1];
  entries.resize(start.back());
  runs([&](std::size_t cell, std::uint32_t i) { entries[start[cell + 1]++] = i; });
  // Every cell lists its segments in their order, so a segment looks at the tails of its cells' lists; the stamp tells
  // whom it has met.
  std::vector<std::uint32_t> stamp(segments.size(), ~std::uint32_t{0});
  std::uint32_t last = ~std::uint32_t{0};
  std::vector<std::uint32_t> met;
  const auto flush = [&] {
    std::sort(met.begin(), met.end());
    for (const std::uint32_t j : met)
      if (may_meet(last, j)) meetings.push_back({last, j});
    met.clear();
  };
  runs([&](std::size_t cell, std::uint32_t i) {
    if (i != last) {
      flush();
      last = i;
    }
    const Box& a = boxes_[i];
    for (std::uint32_t k = start[cell + 1]; k-- > start[cell];) {
      const std::uint32_t j = entries[k];
      if (j <= i) break;
      const Box& b = boxes_[j];
      if (a.x0 > b.x1 || b.x0 > a.x1 || a.y0 > b.y1 || b.y0 > a.y1 || stamp[j] == i) continue;
      stamp[j] = i;
      met.push_back(j);
    }
  });
  flush();
}

}  // namespace dymsum::planar
