// Many copies of one shape, each at its own scale: a sweep whose scales are all known beforehand.
#include <algorithm>
#include <map>
#include <numeric>

#include "base/poll.h"
#include "dymsum/solid_scale_events.h"
#include "dymsum/solid_scale_range.h"
#include "exact/big.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {

// Many copies of one shape, each at its own scale: a sweep whose scales are all known beforehand.

namespace {

constexpr double kWidestRun = 1.13;   // beyond it windows sweep too much
constexpr std::size_t kLeastRun = 6;  // a window costs about as much as five sums
constexpr double kBeyond = 0x1p-20;   // after the last scale of a run, which lies inside the window; any value is right

/// How wide a window, for each of the scales, which ascend strictly, its frame may build, relatively; 0: none, as too
/// few follow closely.
std::vector<double> planned_windows(const std::vector<double>& scales) {
  std::vector<double> widths(scales.size(), 0);
  for (std::size_t i = 0; i < scales.size();) {
    std::size_t end = i + 1;
    while (end < scales.size() && scales[end] <= kWidestRun * scales[i]) ++end;
    if (end - i < kLeastRun) {
      ++i;
      continue;
    }
    std::fill(widths.begin() + static_cast<std::ptrdiff_t>(i), widths.begin() + static_cast<std::ptrdiff_t>(end),
              scales[end - 1] / scales[i] - 1 + kBeyond);
    i = end;
  }
  return widths;
}

/// The copies' numbers by scale, ascending: one list for each different scale.
std::vector<std::vector<std::size_t>> by_scale(const std::vector<ScaledCopy>& copies) {
  std::vector<std::size_t> order(copies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto value = [&](std::size_t i) { return exact::exact_value(copies[i].scale.exact()); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double u = copies[a].scale.approx(), v = copies[b].scale.approx();
    return u != v ? u < v : value(a) < value(b);
  });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t i : order) {
    if (groups.empty() || !(copies[groups.back()[0]].scale == copies[i].scale)) groups.emplace_back();
    groups.back().push_back(i);
  }
  return groups;
}

}  // namespace

Result<std::vector<CopySum>> scaled_copies(const Region& master, const Region& q, const std::vector<ScaledCopy>& copies,
                                           const MovingOptions& options) {
  MovingOptions scaling = options;
  scaling.moving = MovingOperand::p;
  scaling.kept_window_bytes = 0;  // scales ascend
  Result<std::shared_ptr<const planar::OperandPair>> base = planar::pair_of_regions(master, q, scaling);
  if (!base) return base.error();
  planar::ScalingState state(std::move(base).value(), scaling);
  const bool plan = options.mode == FrameMode::automatic && options.window == 0;
  const std::vector<std::vector<std::size_t>> groups = by_scale(copies);
  std::vector<double> scales;
  for (const auto& group : groups) scales.push_back(copies[group[0]].scale.approx());
  const std::vector<double> widths = planned_windows(scales);
  std::vector<CopySum> result(copies.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (options.progress && !options.progress("copies", static_cast<double>(g) / static_cast<double>(groups.size())))
      return cancelled();
    if (plan) {
      state.options.mode = widths[g] > 0 ? FrameMode::window : FrameMode::rebuild;
      state.options.window = widths[g];
    }
    const Scale& s = copies[groups[g][0]].scale;
    const Result<FrameChanges> moved = state.move_to(s, s);
    if (!moved) return moved.error();
    for (const std::size_t i : groups[g]) result[i] = {state.sum, copies[i].at, {}};
    result[groups[g][0]].work = state.work;
  }
  return result;
}

// Many copies of one solid, each at its own scale, from one convolution.

Result<std::vector<SolidCopySum>> scaled_solid_copies(const Mesh& master, const Mesh& q,
                                                      const std::vector<ScaledSolidCopy>& copies,
                                                      const Progress& progress) {
  SolidScaleOptions options;
  options.moving = MovingOperand::p;
  const Result<SolidScaleEvents> sums = SolidScaleEvents::create(master, q, options);
  if (!sums) return sums.error();
  std::map<exact::BigRational, std::size_t> first;
  std::vector<SolidCopySum> result;
  result.reserve(copies.size());
  for (const ScaledSolidCopy& copy : copies) {
    if (progress && !progress("copies", static_cast<double>(result.size()) / static_cast<double>(copies.size())))
      return cancelled();
    const auto [at, fresh] = first.try_emplace(exact::exact_value(copy.scale.exact()), result.size());
    if (!fresh) {
      result.push_back({result[at->second].sum, copy.at});
      continue;
    }
    Result<SpatialSum> sum = sums->at(copy.scale, progress);
    if (!sum) return sum.error();
    result.push_back({*std::move(sum), copy.at});
  }
  return result;
}

}  // namespace dymsum
