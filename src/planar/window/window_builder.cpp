#include "planar/window/window_builder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planar/convolution/convolution.h"

namespace dymsum::planar {

// Cells that stay covered throughout a window of scales.

namespace {

struct Place2 {
  double x, y;
};

// Calls f(row, first column, last column) for the cells within `reach` of the convex quadrangle swept by a segment a b
// from its position a0 b0 at one end of the window to a1 b1 at the other.
template <class F>
void for_each_swept_run(const Grid& grid, const double (&x)[4], const double (&y)[4], double reach, F&& f) {
  double y_low = y[0], y_high = y[0], x_low = x[0], x_high = x[0];
  for (int k = 1; k < 4; ++k) {
    y_low = y[k] < y_low ? y[k] : y_low;
    y_high = y[k] > y_high ? y[k] : y_high;
    x_low = x[k] < x_low ? x[k] : x_low;
    x_high = x[k] > x_high ? x[k] : x_high;
  }
  const int r0 = grid.row(y_low - reach), r1 = grid.row(y_high + reach);
  if (r0 == r1) {
    f(r0, grid.column(x_low - reach), grid.column(x_high + reach));
    return;
  }
  for (int r = r0; r <= r1; ++r) {
    const double low = r * grid.cell - reach, high = (r + 1) * grid.cell + reach;
    double left = x_high, right = x_low;
    for (int k = 0; k < 4; ++k) {
      const int l = (k + 1) & 3;
      double ax = x[k], ay = y[k], bx = x[l], by = y[l];
      if (ay > by) {
        std::swap(ax, bx);
        std::swap(ay, by);
      }
      if (by < low || ay > high) continue;
      // by - ay may be tiny: then the clamps make the whole edge.
      const double slope = by > ay ? (bx - ax) / (by - ay) : 0;
      const double e0 = ax < bx ? ax : bx, e1 = ax < bx ? bx : ax;
      const double u = ay >= low ? ax : std::clamp(ax + (low - ay) * slope, e0, e1);
      const double v = by <= high ? bx : std::clamp(ax + (high - ay) * slope, e0, e1);
      left = std::min({left, u, v});
      right = std::max({right, u, v});
    }
    if (left <= right) f(r, grid.column(left - reach), grid.column(right + reach));
  }
}

// An edge that meets a cell at both ends of the window meets it in between: its positions form a plane piece in (x, y,
// tau), which is convex.
void touch_at_both_ends(const Grid& cells, Place2 a0, Place2 b0, Place2 a1, Place2 b1,
                        std::vector<std::array<int, 3>>& scratch, Bitmap& touch) {
  scratch.clear();
  for_each_cell_run(cells, a0.x, a0.y, b0.x, b0.y, [&](int r, int first, int last) {
    scratch.push_back({r, first, last});
  });
  for_each_cell_run(cells, a1.x, a1.y, b1.x, b1.y, [&](int r, int first, int last) {
    const int k = r - scratch[0][0];
    if (k < 0 || k >= static_cast<int>(scratch.size())) return;
    const int from = std::max(first, scratch[k][1]), to = std::min(last, scratch[k][2]);
    if (from <= to) touch.set_run(r, from, to);
  });
}

template <class At>
Raster rasterize(const Operand& o, const Grid& cells, bool moves, const At& at) {
  RasterMaker<CentreParities> maker(cells);
  std::vector<std::array<int, 3>> scratch;
  const double rim = kRim * cells.cell;
  for (const Loop& loop : o.loops)
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t s = o.source[i], t = o.source[o.next[i]];
      const Place2 a0 = at(s, 0), b0 = at(t, 0), a1 = moves ? at(s, 1) : a0, b1 = moves ? at(t, 1) : b0;
      const double x[4] = {a0.x, b0.x, b1.x, a1.x}, y[4] = {a0.y, b0.y, b1.y, a1.y};
      for_each_swept_run(cells, x, y, rim, [&](int r, int first, int last) { maker.bound(r, first, last); });
      touch_at_both_ends(cells, a0, b0, a1, b1, scratch, maker.touched());
      maker.wind_edge(a0.x, a0.y, b0.x, b0.y);
    }
  return std::move(maker).with_area();
}

}  // namespace

CoveredCells swept_cells(const OperandPair& base, const WindowFrame& frame, int cells, bool use) {
  std::array<double, 2> width = base.width, height = base.height;
  width[frame.moving] *= frame.tau1;
  height[frame.moving] *= frame.tau1;
  const SumGrid grid(width, height, cells);
  if (!use) return CoveredCells(grid.whole);
  const auto raster = [&](std::uint32_t op) {
    const std::vector<double>&x = base.lattice->points[op]->x, &y = base.lattice->points[op]->y;
    if (op != frame.moving)
      return rasterize(base.operands[op], grid.part[op], false, [&](std::uint32_t v, int) {
        return Place2{x[v], y[v]};
      });
    return rasterize(base.operands[op], grid.part[op], true, [&](std::uint32_t v, int end) {
      const double tau = end == 0 ? frame.tau0 : frame.tau1;
      return Place2{tau * x[v] + frame.shift_x(tau), tau * y[v] + frame.shift_y(tau)};
    });
  };
  return CoveredCells(grid.whole, raster(0), raster(1), CoveredCells::Counts::left_out);
}

using exact::BigRational;

namespace {

bool has_holes(const Operand& o) { return o.loops.size() > o.components.size(); }

// Finer than the static engine's grid: a mask is paid for once a window. Where segments abound building dominates.
int cells_for(double n) {
  const double per_root = n < 4000 ? 4 : 2.5;
  return std::clamp(static_cast<int>(per_root * std::sqrt(n)), 8, 1024);
}

constexpr std::uint32_t kMaskFrom = 300;  // segments from which a mask pays

}  // namespace

const ReducedConvolution& WindowBuilder::convolution_for(double low, double high) {
  if (convolution_ != nullptr && low >= fill_low_ && high <= fill_high_) return *convolution_;
  const auto& [p, q] = base_->operands;
  const bool holes = has_holes(p) || has_holes(q);
  fill_low_ = holes ? low / 1.5 : 0;
  fill_high_ = holes ? high * 1.5 : INFINITY;
  const auto lattice_at = [&](double s) {
    return base_->lattice_at(base_->lattice_scale(scale_value(exact::exact_value(s))));
  };
  std::array<std::shared_ptr<const Lattice>, 2> ends;
  if (holes) ends = {lattice_at(fill_low_), lattice_at(fill_high_)};
  // A hole is filled throughout where it is at the end of the range at which it is largest in proportion.
  const auto filled = [&](const Operand& holed, const Loop& hole, const Operand& other, const Component& component) {
    return hole_is_filled(*ends[holed.op == base_->moved ? 1 : 0], holed, hole, other, component);
  };
  convolution_ = std::make_shared<ReducedConvolution>(*base_->lattice, p, q, filled);
  memory_ = std::make_shared<CoverMemory>(convolution_->size());
  return *convolution_;
}

std::array<double, 2> WindowBuilder::sizes(double s) const {
  std::array<double, 2> size{};
  for (std::uint32_t op = 0; op < 2; ++op)
    size[op] = std::max(base_->width[op], base_->height[op]) * (op == base_->moved ? s : 1);
  return size;
}

WindowSettings WindowBuilder::settings_for(const BigRational& low, const BigRational& high, double at) const {
  WindowSettings settings;
  const std::uint32_t k = base_->moved;
  const std::array<double, 2> size = sizes(at);
  const bool scaled_moves = size[k] <= size[1 - k];
  settings.frame.moving = scaled_moves ? k : 1 - k;
  // A little wider than requested, so that rounding cannot leave anything out.
  const double a = exact::round_to_double(scaled_moves ? low : BigRational(1 / high));
  const double b = exact::round_to_double(scaled_moves ? high : BigRational(1 / low));
  settings.frame.tau0 = a * exact::kInwards;
  settings.frame.tau1 = b * exact::kOutwards;
  settings.frame.centre_x = base_->width[settings.frame.moving] / 2;
  settings.frame.centre_y = base_->height[settings.frame.moving] / 2;
  settings.shrink = shrink;
  settings.edges_prove = edges_prove;
  return settings;
}

WindowSettings WindowBuilder::with_grid(WindowSettings settings) const {
  settings.cells = cells_for(convolution_->size());
  settings.mask = convolution_->size() >= kMaskFrom;
  return settings;
}

// At that width the ends of the moving operand sweep kSweep cells.
double WindowBuilder::widest(double s) const {
  constexpr double kSweep = 4.5;
  const std::array<double, 2> size = sizes(s);
  const double cells = convolution_ == nullptr ? 64 : cells_for(convolution_->size());
  const double moving = std::min(size[0], size[1]), cell = (size[0] + size[1]) / cells;
  return moving > 0 ? kSweep * cell / (0.5 * moving) : 1;
}

std::unique_ptr<Window> WindowBuilder::between(const BigRational& low, const BigRational& high, bool covers,
                                               const std::function<void()>& again) {
  const double a = exact::round_to_double(low), b = exact::round_to_double(high);
  // The convolution of all scales of the window, which is a little wider on either side, or of one over those.
  constexpr double kWider = exact::kOutwards * exact::kOutwards * exact::kOutwards;
  const ReducedConvolution& convolution = convolution_for(a / kWider, b * kWider);
  WindowSettings settings = with_grid(settings_for(low, high, a));
  settings.covers = covers;
  settings.again = again;
  return std::make_unique<Window>(*base_, convolution, settings);
}

WindowPlan WindowBuilder::plan(double low, double high, double at, std::uint64_t most_pairs) {
  convolution_for(low, high);
  WindowPlan plan{family_, base_, low, high, convolution_, memory_, {}};
  plan.settings = with_grid(settings_for(exact::exact_value(low), exact::exact_value(high), at));
  plan.settings.most_pairs = most_pairs;
  plan.settings.memory = memory_.get();
  return plan;
}

namespace {

constexpr std::size_t kMostRatios = 4;

}  // namespace

Factors factors_of(const ScaleValue& x, const ScaleValue& y) {
  if (x == y) return {};
  const exact::BigRational ratio = rational(y) / rational(x);
  if (ratio < 1) return {{}, scale_value(ratio)};
  return {scale_value(exact::BigRational(1 / ratio)), {}};
}

RatioSweep* RatioSweeps::find(const Factors& factors) {
  const auto found =
      std::find_if(sweeps_.begin(), sweeps_.end(), [&](const RatioSweep& s) { return s.factors == factors; });
  if (found == sweeps_.end()) return nullptr;
  sweeps_.splice(sweeps_.begin(), sweeps_, found);
  return &sweeps_.front();
}

RatioSweep* RatioSweeps::make(const OperandPair& base, const Factors& factors) {
  const exact::BigRational least(1, exact::BigInteger(1) << OperandPair::kFactorBits);
  if (rational(factors.x) < least || rational(factors.y) < least || !base.may_be_stretched()) return nullptr;
  if (sweeps_.size() == kMostRatios) sweeps_.pop_back();
  auto stretched = base.stretched(factors.x, factors.y);
  const std::uint64_t family = ++made_;
  sweeps_.push_front({family, factors, stretched, WindowBuilder(stretched, family)});
  return &sweeps_.front();
}

}  // namespace dymsum::planar
