#include "shape/features/shape_features.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/double_text.h"
#include "base/poll.h"
#include "shape/features/boundary_loops.h"

namespace dymsum {
namespace {

using namespace shape;  // NOLINT(google-build-using-namespace)

FeatureBar public_bar(const ShapeFeatures::State& state, const Bar& bar) {
  const Complex& complex = state.complex;
  const Node& birth = complex.nodes[state.tracks.junctions[bar.birth].nodes.front()];
  FeatureBar result;
  result.born = birth.kind == Node::Kind::corner ? FeatureBar::Birth::corner : FeatureBar::Birth::neck;
  result.died = bar.death == Bar::Death::merged   ? FeatureBar::Death::merged
                : bar.death == Bar::Death::filled ? FeatureBar::Death::filled
                                                  : FeatureBar::Death::never;
  result.birth = birth.rank;
  result.birth_alpha = 2 * birth.radius;
  result.death_alpha = INFINITY;
  if (bar.end != kNoIndex) {
    const Node& end = complex.nodes[state.tracks.junctions[bar.end].nodes.front()];
    result.death = end.rank;
    result.death_alpha = 2 * end.radius;
  }
  if (bar.parent != kNoIndex) result.parent = bar.parent;
  if (birth.kind == Node::Kind::corner) result.vertex = birth.vertex;
  const std::uint32_t left = complex.edges[bar.first].left, right = complex.edges[bar.first].right;
  const auto is_of_hole = [&](std::uint32_t s) { return state.loops.loops[state.loops.loop_of_site[s]].encloses; };
  result.in_hole = is_of_hole(left) || is_of_hole(right);
  result.loop = state.loops.loop_of_site[left];
  if (bar.minimum != kNoIndex) {
    result.minimum = state.loops.vertices[bar.minimum].vertex;
    result.loop = state.loops.loop_of[bar.minimum];
    result.concavity = bar.concavity;
  }
  return result;
}

/// Lives between two diameters as exact halves of diameters, compared with as little exact work as possible.
class Lives {
 public:
  using Number = exact::RootExpression;
  Lives(const ShapeFeatures::State& state, const Rational& from, const std::optional<Rational>& to)
      : state_(state), from_(half(from)), below_(nodes_below(state.complex, halved(from))) {
    if (to) to_ = half(*to), above_ = nodes_up_to(state.complex, halved(*to));
  }
  static Rational halved(const Rational& alpha) { return alpha / Rational(2); }
  static Number half(const Rational& alpha) {
    const Rational radius = halved(alpha);  // the parts are its own
    const exact::RationalParts& parts = exact::RationalAccess::parts(radius);
    return Number(exact::BigRational(parts.num, parts.den));
  }

  bool endless(const FeatureBar& bar) const { return !bar.death && !to_; }
  /// Ranks that distinguish equal clipped births and deaths at once: nodes at the ends of the range count as its ends.
  std::uint32_t birth_key(const FeatureBar& bar) const {
    const std::uint32_t node = state_.first_node[bar.birth];
    return node < below_ ? kNoIndex : bar.birth;
  }
  std::uint32_t death_key(const FeatureBar& bar) const {
    if (!bar.death) return kNoIndex;
    return to_ && state_.first_node[*bar.death] >= above_ ? kNoIndex : *bar.death;
  }
  Number birth(const FeatureBar& bar) const {
    return birth_key(bar) == kNoIndex ? from_ : exact_radius(state_.complex, state_.first_node[bar.birth]);
  }
  Number death(const FeatureBar& bar) const {
    return death_key(bar) == kNoIndex ? *to_ : exact_radius(state_.complex, state_.first_node[*bar.death]);
  }
  Number since(const Since& since) const {
    Number own = half_of(state_.complex, since);
    return compare(own, from_) < 0 ? from_ : own;
  }
  /// Negative for a bar outside of the range. Requires: not endless.
  Number life(const FeatureBar& bar) const { return death(bar) - birth(bar); }

 private:
  const ShapeFeatures::State& state_;
  Number from_;
  std::optional<Number> to_;
  std::uint32_t below_ = 0, above_ = 0;
};

/// Bars by their lives, or by what they are worth. Keeps a reference.
class Ranking {
 public:
  Ranking(const ShapeFeatures::State& state, const Rational& from, const std::optional<Rational>& to, bool bounded)
      : state_(state), lives_(state, from, to), bounded_(bounded) {
    for (std::uint32_t i = 0; i < state.bars.size(); ++i) worth_.push_back(worth_of(i));
  }

  std::vector<std::uint32_t> at_least(const Rational& least) const {
    const Lives::Number half = Lives::half(least);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < worth_.size(); ++i)
      if (worth_[i].by == Worth::By::nothing || (worth_[i].in_range && compare(worth_[i].half, half) >= 0))
        kept.push_back(i);
    std::sort(kept.begin(), kept.end(), [this](std::uint32_t i, std::uint32_t j) { return before(i, j); });
    return kept;
  }

 private:
  struct Worth {
    enum class By : std::uint8_t { nothing, life, concavity };
    By by = By::nothing;  ///< what bounds it
    bool in_range = true;
    Lives::Number half;
  };

  Worth worth_of(std::uint32_t i) const {
    const FeatureBar& bar = state_.bars[i];
    const TrackWorth& own = state_.tracks.bars[i].worth;
    Worth worth;
    if (!lives_.endless(bar)) {
      worth = {Worth::By::life, true, bounded_ ? lives_.death(bar) - lives_.since(own.since) : lives_.life(bar)};
      worth.in_range = exact::sign_of(worth.half) >= 0;
    }
    if (!bounded_ || !own.depth) return worth;
    const Lives::Number depth = Lives::Number(*own.depth) / Lives::Number(2);
    if (worth.by == Worth::By::nothing || compare(depth, worth.half) < 0)
      worth = {Worth::By::concavity, worth.in_range, depth};
    return worth;
  }
  /// Equal ones are mostly distinguished from others without exact work.
  bool provably_equal(std::uint32_t i, std::uint32_t j) const {
    if (worth_[i].by != worth_[j].by) return false;
    const FeatureBar &a = state_.bars[i], &b = state_.bars[j];
    const TrackWorth &x = state_.tracks.bars[i].worth, &y = state_.tracks.bars[j].worth;
    if (worth_[i].by == Worth::By::concavity) return x.depth == y.depth;
    if (lives_.death_key(a) != lives_.death_key(b)) return false;
    if (!bounded_) return lives_.birth_key(a) == lives_.birth_key(b);
    return x.since.depth == y.since.depth &&
           state_.complex.nodes[x.since.node].rank == state_.complex.nodes[y.since.node].rank;
  }
  bool before(std::uint32_t i, std::uint32_t j) const {
    const FeatureBar &a = state_.bars[i], &b = state_.bars[j];
    const bool endless = worth_[i].by == Worth::By::nothing;
    if (endless != (worth_[j].by == Worth::By::nothing)) return endless;
    if (!endless && !provably_equal(i, j))
      if (const int sign = compare(worth_[i].half, worth_[j].half); sign != 0) return sign > 0;
    return a.concavity != b.concavity ? a.concavity > b.concavity : i < j;
  }

  const ShapeFeatures::State& state_;
  Lives lives_;
  bool bounded_;
  std::vector<Worth> worth_;
};

BridgeContact contact_of(const Complex& complex, std::uint32_t site, const Position& position) {
  const Site& s = complex.sites[site];
  const Point at =
      position.exact ? Point{nearest_double(position.exact->x), nearest_double(position.exact->y)} : position.at;
  return {s.kind == Site::Kind::vertex, s.index, at};
}

/// Edges of the complex that a level crosses, as ShapeFeatures::bridges says.
std::vector<std::uint32_t> crossed_edges(const ShapeFeatures::State& state, const Rational& r) {
  const std::uint32_t below = nodes_below(state.complex, r), up_to = nodes_up_to(state.complex, r);
  std::vector<std::uint32_t> edges;
  for (std::uint32_t e = 0; e < state.complex.edges.size(); ++e) {
    const Edge& edge = state.complex.edges[e];
    if (!edge.flat && edge.low < below && (edge.high == kNoIndex || edge.high >= below)) edges.push_back(e);
  }
  for (const Junction& j : state.tracks.junctions)
    if (j.in.empty() && j.nodes.front() >= below && j.nodes.front() < up_to)
      edges.insert(edges.end(), j.out.begin(), j.out.end());
  return edges;
}

AlphaBridge public_bridge(const ShapeFeatures::State& state, std::uint32_t edge, const Rational& r) {
  const Bridge bridge = bridge_at(state.complex, state.loops, edge, r);
  AlphaBridge result;
  result.from = contact_of(state.complex, bridge.from_site, bridge.from);
  result.to = contact_of(state.complex, bridge.to_site, bridge.to);
  result.centre = disc_on_edge(state.complex, edge, r).centre;
  result.gap = !bridge.pocket;
  result.length = std::hypot(result.to.at.x - result.from.at.x, result.to.at.y - result.from.at.y);
  result.bar = state.tracks.bar_of[edge];
  if (!bridge.pocket) return result;
  result.pocket_size = length(state.loops, *bridge.pocket);
  const Deepest deepest = pocket_minimum(state.loops, *state.extremes, bridge, state.options);
  result.minimum = state.loops.vertices[deepest.vertex].vertex;
  result.concavity = deepest.concavity;
  return result;
}

/// What bars are worth over all diameters, the nearest doubles.
void add_significance(ShapeFeatures::State& state) {
  for (std::size_t i = 0; i < state.bars.size(); ++i) {
    FeatureBar& bar = state.bars[i];
    const Bar& track = state.tracks.bars[i];
    const Since& since = track.worth.since;
    bar.counts_from = 2 * state.complex.nodes[since.node].radius - kAgePerDepth * since.depth;
    bar.significance = track.worth.depth.value_or(INFINITY);
    if (!bar.death) continue;
    const exact::RootExpression life =
        exact::RootExpression(2) *
        (exact_radius(state.complex, state.first_node[*bar.death]) - half_of(state.complex, track.worth.since));
    if (!track.worth.depth || compare(life, exact::RootExpression(*track.worth.depth)) < 0)
      bar.significance = nearest_double(life);
  }
}

/// What tracks ask of pockets, with the bridges at the ends of edges.
PocketOracle oracle_of(const ShapeFeatures::State& state, const Poll& poll) {
  const auto minimum = [&state](std::uint32_t edge) {
    const Bridge bridge = bridge_at_end(state.complex, state.loops, edge);
    return bridge.pocket ? pocket_minimum(state.loops, *state.extremes, bridge, state.options) : Deepest{};
  };
  PocketOracle oracle;
  oracle.deepest = [minimum, &poll, queried = std::size_t{0},
                    edges = state.complex.edges.size()](std::uint32_t edge) mutable {
    poll.at_test(std::min(queried++, edges), edges);
    const Deepest found = minimum(edge);
    return PocketMinimumAt{found.vertex, found.concavity};
  };
  oracle.holds = [&state](std::uint32_t edge, std::uint32_t vertex) {
    const PocketSide side = pocket_side(state.complex, state.loops, edge);
    return side.chain && holds(state.loops, *side.chain, vertex);
  };
  oracle.at = [&state](std::uint32_t edge) {
    const PocketSide side = pocket_side(state.complex, state.loops, edge);
    return !side.chain ? PocketAt::gap : side.ahead ? PocketAt::ahead : PocketAt::behind;
  };
  oracle.contacts = [&state](std::uint32_t edge) { return contact_ranks(state.complex, state.loops, edge); };
  return oracle;
}

}  // namespace

Result<ShapeFeatures> ShapeFeatures::create(const Region& region, const FeatureOptions& options) {
  if (region.empty()) return Error{ErrorCode::unsupported_operand, "an empty region has no features", {}};
  if (!(options.hybrid_tolerance >= 0) || std::isinf(options.hybrid_tolerance))
    return Error{ErrorCode::out_of_range,
                 "the tolerance of hybrid2 must be finite and at least 0, not " +
                     base::general_text(options.hybrid_tolerance, 6),
                 {}};
  Result<Complex> complex = make_complex(region, Side::outside, Engine::fast, options.threads, options.progress);
  if (!complex) return complex.error();
  auto state = std::make_shared<State>();
  state->region = region;
  state->options = options;
  state->options.progress = {};
  state->complex = std::move(complex).value();
  state->loops = boundary_loops(state->complex);
  state->extremes.emplace(state->loops);
  try {
    Poll poll(options.progress);
    poll.stage("bars");
    state->tracks = tracks_of(state->complex, oracle_of(*state, poll));
    poll(1);
  } catch (const Cancelled&) {
    return cancelled();
  }
  for (std::uint32_t n = 0; n < state->complex.nodes.size(); ++n)
    if (state->complex.nodes[n].rank == state->first_node.size()) state->first_node.push_back(n);
  for (const Bar& bar : state->tracks.bars) state->bars.push_back(public_bar(*state, bar));
  add_significance(*state);
  return ShapeFeatures(std::move(state));
}

const Region& ShapeFeatures::region() const { return state_->region; }
const FeatureOptions& ShapeFeatures::options() const { return state_->options; }
const std::vector<FeatureBar>& ShapeFeatures::bars() const { return state_->bars; }
std::uint32_t ShapeFeatures::event_count() const { return std::uint32_t(state_->first_node.size()); }

double ShapeFeatures::event_alpha(std::uint32_t event) const {
  if (event >= event_count()) throw std::invalid_argument("no event has the index " + std::to_string(event));
  return 2 * state_->complex.nodes[state_->first_node[event]].radius;
}

std::string ShapeFeatures::event_text(std::uint32_t event) const {
  if (event >= event_count()) throw std::invalid_argument("no event has the index " + std::to_string(event));
  const exact::RootExpression r = exact_radius(state_->complex, state_->first_node[event]);
  return to_text(exact::RootExpression(2) * r);
}

Result<std::vector<AlphaBridge>> ShapeFeatures::bridges(const Rational& alpha) const {
  if (alpha.sign() < 0) return Error{ErrorCode::out_of_range, "alpha must be at least 0, not " + alpha.to_string(), {}};
  const Rational r = alpha / Rational(2);
  std::vector<AlphaBridge> bridges;
  for (const std::uint32_t e : crossed_edges(*state_, r)) bridges.push_back(public_bridge(*state_, e, r));
  return bridges;
}

std::vector<std::uint32_t> ShapeFeatures::lasting(const Rational& life, const Rational& from,
                                                  const std::optional<Rational>& to) const {
  return Ranking(*state_, from, to, false).at_least(life);
}

std::vector<std::uint32_t> ShapeFeatures::significant(const Rational& significance, const Rational& from,
                                                      const std::optional<Rational>& to) const {
  return Ranking(*state_, from, to, true).at_least(significance);
}

}  // namespace dymsum
