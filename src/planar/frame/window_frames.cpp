#include "planar/frame/window_frames.h"

#include <algorithm>
#include <cmath>

#include "planar/operand/sum_bounds.h"
#include "planar/position/exact_source.h"
#include "planar/sum/placed_sum.h"

namespace dymsum::planar {
namespace {

// The map from the window's coordinates to those of the input.
struct ToInput {
  ToInput(const Window& window, const ExactFrame& frame) : span(window.span()) {
    const Lattice& l = *frame.base().lattice;
    grow = frame.blow_up(window.frame().moving);
    unit = l.unit;
    const double s = frame.value().approx;
    const PlacedPoints& moved = *l.points[frame.base().moved];
    const Point scaled{moved.offset.x * moved.factors.x, moved.offset.y * moved.factors.y};
    const Point& other = l.points[1 - frame.base().moved]->offset;
    origin = Two{scaled.x * s + other.x, scaled.y * s + other.y};
    reach = (std::abs(scaled.x) + std::abs(scaled.y)) * s + std::abs(other.x) + std::abs(other.y);
  }
  Two operator()(const Two& at) const { return both(grow) * at * both(unit) + origin; }
  double error(double of_point) const {
    return grow * (of_point + kKeptPosition * span) * unit * exact::kOutwards + kKeptOffsets * reach +
           exact::kSubnormal;
  }
  double span, grow = 1, unit = 1, reach = 0;
  Two origin{};
};

}  // namespace

// The position at which a ring of the last frame started, or 0.
std::size_t LoopRings::likely_start(const FrameLoop& loop) const {
  const auto led =
      std::find_if(loop.vertices.begin(), loop.vertices.end(), [&](std::uint32_t v) { return leads_[v] != 0; });
  return led == loop.vertices.end() ? 0 : static_cast<std::size_t>(led - loop.vertices.begin());
}

void LoopRings::lead(std::vector<std::uint32_t> leaders) {
  for (const std::uint32_t v : leaders_) leads_[v] = 0;
  for (const std::uint32_t v : leaders) leads_[v] = 1;
  leaders_ = std::move(leaders);
}

KeptRings LoopRings::at(double tau, const Window& window, const ExactFrame& frame, const ExactSource& source,
                        const std::function<SumRing()>& spare) {
  const ToInput to_input(window, frame);
  const double poor = kPoorPosition * window.span();
  const VertexOrder order(source, to_input.error(poor));
  const SumVertex* const vertices = loops_.vertices().data();
  const MovingPoint* const points = loops_.points().data();
  // Returns the bound on what it puts. By value: what it writes cannot be any of these.
  const auto put = [=, &source](std::uint32_t vertex, SumVertex& to) {
    to = vertices[vertex];
    const MovingPoint& v = points[vertex];
    if (v.error <= poor) {
      const Two at = to_input(v.at(tau));
      to.at = {at[0], at[1]};
      return v.error;
    }
    const ExactSource::Position p = source.position(to);
    to.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
    return poor;
  };
  double error = 0;
  std::vector<std::uint32_t> leaders;
  leads_.resize(loops_.vertices().size(), 0);
  KeptRings kept;
  for (FrameLoop& loop : loops_.loops()) {
    if (!loop.kept) continue;
    if (loop.vertices.empty())
      for (const LoopStep& step : loop.steps)
        if (step.vertex != kNone) loop.vertices.push_back(step.vertex);
    SumRing ring = spare();
    const WrittenRing written = write_ring(loop.vertices, likely_start(loop), order, put, ring);
    leaders.push_back(written.leader);
    error = std::max(error, written.error);
    kept.rings.push_back(std::move(ring));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  lead(std::move(leaders));
  kept.at_error = to_input.error(error);
  return kept;
}

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
