#include "dymsum/convex_sum.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/memory_budget.h"
#include "dymsum/convex_memory.h"
#include "spatial/convex/assemble.h"
#include "spatial/convex/close_facets.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/mixed_volume.h"

namespace dymsum {

using spatial::Polytope;

const MotionWork& ConvexSum::State::report() {
  const spatial::OverlayWork& w = overlay.work();
  work = {w.vertex_checks,
          w.vertex_errors,
          w.crossing_checks,
          w.arc_checks,
          w.arcs_changed,
          w.steps,
          w.crossings_added + w.vertex_errors,
          w.crossings_removed + w.vertex_errors,
          w.exact_signs};
  return work;
}

spatial::RelativeMap ConvexSum::State::move(const SolidPose& p_to, const SolidPose& q_to) {
  const auto take = [](const SolidPose& to, SolidPose& pose, spatial::PoseFactors& factors) {
    if (!(to.scale == pose.scale)) {
      factors = spatial::PoseFactors::of(to);
      pose.scale = to.scale;
    }
    factors.rotation = pose.rotation = to.rotation;
  };
  take(p_to, p_pose, p_factors);
  take(q_to, q_pose, q_factors);
  return spatial::RelativeMap(p_factors, q_factors);
}

ConvexSum::ConvexSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
ConvexSum::ConvexSum(const ConvexSum& other) : state_(std::make_unique<State>(*other.state_)) {}
ConvexSum& ConvexSum::operator=(const ConvexSum& other) { return *this = ConvexSum(other); }
ConvexSum::ConvexSum(ConvexSum&&) noexcept = default;
ConvexSum& ConvexSum::operator=(ConvexSum&&) noexcept = default;
ConvexSum::~ConvexSum() = default;

namespace {

/// Marks of some of n things.
std::vector<bool> marked(std::size_t n, const std::vector<std::uint32_t>& some) {
  std::vector<bool> marks(n);
  for (const std::uint32_t i : some) {
    if (i >= marks.size()) marks.resize(i + 1);
    marks[i] = true;
  }
  return marks;
}

std::shared_ptr<const Polytope> shared(Polytope p) { return std::make_shared<const Polytope>(std::move(p)); }

struct Operands {
  std::shared_ptr<const Polytope> p, q;
  std::shared_ptr<const spatial::ConvexOperands> source;
};

Result<Operands> operands_of(const Mesh& p, const Mesh& q) {
  Result<Polytope> a = spatial::make_polytope(p), b = spatial::make_polytope(q);
  if (!a) return a.error();
  if (!b) return b.error();
  auto source = std::make_shared<spatial::ConvexOperands>();
  source->operand[0].vertices = p.vertices();
  source->operand[1].vertices = q.vertices();
  return Operands{shared(std::move(a).value()), shared(std::move(b).value()), std::move(source)};
}

/// A crossing, its certificate and its entry among the changes, in arrays that are copied as they grow.
constexpr std::size_t kBytesPerCrossing = 3 * (sizeof(spatial::Crossing) + sizeof(double) + sizeof(std::uint32_t));

}  // namespace

ConvexSum ConvexSum::of(std::shared_ptr<const Polytope> p, std::shared_ptr<const Polytope> q,
                        std::shared_ptr<const spatial::ConvexOperands> source) {
  return spatial::ConvexSumInternals::of(std::move(p), std::move(q), std::move(source), 0).value();
}

Result<ConvexSum> spatial::ConvexSumInternals::of(std::shared_ptr<const Polytope> p, std::shared_ptr<const Polytope> q,
                                                  std::shared_ptr<const ConvexOperands> source, std::uint64_t memory) {
  ConvexSum made(std::make_unique<State>(std::move(p), std::move(q), std::move(source)));
  State& state = *made.state_;
  if (memory != 0) {
    if (made.bytes() > memory)
      return base::budget_error("the sum of convex solids takes at least", made.bytes(), memory);
    state.overlay.limit_crossings((memory - made.bytes()) / kBytesPerCrossing);
  }
  try {
    state.overlay.build(spatial::RelativeMap());
  } catch (const spatial::TooManyCrossings&) {
    return Error{ErrorCode::out_of_memory,
                 "the sum of convex solids takes more memory than the limit of " + base::memory_text(memory),
                 {}};
  }
  state.overlay.limit_crossings(std::numeric_limits<std::size_t>::max());
  state.report();
  state.overlay.forget_changes();
  // What a crossing takes was counted on roughly.
  if (memory != 0 && made.bytes() > memory)
    return base::budget_error("the sum of convex solids takes", made.bytes(), memory);
  return made;
}

Result<ConvexSum> ConvexSum::create(const Mesh& p, const Mesh& q) { return convex_sum_within(p, q, 0); }

Result<ConvexSum> convex_sum_within(const Mesh& p, const Mesh& q, std::uint64_t memory) {
  Result<Operands> made = operands_of(p, q);
  if (!made) return made.error();
  Operands operands = *std::move(made);
  return spatial::ConvexSumInternals::of(std::move(operands.p), std::move(operands.q), std::move(operands.source),
                                         memory);
}

const MotionWork& ConvexSum::set(const SolidPose& p, const SolidPose& q) {
  state_->overlay.update(state_->move(p, q));
  return state_->report();
}

const MotionWork& ConvexSum::rebuild(ConvexEngine engine) {
  return rebuild(SolidPose(p_pose()), SolidPose(q_pose()), engine);
}

const MotionWork& ConvexSum::rebuild(const SolidPose& p, const SolidPose& q, ConvexEngine engine) {
  const spatial::RelativeMap map = state_->move(p, q);
  if (engine == ConvexEngine::walk) {
    state_->overlay.build(map);
  } else {
    state_->overlay.build_brute(map);
  }
  return state_->report();
}

const SolidPose& ConvexSum::p_pose() const { return state_->p_pose; }
const SolidPose& ConvexSum::q_pose() const { return state_->q_pose; }
const MotionWork& ConvexSum::work() const { return state_->work; }
int spatial::tier_bits(const Polytope& p, const Polytope& q) {
  const int bits = std::max(p.bits, q.bits);
  return bits <= 26 ? 26 : bits <= 61 ? 61 : 0;
}
int ConvexSum::tier_bits() const { return spatial::tier_bits(*state_->p, *state_->q); }
std::size_t ConvexSum::face_vertex_count() const { return state_->p->face_count() + state_->q->face_count(); }
std::size_t ConvexSum::edge_edge_count() const { return state_->overlay.crossing_count(); }
std::size_t ConvexSum::bytes() const {
  std::size_t total =
      sizeof(*state_) - sizeof(spatial::Overlay) + state_->overlay.bytes() + state_->p->bytes() + state_->q->bytes();
  for (const spatial::ConvexOperands::Operand& o : state_->source->operand) total += o.bytes();
  if (state_->kept) total += state_->kept->bytes() - sizeof(*state_->kept);
  return total;
}
bool ConvexSum::same_combinatorics(const ConvexSum& other) const { return state_->overlay == other.state_->overlay; }

// Every face makes a facet, a pair that faces the same way one together, and so does every crossing that has an area.
ConvexSum::FacetCount ConvexSum::facet_count() const {
  const spatial::Overlay& o = state_->overlay;
  const std::vector<bool> new_p = marked(o.poly(0).face_count(), o.changes().faces[0]),
                          new_q = marked(o.poly(1).face_count(), o.changes().faces[1]),
                          new_crossing = marked(0, o.changes().crossings);
  const auto count = [](const std::vector<bool>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
  };
  FacetCount facets{new_p.size() + new_q.size(), count(new_p) + count(new_q)};
  facets.all -= o.pairs().size();
  for (const spatial::FacePair& pair : o.pairs()) facets.changed -= new_p[pair.p] && new_q[pair.q];
  spatial::CloseFacets close;
  close.find(o);
  for (std::uint32_t e = 0; e < o.poly(0).edge_count(); ++e)
    for (std::uint32_t id = o.first_crossing(0, e); id != spatial::kNoCrossing; id = o.crossing(id).next[0]) {
      if (close.of_crossing(id) && !spatial::crosses_properly(o, o.crossing(id))) continue;
      ++facets.all;
      facets.changed += id < new_crossing.size() && new_crossing[id];
    }
  return facets;
}

std::vector<SolidContact> ConvexSum::changed_facets() const {
  std::vector<SolidContact> changed;
  for (const spatial::ConvexFacets::Facet& facet : spatial::assemble(state_->overlay).facets)
    if (facet.changed) changed.push_back({facet.p, facet.q});
  std::sort(changed.begin(), changed.end());
  return changed;
}

RationalPoint3 ConvexSum::exact(Vertex vertex) const {
  const auto& operand = state_->source->operand;
  if (vertex.p >= operand[0].size() || vertex.q >= operand[1].size())
    throw std::invalid_argument("ConvexSum::exact: the operands have no such vertices");
  const spatial::ExactPositions positions(*state_->source, state_->p_pose, state_->q_pose);
  const spatial::BigVector a = positions.of(0, vertex.p), b = positions.of(1, vertex.q);
  const auto value = [&](std::size_t k) {
    return exact::to_rational(exact::BigRational(exact::BigInteger(a[k] + b[k])) * positions.unit());
  };
  return {value(0), value(1), value(2)};
}

const ConvexSolid& ConvexSum::solid() {
  State& s = *state_;
  if (!s.kept) s.kept.emplace(s.overlay, *s.source);
  s.kept->follow(s.overlay, s.p_pose, s.q_pose);
  return s.kept->solid();
}

Rational ConvexSum::volume_exact() const {
  return exact::to_rational(spatial::exact_mixed_volume(state_->overlay, state_->p_pose, state_->q_pose));
}
double ConvexSum::volume() const {
  if (const std::optional<double> v = spatial::mixed_volume(state_->overlay, state_->p_factors, state_->q_factors))
    return *v;
  return exact::round_to_double(spatial::exact_mixed_volume(state_->overlay, state_->p_pose, state_->q_pose));
}

}  // namespace dymsum
