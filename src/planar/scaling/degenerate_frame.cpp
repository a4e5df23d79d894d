#include "planar/scaling/degenerate_frame.h"

#include <algorithm>
#include <cmath>

#include "planar/arrangement/crossings.h"
#include "planar/boundary/tight_features.h"

namespace dymsum::planar {
namespace {

class WindowChain final : public Chain {
 public:
  WindowChain(const Window& window, const ReducedConvolution& convolution, Scratch* memory)
      : Chain(memory), window_(window), convolution_(convolution) {
    next_.reserve(window.segments.size());
    for (const LiveSegment& s : window.segments) next_.push_back(live(convolution.next(s.walk)));
  }
  void incident(WalkPair v, Array<Incidence>& out) const override {
    const Operand &p = window_.base().operands[0], &q = window_.base().operands[1];
    add(convolution_.find(0, v.p, v.q), true, out);
    add(convolution_.find(1, v.q, v.p), true, out);
    add(convolution_.find(0, p.prev[v.p], v.q), false, out);
    add(convolution_.find(1, q.prev[v.q], v.p), false, out);
  }

 private:
  std::uint32_t live(std::uint32_t id) const { return id == kNoRank ? kNone : window_.live[id]; }
  void add(std::uint32_t id, bool starts, Array<Incidence>& out) const {
    if (const std::uint32_t s = live(id); s != kNone) out.push_back({s, starts});
  }
  const Window& window_;
  const ReducedConvolution& convolution_;
};

}  // namespace

SumState degenerate_frame(const Window& window, const ReducedConvolution& convolution, FramePlace& place,
                          Semantics semantics) {
  SumState state;
  state.lattice = place.share_lattice();
  state.p = std::make_shared<const Operand>(place.operand(0));
  state.q = std::make_shared<const Operand>(place.operand(1));
  const Lattice& lattice = *state.lattice;
  state.stats.tier_bits = lattice.tier_bits;
  Scratch scratch;
  Soup soup(lattice, *state.p, *state.q, &scratch);
  for (const LiveSegment& s : window.segments) soup.add(s.walk, soup.box(s.walk));
  const WindowChain chain(window, convolution, &scratch);

  const double tau = place.tau(window.frame().moving);
  std::vector<std::array<std::uint32_t, 2>> pairs = window.folds;
  for (const auto& [a, b] : window.touching) pairs.push_back({std::min(a, b), std::max(a, b)});
  for (auto& pair : pairs)
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  for (const Candidate& c : window.candidates) {
    if (tau <= c.out_low || tau >= c.out_high) continue;
    const std::uint32_t a = window.pieces[c.a].segment, b = window.pieces[c.b].segment;
    pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Array<CoveredMark> marks(&scratch);
  for (const Piece& p : window.pieces) {
    const double length = window.segments[p.segment].length(tau);
    if (p.head_cut) marks.push_back({p.segment, p.head.at(tau) / length});
    if (p.tail_cut) marks.push_back({p.segment, p.tail.at(tau) / length});
  }
  // A live segment without pieces is dead as a whole.
  for (std::uint32_t s = 0; s < window.segments.size(); ++s)
    if (window.segments[s].first_piece == window.segments[s].last_piece) marks.push_back({s, 0.5});

  Meetings meetings(&scratch);
  CrossingFinder finder(soup, meetings, &chain);
  finder.pairs(pairs);
  state.stats.crossings = meetings.crossings.size();
  state.stats.pair_tests = meetings.pair_tests;
  place.exact_signs += meetings.exact_signs;
  const Arrangement arrangement(soup, std::move(meetings), chain, marks);
  state.stats.degenerate_nodes = arrangement.degenerate_nodes();
  place.exact_signs += arrangement.exact_orders();
  Array<BoundaryLoop> loops = find_loops(soup, arrangement);
  state.stats.loops = loops.size();
  Collision& collision = place.collision();
  SortedLoops sorted = verify_loops(soup, arrangement, std::move(loops), collision, place.base().connected);
  double grid_error = soup.point_error;
  if (semantics != Semantics::regular)
    find_tight_features(soup, arrangement, sorted.kept, collision, state.boundary, grid_error);
  for (const BoundaryLoop& ring : simple_rings(soup, arrangement, std::move(sorted.kept))) {
    state.boundary.rings.push_back(make_ring(soup, arrangement, ring, grid_error));
    state.boundary.outer.push_back(ring.turning > 0);
  }
  state.boundary.at_error = input_error(lattice, grid_error);
  return state;
}

}  // namespace dymsum::planar
