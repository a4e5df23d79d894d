#include "planar/frame/frame_cost.h"

#include <algorithm>

namespace dymsum::planar {
namespace {

double of(double each, std::uint64_t n) { return each * static_cast<double>(n); }

constexpr double kWindow = 45, kSegment = 0.06, kPairOfBoxes = 0.07, kPiece = 0.5;

}  // namespace

std::uint64_t pairs_of_window(double cost, std::uint32_t all) {
  return static_cast<std::uint64_t>(std::max(0.0, cost - kWindow - of(kSegment, all)) / kPairOfBoxes);
}

double cost_of_sum(const PlanarSum& sum) {
  const SumStats& s = sum.stats;
  const double mask = 0.015 * s.mask_grid * s.mask_grid;
  return 2 + mask + of(0.005, s.reduced_segments) + of(0.31, s.crossings) + of(0.08, s.exact_signs) +
         of(0.08, sum.vertex_count()) + of(2, s.collision_tests);
}

double cost_of_window(const Window& window, std::uint32_t all) {
  return kWindow + of(kSegment, all) + of(kPairOfBoxes, window.pair_tests) + of(kPiece, window.pieces.size());
}

double cost_of_frame(const FrameWork& work, const PlanarSum& sum) {
  const double repaired = of(0.004, work.pieces) + of(0.24, work.lists_changed) + of(0.075, work.crossings_changed);
  return 0.5 + repaired + of(0.01, sum.vertex_count()) + of(8, work.collision_tests) + of(0.06, work.exact_signs) +
         (work.degenerate ? cost_of_sum(sum) : 0);
}

}  // namespace dymsum::planar
