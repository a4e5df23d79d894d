#include "planar/window/rotation_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planar/mask/interior_mask.h"

namespace dymsum::planar {
namespace {

Raster fixed_raster(const TurningForms& forms, const Grid& cells) {
  const Operand& o = forms.operand(0);
  RasterMaker<CentreParities> maker(cells);
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = forms.points(0)[i], b = forms.points(0)[o.next[i]];
    maker.touch_edge(a.x, a.y, b.x, b.y);
    maker.bound_edge(a.x, a.y, b.x, b.y, kRim);
    maker.wind_edge(a.x, a.y, b.x, b.y);
  }
  return std::move(maker).with_area();
}

}  // namespace

RotationGrid::RotationGrid(const TurningForms& forms, int cells, std::size_t most_long_edges)
    : forms(forms),
      grid({forms.width(), 2 * forms.reach()}, {forms.height(), 2 * forms.reach()}, cells),
      fixed(fixed_raster(forms, grid.part[0])),
      cells(cells),
      long_edges{dymsum::planar::long_edges(forms, 0, grid.whole.cell, most_long_edges),
                 dymsum::planar::long_edges(forms, 1, grid.whole.cell, most_long_edges)} {}

// Inner: farther from the boundary than any of its points moves. Touched at every angle: at the midpoint, an edge comes
// into what remains of the cell when a rim as wide as the edge moves is taken off.
CoveredCells covered_cells(const RotationGrid& base, const std::vector<Point>& turned, double half) {
  const TurningForms& forms = base.forms;
  const Grid& cells = base.grid.part[1];
  const Operand& o = forms.operand(1);
  RasterMaker<CentreParities> maker(cells);
  const double shift = forms.reach();
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a{turned[i].x + shift, turned[i].y + shift},
        b{turned[o.next[i]].x + shift, turned[o.next[i]].y + shift};
    const Point reach =
        farther_by(farther(moved_by(turned[i], half), moved_by(turned[o.next[i]], half)), kSweptRim * forms.span());
    maker.bound_edge(a.x, a.y, b.x, b.y, kRim + std::max(reach.x, reach.y) * cells.per_cell);
    maker.wind_edge(a.x, a.y, b.x, b.y);
    if (2 * reach.x >= cells.cell || 2 * reach.y >= cells.cell) continue;
    const SegmentClip clip(a.x, a.y, b.x - a.x, b.y - a.y);
    for_each_cell_run(cells, a.x, a.y, b.x, b.y, [&](int r, int first, int last) {
      for (int c = first; c <= last; ++c) {
        const SegmentClip::Part part = clip.within(c * cells.cell + reach.x, r * cells.cell + reach.y,
                                                   (c + 1) * cells.cell - reach.x, (r + 1) * cells.cell - reach.y);
        if (part.from <= part.to) maker.touch(r, c, c);
      }
    });
  }
  const Raster raster = std::move(maker).with_area();
  CoveredCells dead(base.grid.whole, base.fixed, raster, CoveredCells::Counts::left_out);
  if (!base.long_edges[0].empty() && !base.long_edges[1].empty()) dead.add(edge_parallelograms(base, turned, half));
  return dead;
}

namespace {

constexpr double kLong = 8;     // cells: sums of shorter edges hold few
constexpr double kAlong = 0.5;  // cells: edges that are so near each other have nearly the same sums

double distance(Point a, Point b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// The cells that lie on one side of a line, x nx + y ny >= least: row r has them from the column (rest - r rise) per
/// on, or up to it.
struct HalfPlane {
  HalfPlane(double nx, double ny, double least, const Grid& cells)
      : rest(least - std::min(ny, 0.0) * cells.cell),
        rise(ny * cells.cell),
        per(cells.per_cell / (nx >= 0 ? std::abs(nx) : nx)),  // the zero may be a negative one
        from(nx >= 0) {}
  double rest, rise, per;  // infinite for lines that lie level, which have all of a row or nothing
  bool from;
};

// Columns [first, last) of the cells of a row that lie in all half-planes.
std::array<int, 2> columns_inside(const std::array<HalfPlane, 4>& sides, const Grid& cells, int row) {
  double first = 0, last = cells.columns;
  for (const HalfPlane& h : sides) {
    const double at = (h.rest - row * h.rise) * h.per;
    if (h.from) first = std::max(first, at);
    else last = std::min(last, at);
  }
  if (!(first < last)) return {0, 0};
  const int low = static_cast<int>(first);
  return {low + (low < first), static_cast<int>(last)};
}

}  // namespace

std::vector<std::uint32_t> long_edges(const TurningForms& forms, std::uint32_t op, double cell, std::size_t most) {
  const std::vector<Point>& points = forms.points(op);
  const Operand& o = forms.operand(op);
  const auto length2 = [&](std::uint32_t e) {
    const Point d = forms.edge(op, e);
    return d.x * d.x + d.y * d.y;
  };
  std::vector<std::uint32_t> found, kept;
  for (std::uint32_t e = 0; e < forms.size(op); ++e)
    if (length2(e) >= kLong * kLong * cell * cell) found.push_back(e);
  std::stable_sort(found.begin(), found.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return length2(a) > length2(b); });
  for (const std::uint32_t e : found) {
    const Point a = points[e], b = points[o.next[e]];
    const auto along = [&](std::uint32_t f) {
      const Point c = points[f], d = points[o.next[f]];
      return std::max(distance(a, c), distance(b, d)) < kAlong * cell ||
             std::max(distance(a, d), distance(b, c)) < kAlong * cell;
    };
    if (std::none_of(kept.begin(), kept.end(), along)) kept.push_back(e);
    if (kept.size() == most) break;
  }
  return kept;
}

// While the turning edge sweeps, the boundary of the parallelogram moves by no more than the edge's ends do. So what is
// farther inside at the midpoint is never reached, and stays inside.
Bitmap edge_parallelograms(const RotationGrid& grid, const std::vector<Point>& turned, double half) {
  const TurningForms& forms = grid.forms;
  const Grid& cells = grid.grid.whole;
  Bitmap inside(cells.rows, cells.columns);
  const double shift = forms.reach();
  for (const std::uint32_t f : grid.long_edges[1]) {
    const std::uint32_t to = forms.operand(1).next[f];
    const Point v{turned[to].x - turned[f].x, turned[to].y - turned[f].y};
    const double rim = std::max(moved(forms, f, half), moved(forms, to, half)) +
                       2 * kReach * cells.cell;  // kReach is far beyond all roundings
    const double length_v = std::hypot(v.x, v.y);
    for (const std::uint32_t e : grid.long_edges[0]) {
      const Point u = forms.edge(0, e);
      const double area = u.x * v.y - u.y * v.x, length_u = std::hypot(u.x, u.y), sign = area > 0 ? 1 : -1;
      if (std::abs(area) < (cells.cell + 2 * rim) * std::max(length_u, length_v)) continue;
      const double x = forms.points(0)[e].x + turned[f].x + shift, y = forms.points(0)[e].y + turned[f].y + shift;
      // Left of one side and right of the other one, in either direction.
      const auto beside = [&](Point d, double length, double side) {
        const double nx = -d.y * side, ny = d.x * side, at = nx * x + ny * y;
        return std::array{HalfPlane{nx, ny, at + rim * length, cells},
                          HalfPlane{-nx, -ny, -at - std::abs(area) + rim * length, cells}};
      };
      const auto [a, b] = beside(u, length_u, sign);
      const auto [c, d] = beside(v, length_v, -sign);
      const int low = cells.row(y + std::min(0.0, u.y) + std::min(0.0, v.y)),
                high = cells.row(y + std::max(0.0, u.y) + std::max(0.0, v.y));
      for (int row = low; row <= high; ++row) {
        const auto [first, last] = columns_inside({a, b, c, d}, cells, row);
        if (first < last) inside.set_run(row, first, last - 1);
      }
    }
  }
  return inside;
}

// A float errs by at most kReach, as there are fewer than 2048 rows and columns: that of the edge, that of the vertex,
// and their sum; and doubles by less than another one.
EdgeCells::EdgeCells(const TurningForms& forms, const CoveredCells& cells, const std::vector<Point>& turned,
                     std::span<const Point> reach)
    : cells_(cells) {
  static_assert(1024 * exact::kFloatRoundoff <= kReach);
  const Grid& g = cells.grid();
  last_ = Whole{g.rows - 1, g.columns - 1, g.rows - 1, g.columns - 1};
  const double shift = forms.reach();
  const auto bounds = [&](double x0, double y0, double x1, double y1, Point by) {
    return Bounds{static_cast<float>((y0 - by.y) * g.per_cell), static_cast<float>((x0 - by.x) * g.per_cell),
                  static_cast<float>((y1 + by.y) * g.per_cell), static_cast<float>((x1 + by.x) * g.per_cell)};
  };
  for (const std::uint32_t side : {0u, 1u}) {
    const Operand &o = forms.operand(side), &other = forms.operand(1 - side);
    const std::vector<Point>&at = side == 0 ? forms.points(0) : turned, &from = side == 0 ? turned : forms.points(0);
    edges_[side].reserve(o.size());
    for (std::uint32_t e = 0; e < o.size(); ++e) {
      const Point a = at[e], b = at[o.next[e]];
      const Point by = side == 0 ? Point{} : farther(reach[e], reach[o.next[e]]);
      edges_[side].push_back(bounds(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y),
                                    farther_by(by, 4 * kReach * g.cell)));
    }
    vertices_[side].reserve(other.size());
    for (std::uint32_t v = 0; v < other.size(); ++v) {
      const double x = from[v].x + shift, y = from[v].y + shift;
      vertices_[side].push_back(bounds(x, y, x, y, side == 0 ? reach[v] : Point{}));
    }
  }
}

}  // namespace dymsum::planar
