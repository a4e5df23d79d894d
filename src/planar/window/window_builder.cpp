#include "planar/window/window_builder.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"

namespace dymsum::planar {

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
