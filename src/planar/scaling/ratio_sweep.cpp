#include "planar/scaling/ratio_sweep.h"

#include <algorithm>

namespace dymsum::planar {

namespace {

constexpr std::size_t kMostRatios = 4;

}  // namespace

Stretch stretch_of(const ScaleValue& x, const ScaleValue& y) {
  if (x == y) return {};
  const exact::BigRational ratio = rational(y) / rational(x);
  if (ratio < 1) return {{}, scale_value(ratio)};
  return {scale_value(exact::BigRational(1 / ratio)), {}};
}

RatioSweep* RatioSweeps::find(const Stretch& stretch) {
  const auto found =
      std::find_if(sweeps_.begin(), sweeps_.end(), [&](const RatioSweep& s) { return s.stretch == stretch; });
  if (found == sweeps_.end()) return nullptr;
  sweeps_.splice(sweeps_.begin(), sweeps_, found);
  return &sweeps_.front();
}

RatioSweep* RatioSweeps::make(const OperandPair& base, const Stretch& stretch) {
  const exact::BigRational least(1, exact::BigInteger(1) << OperandPair::kStretchBits);
  if (rational(stretch.x) < least || rational(stretch.y) < least || !base.may_be_stretched()) return nullptr;
  if (sweeps_.size() == kMostRatios) sweeps_.pop_back();
  auto stretched = base.stretched(stretch.x, stretch.y);
  const std::uint64_t family = ++made_;
  sweeps_.push_front({family, stretch, stretched, WindowBuilder(stretched, family)});
  return &sweeps_.front();
}

}  // namespace dymsum::planar
