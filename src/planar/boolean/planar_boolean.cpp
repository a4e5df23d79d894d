#include "planar/boolean/planar_boolean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "base/scratch.h"
#include "dymsum/planar_boolean.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/boolean/boolean_boundary.h"
#include "planar/result/planar_sum.h"
#include "planar/result/result_region.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

BooleanTerms terms_of_rings(RingSet rings) { return {{std::make_shared<const RingSet>(std::move(rings))}, {0}}; }

RingSet rings_of(const Region& region) {
  std::vector<Ring> rings;
  for (const Part& part : region.parts()) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  return {std::move(rings), Fill::positive, {}, {}, {}};
}

RingSet set_of(const Region& region) {
  RingSet set = rings_of(region);
  set.lines = region.polylines();
  set.points = region.points();
  return set;
}

/// The rings of a result at their exact positions, and its segments and points if they count.
RingSet set_of(const PlanarSum& sum, bool with_pieces) {
  RingSet set;
  bool doubles = true;
  if (!sum.parts.empty() || with_pieces) set.fractions = positions_of(sum);
  auto at = set.fractions.begin();
  const auto next = [&] {
    const Point nearest{exact::round_to_double(at->x, at->w), exact::round_to_double(at->y, at->w)};
    doubles &= is_double(*at, nearest);
    ++at;
    return nearest;
  };
  const auto add = [&](const SumRing& ring) {
    Ring& points = set.rings.emplace_back();
    for (std::size_t k = 0; k < ring.vertices.size(); ++k) points.push_back(next());
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  for (std::size_t k = 0; k < sum.segments.size() && with_pieces; ++k) {
    const Point from = next();
    set.lines.push_back({from, next()});
  }
  for (std::size_t k = 0; k < sum.points.size() && with_pieces; ++k) set.points.push_back(next());
  if (doubles) set.fractions.clear();
  else set.fractions.erase(at, set.fractions.end());  // of what does not count
  return set;
}

}  // namespace

void BooleanTerms::append(const BooleanTerms& other) {
  std::vector<std::int32_t> index;
  for (const auto& input : other.inputs) {
    const auto known = std::find(inputs.begin(), inputs.end(), input);
    index.push_back(static_cast<std::int32_t>(known - inputs.begin()));
    if (known == inputs.end()) inputs.push_back(input);
  }
  for (const std::int32_t step : other.steps) steps.push_back(step < 0 ? step : index[static_cast<std::size_t>(step)]);
}

void append_difference(const BooleanTerms& a, const BooleanTerms& b, BooleanTerms& to) {
  to.append(a);
  to.append(b);
  to.steps.insert(to.steps.end(), {BooleanTerms::kNot, BooleanTerms::kAnd});
}

Membership BooleanTerms::evaluate(std::span<const Membership> in, std::vector<Membership>& stack) const {
  stack.clear();
  for (const std::int32_t step : steps) {
    if (step >= 0) {
      stack.push_back(in[static_cast<std::size_t>(step)]);
      continue;
    }
    Membership& top = stack.back();
    if (step == kNot) {
      top = {!top.open, !top.closed};
      continue;
    }
    const Membership last = top;
    stack.pop_back();
    Membership& to = stack.back();
    if (step == kAnd) to = {to.closed && last.closed, to.open && last.open};
    else to = {to.closed || last.closed, to.open || last.open};
  }
  return stack.empty() ? Membership{} : stack.back();
}

BooleanTerms terms_of_parts(const PlanarOperand& operand) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_rings(rings_of(**region));
  return terms_of_rings(set_of(*std::get<const PlanarSum*>(operand.set()), false));
}

BooleanTerms terms_of(const PlanarOperand& operand, Semantics semantics) {
  const bool with_pieces = semantics != Semantics::regular;
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_rings(with_pieces ? set_of(**region) : rings_of(**region));
  const PlanarSum& sum = *std::get<const PlanarSum*>(operand.set());
  if (const auto* made = dynamic_cast<const BooleanSource*>(exact_source(sum).get())) return made->terms();
  return terms_of_rings(set_of(sum, with_pieces));
}

namespace {

using Kind = SegmentInputs::Kind;
using exact::HomogeneousPoint;

/// A vertex that is to be one of the region.
struct JoinedVertex {
  Point at;
  const HomogeneousPoint* exact = nullptr;  ///< null where the double is
  std::uint32_t index = 0, input = 0;
  Kind kind = Kind::ring;
};

HomogeneousPoint exact_position(const JoinedVertex& v) {
  return v.exact != nullptr ? *v.exact : exact::homogeneous(v.at.x, v.at.y);
}

bool same_position_as(const JoinedVertex& a, const JoinedVertex& b) {
  if (a.exact == nullptr && b.exact == nullptr) return a.at == b.at;
  const HomogeneousPoint u = exact_position(a), v = exact_position(b);
  return u.x * v.w == v.x * u.w && u.y * v.w == v.y * u.w;
}

class InputJoiner {
 public:
  explicit InputJoiner(const BooleanTerms& terms) {
    for (const auto& input : terms.inputs) exact_ |= !input->fractions.empty();
    for (const auto& input : terms.inputs) {
      fraction_ = input->fractions.empty() ? nullptr : input->fractions.data();
      for (const Ring& ring : input->rings) add_ring(ring);
      for (const Polyline& line : input->lines) add_line(line);
      for (const Point& point : input->points) points_.push_back(next(point, Kind::from_point));
      ++input_;
    }
    // Along a chain that runs to the right segments hardly cross.
    std::sort(points_.begin(), points_.end(), [](const JoinedVertex& a, const JoinedVertex& b) {
      return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    for (std::size_t k = 0; k < points_.size(); ++k) add_point(k);
  }

  JoinedInputs joined() && {
    // The region's vertices are those of all parts, then those of all polylines.
    for (const std::vector<JoinedVertex>* vertices : {&rings_, &lines_})
      for (const JoinedVertex& v : *vertices) {
        out_.region.vertex_indices.push_back(v.index);
        out_.input.push_back(v.input);
        out_.kind.push_back(v.kind);
        if (exact_) fractions_.push_back(exact_position(v));
      }
    out_.region.edge_indices = out_.region.vertex_indices;
    if (exact_) out_.region.fractions = std::make_shared<const std::vector<HomogeneousPoint>>(std::move(fractions_));
    return std::move(out_);
  }

 private:
  JoinedVertex next(Point at, Kind kind) {
    return {at, fraction_ != nullptr ? fraction_++ : nullptr, index_++, input_, kind};
  }

  // What does not count: a vertex that repeats the one before it, a ring of two vertices. Fractions are of results,
  // which have neither.
  void add_ring(const Ring& ring) {
    const bool any = fraction_ != nullptr;
    std::vector<JoinedVertex> kept;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const JoinedVertex v = next(ring[k], Kind::ring);
      if (any || ring[k] != ring[k + 1 == ring.size() ? 0 : k + 1]) kept.push_back(v);
    }
    if (kept.size() < 3) return;
    Ring& own = out_.region.own.parts.emplace_back().outer;
    for (const JoinedVertex& v : kept) own.push_back(v.at);
    rings_.insert(rings_.end(), kept.begin(), kept.end());
  }

  void add_line(const Polyline& line) {
    Polyline& own = out_.region.own.polylines.emplace_back();
    for (const Point& v : line) {
      own.push_back(v);
      lines_.push_back(next(v, Kind::line));
    }
  }

  // To some vertex elsewhere: windings cancel, and what lies between belongs to nothing.
  void add_point(std::size_t k) {
    const JoinedVertex& point = points_[k];
    JoinedVertex other = elsewhere(k);
    other.index = index_++;
    other.input = point.input;
    other.kind = Kind::to_point;
    out_.region.own.polylines.push_back({point.at, other.at});
    lines_.push_back(point);
    lines_.push_back(other);
  }
  JoinedVertex elsewhere(std::size_t k) const {
    const JoinedVertex& point = points_[k];
    for (std::size_t next = k + 1; next < points_.size(); ++next)
      if (!same_position_as(points_[next], point)) return points_[next];
    for (const std::vector<JoinedVertex>* vertices : {&rings_, &lines_, &points_})
      for (const JoinedVertex& v : *vertices)
        if (!same_position_as(v, point)) return v;
    // Nothing is anywhere else.
    JoinedVertex twice = point;
    twice.exact = nullptr;
    twice.at = point.at == Point{0, 0} ? Point{1, 0} : Point{2 * point.at.x, 2 * point.at.y};
    return twice;
  }

  JoinedInputs out_;
  std::vector<JoinedVertex> rings_, lines_, points_;
  std::vector<HomogeneousPoint> fractions_;
  const HomogeneousPoint* fraction_ = nullptr;
  bool exact_ = false;
  std::uint32_t index_ = 0, input_ = 0;
};

}  // namespace

JoinedInputs joined_inputs(const BooleanTerms& terms) { return InputJoiner(terms).joined(); }

SegmentInputs segments_of(const JoinedInputs& joined, const Operand& operand) {
  SegmentInputs segments;
  for (std::uint32_t e = 0; e < operand.size(); ++e) {
    const std::uint32_t start = operand.source[e];
    segments.input.push_back(joined.input[start]);
    segments.kind.push_back(joined.kind[start]);
    segments.thin |= segments.kind.back() != Kind::ring;
  }
  return segments;
}

}  // namespace dymsum::planar

namespace dymsum {
namespace {

using planar::BooleanTerms;

/// Every walk edge of P at the one vertex of Q.
planar::Soup soup_of(const planar::SumState& state, Scratch& scratch) {
  planar::Soup soup(*state.lattice, *state.p, *state.q, &scratch);
  soup.reserve(state.p->size());
  for (std::uint32_t e = 0; e < state.p->size(); ++e) soup.add({0, e, 0});
  return soup;
}

/// What windings are counted of: of every input, or of all together. Of regions, which go around no position more than
/// once nor backward, the union is where the latter are positive, and where it only touches itself does not matter for
/// regular semantics. Windings of n inputs at every edge would take n times as long, and as much memory.
enum class Inputs : std::uint8_t { each, as_one };

// The stages, one after the other. Returns the pieces without interior.
planar::PieceCandidates find_boundary(const BooleanTerms& all, const planar::JoinedInputs& joined, Inputs inputs,
                                      const SumOptions& options, planar::SumState& state) {
  const BooleanTerms terms = inputs == Inputs::as_one ? BooleanTerms{{all.inputs[0]}, {0}} : all;
  Poll poll(options.progress);
  Scratch scratch;
  const planar::Soup soup = soup_of(state, scratch);
  planar::SegmentInputs segments = planar::segments_of(joined, *state.p);
  if (inputs == Inputs::as_one) std::fill(segments.input.begin(), segments.input.end(), 0u);
  state.stats.reduced_segments = state.stats.live_segments = soup.size();
  poll.stage("crossings");
  planar::Meetings meetings = planar::every_meeting(soup, poll);
  state.stats.crossings = meetings.crossings.size();
  state.stats.pair_tests = meetings.pair_tests;
  state.stats.exact_signs = meetings.exact_signs;
  poll.stage("arrangement");
  const planar::SegmentGraph graph(soup, std::move(meetings));
  state.stats.exact_signs += graph.exact_orders();
  for (const planar::SegmentGraph::Node& node : graph.nodes())
    state.stats.degenerate_nodes += node.end.pair && node.passes > 2;
  poll.stage("windings");
  const planar::InputWindings windings(soup, graph, segments.input, terms.inputs.size(), poll);
  poll.stage("boundary");
  planar::BooleanBoundary found = planar::boolean_boundary(soup, graph, windings, segments, terms);
  state.boundary = std::move(found.boundary);
  state.stats.loops = state.boundary.rings.size();
  state.stats.peak_bytes = scratch.peak_bytes();
  poll(1);
  return std::move(found.pieces);
}

PlanarSum finished(planar::SumState&& state, const planar::PieceCandidates& pieces, Semantics semantics) {
  // What sums with a point have of lower dimension is what was found here.
  SumOptions open;
  open.semantics = Semantics::open;
  if (semantics == Semantics::regular) state.boundary.cracks.clear(), state.boundary.punctures.clear();
  PlanarSum result = planar::finish_sum(std::move(state), open);
  if (semantics == Semantics::closed)
    planar::merge_pieces(static_cast<const planar::SumSource&>(*exact_source(result)), {}, pieces, result.segments,
                         result.points);
  return result;
}

}  // namespace

namespace {

Result<PlanarSum> evaluated(BooleanTerms terms, Inputs inputs, const SumOptions& options) {
  const auto budget = base::budget_of(options.memory);
  return base::within_memory(budget, "the Boolean operation", [&]() -> Result<PlanarSum> {
    const planar::JoinedInputs joined = planar::joined_inputs(terms);
    PlanarSum result;
    if (!joined.region.own.parts.empty() || !joined.region.own.polylines.empty()) {
      planar::EngineRegion origin;
      origin.own.points.push_back({0, 0});
      Result<planar::SumState> placed =
          planar::placed_state(planar::make_operand(joined.region, 0), planar::make_operand(origin, 1),
                               planar::SumInternals::min_tier_bits(options));
      if (!placed) return placed.error();
      planar::SumState state = std::move(placed).value();
      try {
        const planar::PieceCandidates pieces = find_boundary(terms, joined, inputs, options, state);
        result = finished(std::move(state), pieces, options.semantics);
      } catch (const Cancelled&) {
        return cancelled();
      }
    }
    // A result of no rings has no positions, and is an operand without what made it.
    if (exact_source(result) != nullptr)
      exact_source(result) = std::make_shared<planar::BooleanSource>(exact_source(result), std::move(terms));
    return result;
  });
}

}  // namespace

Result<PlanarSum> planar::evaluate(BooleanTerms terms, const SumOptions& options) {
  return evaluated(std::move(terms), Inputs::each, options);
}

namespace {

/// One expression after the other, and what combines each with the ones before it.
Result<PlanarSum> combine(std::span<const PlanarOperand> sets, std::int32_t step, Inputs inputs,
                          const SumOptions& options) {
  BooleanTerms all;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    all.append(planar::terms_of(sets[k], options.semantics));
    if (k > 0) all.steps.push_back(step);
  }
  return evaluated(std::move(all), inputs, options);
}

}  // namespace

Result<PlanarSum> united(std::span<const PlanarOperand> sets, const SumOptions& options) {
  const bool regions = std::all_of(sets.begin(), sets.end(), [](const PlanarOperand& set) {
    return std::holds_alternative<const Region*>(set.set());
  });
  const bool as_one = regions && sets.size() > 1 && options.semantics == Semantics::regular;
  return combine(sets, BooleanTerms::kOr, as_one ? Inputs::as_one : Inputs::each, options);
}

Result<PlanarSum> intersection(std::span<const PlanarOperand> sets, const SumOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one set, not 0", {}};
  return combine(sets, BooleanTerms::kAnd, Inputs::each, options);
}

Result<PlanarSum> united(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return united(std::array{a, b}, options);
}

Result<PlanarSum> intersection(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return intersection(std::array{a, b}, options);
}

Result<PlanarSum> difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  BooleanTerms terms;
  planar::append_difference(planar::terms_of(a, options.semantics), planar::terms_of(b, options.semantics), terms);
  return planar::evaluate(std::move(terms), options);
}

Result<PlanarSum> symmetric_difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  // Both are made from one reading of the operands, so that their inputs are the same.
  const BooleanTerms p = planar::terms_of(a, options.semantics), q = planar::terms_of(b, options.semantics);
  BooleanTerms terms;
  planar::append_difference(p, q, terms);
  planar::append_difference(q, p, terms);
  terms.steps.push_back(BooleanTerms::kOr);
  return planar::evaluate(std::move(terms), options);
}

Result<PlanarSum> filled(const RegionData& data, Fill fill, const SumOptions& options) {
  planar::RingSet set{{}, fill, {}, {}, {}};
  for (const Part& part : data.parts) {
    set.rings.push_back(part.outer);
    set.rings.insert(set.rings.end(), part.holes.begin(), part.holes.end());
  }
  for (const Ring& ring : set.rings)
    for (const Point& v : ring)
      if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
        Error error{ErrorCode::not_finite, "a coordinate is not finite", {}};
        error.evidence.x = v.x;
        error.evidence.y = v.y;
        return error;
      }
  BooleanTerms terms{{std::make_shared<const planar::RingSet>(std::move(set))}, {0}};
  return planar::evaluate(std::move(terms), options);
}

std::string FillReport::to_string() const {
  const auto counted = [](std::size_t n, const char* one) {
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
  };
  return counted(rings, "ring") + " filled to " + std::to_string(rings_now) + " at " + counted(crossings, "crossing") +
         "; " + rounding.to_string();
}

Result<FilledRegion> repair_with_fill(const RegionData& data, Fill fill) {
  const auto rings_of = [](const RegionData& region) {
    std::size_t n = region.parts.size();
    for (const Part& part : region.parts) n += part.holes.size();
    return n;
  };
  FilledRegion made;
  made.report.rings = made.report.rings_now = rings_of(data);
  if (Result<Region> valid = Region::create(data)) {
    made.region = std::move(valid).value();
    return made;
  }
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<PlanarSum> set = filled(data, fill, options);
  if (!set) return set.error();
  Result<SnapRounded> rounded = snap_rounded(*set);
  if (!rounded) return rounded.error();
  RegionData all = rounded->region.data();
  made.report.filled = true;
  made.report.rings_now = rings_of(all);
  made.report.crossings = set->stats.crossings + set->stats.degenerate_nodes;
  made.report.rounding = rounded->rounding;
  all.polylines.insert(all.polylines.end(), data.polylines.begin(), data.polylines.end());
  all.points.insert(all.points.end(), data.points.begin(), data.points.end());
  Result<Region> region = Region::create(std::move(all));
  if (!region) return region.error();
  made.region = std::move(region).value();
  return made;
}

}  // namespace dymsum
