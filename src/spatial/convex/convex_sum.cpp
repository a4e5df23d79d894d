#include "spatial/convex/convex_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/memory_budget.h"
#include "dymsum/convex_memory.h"
#include "dymsum/convex_sum.h"
#include "exact/grid.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/mixed_volume.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

/// Facets whose corners are still pairs of vertices of the polytopes.
class Drafts {
 public:
  explicit Drafts(const Overlay& overlay) : o_(overlay) {
    for (int op = 0; op < 2; ++op) {
      changed_[op].assign(o_.poly(op).face_count(), false);
      for (const std::uint32_t f : o_.changes().faces[op]) changed_[op][f] = true;
    }
    const std::size_t count = o_.poly(0).face_count() + o_.poly(1).face_count() + o_.crossing_count();
    close_.find(o_);
    facets.reserve(count);
    corners.reserve(5 * count);
  }

  std::vector<ConvexFacets::Facet> facets;
  std::vector<VertexPair> corners;

  void add_faces() {
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f) {
        const std::size_t first = corners.size();
        const FacetFeatures features =
            close_.of_face(op, f) ? append_face(o_, op, f, corners) : append_face_and_vertex(o_, op, f, corners);
        if (corners.size() == first) continue;  // there already, as a face of P
        close(first, features, changed_[op][f] || (features.parallel != kNoFace && changed_[1][features.parallel]));
      }
  }

  void add_crossings() {
    std::vector<bool> is_new;
    for (const std::uint32_t id : o_.changes().crossings) {
      if (id >= is_new.size()) is_new.resize(id + 1);
      is_new[id] = true;
    }
    for (std::uint32_t e = 0; e < o_.poly(0).edge_count(); ++e)
      for (std::uint32_t id = o_.first_crossing(0, e); id != kNoCrossing; id = o_.crossing(id).next[0]) {
        const Crossing& c = o_.crossing(id);
        if (close_.of_crossing(id) && !crosses_properly(o_, c)) continue;
        const std::size_t first = corners.size();
        const FacetFeatures features = append_crossing(o_, c, corners);
        close(first, features, id < is_new.size() && is_new[id]);
      }
  }

 private:
  void close(std::size_t first, const FacetFeatures& features, bool changed) {
    facets.push_back({first, static_cast<std::uint32_t>(corners.size() - first), changed, features.p, features.q});
  }

  const Overlay& o_;
  CloseFacets close_;
  std::array<std::vector<bool>, 2> changed_;
};

/// The vertices of all corners by P's, and the index of each corner's.
void name_corners(const Overlay& overlay, const std::vector<VertexPair>& corners, ConvexFacets& all) {
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  std::vector<std::uint32_t> begin(p.vertex_count() + std::size_t{1}, 0);  // by P's vertex
  for (const VertexPair& c : corners) ++begin[c.p + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> of_p(corners.size());
  for (std::uint32_t k = 0; k < corners.size(); ++k) of_p[begin[corners[k].p]++] = k;  // begin becomes end
  all.corners.resize(corners.size());
  std::vector<std::uint32_t> named(q.vertex_count(),
                                   0);  // how many vertices there were with the last one of Q's vertex
  std::uint32_t k = 0;
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
    const std::size_t first = all.vertices.size();
    for (; k < begin[v]; ++k) {
      const std::uint32_t w = corners[of_p[k]].q;
      if (named[w] <= first) {
        all.vertices.push_back({p.source_vertex[v], q.source_vertex[w]});
        named[w] = static_cast<std::uint32_t>(all.vertices.size());
      }
      all.corners[of_p[k]] = named[w] - 1;
    }
  }
}

}  // namespace

ConvexFacets assemble(const Overlay& overlay) {
  Drafts drafts(overlay);
  drafts.add_faces();
  drafts.add_crossings();
  ConvexFacets all;
  name_corners(overlay, drafts.corners, all);
  all.facets = std::move(drafts.facets);
  return all;
}

}  // namespace dymsum::spatial

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

// The vertex that is extreme in a direction: the sum of those of the operands. Ties are decided by position, as then
// both are of one vertex of the sum: sums of extreme vertices may lie inside its edges and facets.

namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using spatial::HalfEdge;
using spatial::Vec3;

/// A direction, then those that decide ties.
using Directions = std::array<exact::Vector3<Big>, 4>;

bool rises(const Directions& directions, const exact::Vector3<Big>& along) {
  for (const exact::Vector3<Big>& d : directions)
    if (const int s = sign(exact::dot(d, along)); s != 0) return s > 0;
  return false;
}

/// Climbs in doubles, then exactly from there: doubles may stop short, but never for long.
std::uint32_t extreme_vertex(const Polytope& p, Vec3 direction, const Directions& directions) {
  std::uint32_t v = 0;
  for (std::size_t steps = 0; steps < p.vertex_count(); ++steps) {
    double most = 0;
    std::uint32_t best = v;
    for (const HalfEdge h : p.leaving(v)) {
      const double rise = dot(direction, p.along(h));
      if (rise <= most) continue;
      most = rise;
      best = p.target(h);
    }
    if (best == v) break;
    v = best;
  }
  for (bool climbs = true; climbs;) {
    climbs = false;
    for (const HalfEdge h : p.leaving(v)) {
      if (!rises(directions, p.edge_vector<Big>(h))) continue;
      v = p.target(h);
      climbs = true;
      break;
    }
  }
  return v;
}

}  // namespace

ConvexSum::Support ConvexSum::support(Point3 direction) const {
  const State& s = *state_;
  const std::array<double, 3> d{direction.x, direction.y, direction.z};
  for (const double c : d)
    if (!std::isfinite(c)) throw std::invalid_argument("ConvexSum::support: the direction is not finite");
  const int exponent = exact::common_exponent(d);
  std::array<Big, 3> b;
  for (std::size_t k = 0; k < 3; ++k) b[k] = exact::grid_coordinate<Big>(d[k], exponent);
  std::array<std::uint32_t, 2> v{};
  for (int op = 0; op < 2; ++op) {
    const spatial::ExactPose pose = spatial::ExactPose::of(op == 0 ? s.p_pose : s.q_pose);
    // Turned back into the operand's own coordinates: m^T d. The vertex of the sum that comes last in the order by the
    // direction, x, y and z is the sum of those of the operands.
    std::array<Big, 3> back;
    for (std::size_t c = 0; c < 3; ++c)
      back[c] = Big(pose.matrix[c]) * b[0] + Big(pose.matrix[3 + c]) * b[1] + Big(pose.matrix[6 + c]) * b[2];
    const auto row = [&](std::size_t k) {
      return exact::Vector3<Big>{Big(pose.matrix[k]), Big(pose.matrix[k + 1]), Big(pose.matrix[k + 2])};
    };
    const Directions directions{exact::Vector3<Big>{back[0], back[1], back[2]}, row(0), row(3), row(6)};
    v[op] =
        extreme_vertex(s.poly(op), spatial::rounded(directions[0], -spatial::bit_length(directions[0])), directions);
  }
  Support result;
  result.vertex = {s.p->source_vertex[v[0]], s.q->source_vertex[v[1]]};
  const spatial::ExactPositions positions(*s.source, s.p_pose, s.q_pose);
  const spatial::BigVector x = positions.of(0, result.vertex.p), y = positions.of(1, result.vertex.q);
  const auto rounded = [&](std::size_t k) {
    return exact::round_to_double(BigRational(BigInteger(x[k] + y[k])) * positions.unit());
  };
  result.at = {rounded(0), rounded(1), rounded(2)};
  return result;
}

}  // namespace dymsum
