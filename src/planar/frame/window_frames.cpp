#include "planar/frame/window_frames.h"

#include <algorithm>

#include "planar/sum/placed_sum.h"

namespace dymsum::planar {
namespace {

std::vector<std::array<std::uint32_t, 2>> pairs_at(const Window& window, double tau) {
  std::vector<std::array<std::uint32_t, 2>> pairs = window.folds;
  pairs.insert(pairs.end(), window.touching.begin(), window.touching.end());
  for (const Candidate& c : window.candidates)
    if (!(tau <= c.out_low || tau >= c.out_high))
      pairs.push_back({window.pieces[c.a].segment, window.pieces[c.b].segment});
  for (auto& pair : pairs)
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::unique_ptr<WindowFrames> window_frames(const WindowPlan& plan) {
  auto window = std::make_unique<Window>(*plan.base, *plan.convolution, plan.settings);
  if (window->abandoned) return nullptr;
  return std::make_unique<WindowFrames>(plan.family, plan.base, plan.low, plan.high, plan.convolution,
                                        std::move(window));
}

PlanarSum degenerate_frame(const Window& window, const ReducedConvolution& convolution, ExactFrame& frame,
                           Semantics semantics) {
  const double tau = frame.tau(window.frame().moving);
  BoundaryCandidates candidates{convolution, {}, window.live, pairs_at(window, tau), {}, frame.base().connected};
  for (const LiveSegment& s : window.segments) candidates.segments.push_back(s.walk);
  for (const Piece& p : window.pieces) {
    const double length = window.segments[p.segment].length(tau);
    if (p.head_cut) candidates.covered.push_back({p.segment, p.head.at(tau) / length});
    if (p.tail_cut) candidates.covered.push_back({p.segment, p.tail.at(tau) / length});
  }
  // A live segment without pieces is covered as a whole.
  for (std::uint32_t s = 0; s < window.segments.size(); ++s)
    if (window.segments[s].first_piece == window.segments[s].last_piece) candidates.covered.push_back({s, 0.5});
  CandidateSum found = sum_of_candidates(frame.placed(), candidates, frame.collision(), semantics);
  frame.exact_signs += found.exact_signs;
  return std::move(found.sum);
}

}  // namespace dymsum::planar
