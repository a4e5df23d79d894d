// Makes windows of scales: the convolution of a range of scales, the grid, and which operand moves in the window;
// for scales of one ratio too.
#pragma once

#include <list>
#include <memory>
#include <optional>

#include "exact/big.h"
#include "planar/window/edge_search.h"

namespace dymsum::planar {

/// All that a window for frames is made of, so that any thread can.
struct WindowPlan {
  std::uint64_t family = 0;
  std::shared_ptr<const OperandPair> base;
  double low = 0, high = 0;
  std::shared_ptr<const ReducedConvolution> convolution;
  std::shared_ptr<CoverMemory> memory;  ///< used by one window at a time
  WindowSettings settings;
};

class WindowBuilder {
 public:
  /// `family`: of the windows for frames.
  explicit WindowBuilder(std::shared_ptr<const OperandPair> base, std::uint64_t family = 0)
      : base_(std::move(base)), family_(family) {}

  /// A window for the events in [low, high]; without `covers` also of crossings inside the sum. `again` is called now
  /// and then and may throw.
  std::unique_ptr<Window> between(const exact::BigRational& low, const exact::BigRational& high, bool covers = false,
                                  const std::function<void()>& again = {});
  /// A plan for frames in (low, high), near `at` at first; abandoned when more than `most_pairs` boxes meet. Plans of
  /// one convolution share a memory.
  WindowPlan plan(double low, double high, double at, std::uint64_t most_pairs);
  /// The width, as a logarithm, beyond which masks lose more than longer windows gain.
  double widest(double s) const;

  /// The reduced convolution of all scales in [low, high], perhaps of more.
  const ReducedConvolution& convolution_for(double low, double high);
  /// The one the last window was made from: its ids are the window's.
  std::shared_ptr<const ReducedConvolution> convolution() const { return convolution_; }
  /// The settings of a window for scales in [low, high]: all but the grid. At `at` the smaller operand moves.
  WindowSettings settings_for(const exact::BigRational& low, const exact::BigRational& high, double at) const;
  double shrink = 1;  ///< tests only, see WindowSettings

 private:
  WindowSettings with_grid(WindowSettings settings) const;
  std::array<double, 2> sizes(double s) const;

  std::shared_ptr<const OperandPair> base_;
  std::uint64_t family_ = 0;
  std::shared_ptr<CoverMemory> memory_;  ///< of windows for frames, made from convolution_
  std::shared_ptr<const ReducedConvolution> convolution_;
  double fill_low_ = 0, fill_high_ = 0;  ///< scales for which the convolution's filled holes are right
};

/// What scales of one ratio have in common: diag(x, y) with the larger one 1. Of uniform scales both are. diag(s, r s)
/// times an operand is s times the operand stretched by diag(1, r), so that windows of uniform scales serve them.
struct Factors {
  ScaleValue x, y;
  bool uniform() const { return x == y; }
  friend bool operator==(const Factors&, const Factors&) = default;
};
/// The factors of diag(x, y).
Factors factors_of(const ScaleValue& x, const ScaleValue& y);

struct RatioSweep {
  std::uint64_t family;  ///< of its windows; 0 is that of uniform scales
  Factors factors;
  std::shared_ptr<const OperandPair> base;  ///< the stretched one
  WindowBuilder windows;
};

/// The sweeps of the last few ratios.
class RatioSweeps {
 public:
  /// That of a ratio, if it is known.
  RatioSweep* find(const Factors& factors);
  /// Makes one. Nothing where windows cannot serve: for ratios beyond 2^OperandPair::kFactorBits.
  RatioSweep* make(const OperandPair& base, const Factors& factors);

 private:
  std::list<RatioSweep> sweeps_;  // the most recently used first
  std::uint64_t made_ = 0;
};

}  // namespace dymsum::planar
