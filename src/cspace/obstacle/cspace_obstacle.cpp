#include "dymsum/cspace_obstacle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "cspace/boundary/patch_slabs.h"
#include "cspace/events/walk_indices.h"
#include "cspace/events/walked_rings.h"
#include "cspace/obstacle/convex_obstacle.h"
#include "cspace/obstacle/general_obstacle.h"
#include "cspace/obstacle/obstacle_start.h"
#include "cspace/obstacle/point_passage.h"
#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {
namespace {

using namespace planar;

// The error of a position in the lattice's doubles is this times its span: coordinates of up to three roundings, whose
// sum is no longer than the span, and the sum. No input shows it: what Collision grants beyond its counts is as much.
constexpr double kPositionInSteps = exact::rounding_bound(3 + 1, 8);

Error unsupported(const char* message) { return {ErrorCode::unsupported_operand, message, {}}; }

std::optional<Error> beyond_range(const Ring& ring) {
  for (const Point& v : ring) {
    if (std::abs(v.x) <= kLargestCoordinate && std::abs(v.y) <= kLargestCoordinate) continue;
    Error error = unsupported("a coordinate is larger than 2^400");
    error.evidence.x = v.x;
    error.evidence.y = v.y;
    return error;
  }
  return std::nullopt;
}

std::optional<Error> beyond_range(const Region& region) {
  std::optional<Error> error;
  for_each_ring(region, [&](const Ring& ring) {
    if (!error) error = beyond_range(ring);
  });
  return error;
}

Error unsupported_at(Point at, const char* message) {
  Error error = unsupported(message);
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

bool is_segment(const Region& r) {
  return r.parts().empty() && r.points().empty() && r.polylines().size() == 1 && r.polylines()[0].size() == 2;
}
bool is_point(const Region& r) { return r.parts().empty() && r.polylines().empty() && r.points().size() == 1; }

// Where rings of one touch, the other one's bends and ends may be held in that point, and a segment pass through it,
// without clearance.
std::optional<Error> refused_at_touching(const Region& touching, const Region& thin) {
  if (touching.touching_points().empty() || !has_thin_pieces(thin) || is_point(thin)) return std::nullopt;
  if (!is_segment(thin))
    return unsupported_at(touching.touching_points()[0],
                          "rings touch here, and the other operand has polylines or points, which may be held in that "
                          "point; only one segment or one point, and parts, are supported with rings that touch");
  if (const std::optional<Point> at = point_passage(touching))
    return unsupported_at(*at,
                          "rings touch here, and the other operand is a segment, which passes between them without "
                          "clearance at a range of angles");
  return std::nullopt;
}

// Touching rings first: where a polyline is refused the other operand has none.
std::optional<Error> refused_wires(const Region& robot, const Region& obstacle) {
  if (std::optional<Error> error = refused_at_touching(obstacle, robot)) return error;
  if (std::optional<Error> error = refused_at_touching(robot, obstacle)) return error;
  for (const Region* region : {&robot, &obstacle})
    if (const std::optional<Point> at = overlapping_polylines(*region))
      return unsupported_at(*at,
                            "a polyline runs along another one, along itself or along the edge of a part: what they "
                            "share is to be given once");
  return std::nullopt;
}

auto key_of(const Contact& c) { return std::tuple{c.kind, c.p, c.q}; }

// A contact at an angle: its start, and the vector to its end.
struct PlacedContact {
  Point start, along;
};

PlacedContact placed(const OperandPair& base, const Contact& c, double cosine, double sine) {
  const std::array<const std::vector<Point>*, 2> at{&base.lattice->points[0]->input, &base.lattice->points[1]->input};
  const auto turned = [&](Point v) { return Point{cosine * v.x - sine * v.y, sine * v.x + cosine * v.y}; };
  const std::uint32_t moving = c.kind == Contact::Kind::edge_of_p ? 0 : 1, edge = moving == 0 ? c.p : c.q;
  const std::uint32_t other = moving == 0 ? c.q : c.p;
  const auto [from, to] = base.operands[moving].edge_of_index[edge];
  const Point a = (*at[moving])[from], b = (*at[moving])[to];
  const Point v = (*at[1 - moving])[base.operands[1 - moving].vertex_of_index[other]];
  const Point fixed = moving == 0 ? a : v, arm = turned(moving == 0 ? v : a), d{b.x - a.x, b.y - a.y};
  return {{fixed.x + arm.x, fixed.y + arm.y}, moving == 0 ? d : turned(d)};
}

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

// A segment that starts at a pair of the last vertices: to any vertex that is somewhere else. Of the robot where the
// obstacle is that single point.
Segment segment_from(const Lattice& l, Pair z) {
  for (const std::uint32_t op : {0u, 1u}) {
    const std::uint32_t own = op == 0 ? z.p : z.q, other = op == 0 ? z.q : z.p;
    const std::vector<Point>& input = l.points[op]->input;
    for (std::uint32_t to = 0; to < own; ++to)
      if (!(input[to] == input[own])) return {{op, own, to}, other};
  }
  throw std::logic_error("CspaceObstacle: neither operand has an area");
}

// The crossing of the line of `other` with the segment, as a fraction of it; `unless` where they look parallel.
double crossing(const PlacedContact& on, const PlacedContact& other, double unless) {
  const Point gap{other.start.x - on.start.x, other.start.y - on.start.y};
  const double fraction = cross(gap, other.along) / cross(on.along, other.along);
  return fraction >= 0 && fraction <= 1 ? fraction : fraction < 0 ? 0 : fraction > 1 ? 1 : unless;
}

}  // namespace

CspaceObstacle::CspaceObstacle(std::unique_ptr<State> state) : state_(std::move(state)) {}
CspaceObstacle::CspaceObstacle(CspaceObstacle&&) noexcept = default;
CspaceObstacle& CspaceObstacle::operator=(CspaceObstacle&&) noexcept = default;
CspaceObstacle::~CspaceObstacle() = default;

Result<std::unique_ptr<planar::ObstacleState>> planar::start_obstacle(const Region& robot, const Region& obstacle) {
  if (std::optional<Error> error = refused_pair(robot, obstacle)) return *std::move(error);
  for (const Region* region : {&robot, &obstacle})
    if (std::optional<Error> error = beyond_range(*region)) return *std::move(error);
  if (std::optional<Error> error = refused_wires(robot, obstacle)) return *std::move(error);
  auto base = pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true});
  if (!base) return base.error();
  auto state = std::make_unique<planar::ObstacleState>();
  state->robot = robot;
  state->obstacle = obstacle;
  const bool thin = has_thin_pieces(robot) || has_thin_pieces(obstacle);
  state->base = thin ? numbered_there_and_back(**base, {&state->obstacle, &state->robot}) : std::move(base).value();
  return state;
}

Result<CspaceObstacle> CspaceObstacle::create(const Region& robot, const Region& obstacle,
                                              const ObstacleOptions& options) {
  const Stopwatch watch;
  auto state = start_obstacle(robot, obstacle);
  if (!state) return state.error();
  const Result<void> done = base::within_memory(options.memory, "the obstacle", [&] {
    return is_convex_pair(**state) ? convex_obstacle(**state, options) : general_obstacle(**state, options);
  });
  if (!done) return done.error();
  (*state)->work.ms = watch.ms();
  return CspaceObstacle(std::move(state).value());
}

const Region& CspaceObstacle::robot() const { return state_->robot; }
const Region& CspaceObstacle::obstacle() const { return state_->obstacle; }
const std::vector<EventAngle>& CspaceObstacle::angles() const { return state_->angles; }
const std::vector<ObstacleEvent>& CspaceObstacle::events() const { return state_->events; }
const std::vector<TightFeature>& CspaceObstacle::tight() const { return state_->tight; }
bool CspaceObstacle::may_have_tight_curves() const { return state_->always_concurrent; }
const std::vector<Patch>& CspaceObstacle::patches() const { return state_->patches; }
const std::vector<Shell>& CspaceObstacle::shells() const { return state_->shells; }
const std::vector<FreeCell>& CspaceObstacle::free_cells() const { return state_->cells; }
const ObstacleWork& CspaceObstacle::work() const { return state_->work; }

CspaceObstacle::HalfTangent CspaceObstacle::half_tangent(std::uint32_t angle) const {
  const ExactAngle& exact = state_->exact_angles.at(angle);
  exact::RootBracket bracket = exact.t.bracket();
  bracket.refine_to(110);
  const exact::BigRational t = bracket.low().value();
  const double high = exact::double_bounds(t).first;
  return {exact.chart != 0, high, exact::double_bounds(exact::BigRational(t - exact::exact_value(high))).first};
}

std::optional<std::uint32_t> CspaceObstacle::slab_of(const Orientation& theta) const {
  const State& s = *state_;
  if (s.angles.empty()) return 0;
  std::optional<ExactAngle> exact;  // where doubles do not decide
  const double low = theta.radians() - kAngleDouble, high = theta.radians() + kAngleDouble;
  std::size_t first = 0, last = s.angles.size();  // the first angle beyond theta is in [first, last]
  while (first < last) {
    const std::size_t mid = (first + last) / 2;
    const EventAngle& e = s.angles[mid];
    const bool decided = e.high < low || e.low > high;
    if (!decided && !exact) exact = exact_angle(theta);
    const int sign = e.high < low ? -1 : e.low > high ? 1 : compare(s.exact_angles[mid], *exact);
    if (sign == 0) return std::nullopt;
    if (sign < 0) first = mid + 1;
    else last = mid;
  }
  return static_cast<std::uint32_t>((first == 0 ? s.angles.size() : first) - 1);
}

Orientation CspaceObstacle::inside(std::uint32_t slab) const {
  const std::vector<ExactAngle>& angles = state_->exact_angles;
  if (angles.empty()) return {};
  return orientation_between(angles.at(slab), angles[(slab + 1) % angles.size()]);
}

std::vector<std::vector<std::uint32_t>> CspaceObstacle::loops(std::uint32_t slab) const {
  using Key = std::tuple<Contact::Kind, std::uint32_t, std::uint32_t>;
  const std::vector<Patch>& patches = state_->patches;
  std::map<std::pair<Key, Key>, std::uint32_t> by_contacts;  // (before, own) -> patch
  for (std::uint32_t k = 0; k < patches.size(); ++k)
    if (is_in_slab(patches[k], slab, state_->angles.size()))
      by_contacts[{key_of(patches[k].left), key_of(patches[k].contact)}] = k;
  std::vector<std::uint32_t> indices;
  for (const auto& [contacts, k] : by_contacts) indices.push_back(k);
  std::sort(indices.begin(), indices.end());
  std::vector<bool> done(patches.size(), false);
  std::vector<std::vector<std::uint32_t>> loops;
  for (const std::uint32_t first : indices) {
    if (done[first]) continue;
    loops.emplace_back();
    for (std::uint32_t k = first; !done[k];) {
      done[k] = true;
      loops.back().push_back(k);
      k = by_contacts.at({key_of(patches[k].contact), key_of(patches[k].right)});
    }
  }
  return loops;
}

std::uint32_t CspaceObstacle::free_cell(std::uint32_t slab, std::uint32_t patch) const {
  const auto& cells = state_->patch_cells.at(patch);
  const Patch& p = state_->patches[patch];
  const std::size_t slabs = state_->angles.size();
  const auto offset = [&](std::uint32_t k) { return p.begin == Patch::kNone ? k : slabs_between(p.begin, k, slabs); };
  std::uint32_t cell = cells.front().second;
  for (const auto& [from, index] : cells)
    if (offset(from) <= offset(slab)) cell = index;
  return cell;
}

std::array<Point, 2> CspaceObstacle::ends(const Patch& patch, double theta) const {
  const double cosine = std::cos(theta), sine = std::sin(theta);
  const OperandPair& base = *state_->base;
  const PlacedContact own = placed(base, patch.contact, cosine, sine);
  const auto meeting = [&](const Contact& other, bool corner, double fraction) {
    if (!corner) fraction = crossing(own, placed(base, other, cosine, sine), fraction);
    return Point{own.start.x + fraction * own.along.x, own.start.y + fraction * own.along.y};
  };
  return {meeting(patch.left, patch.left_corner, 0), meeting(patch.right, patch.right_corner, 1)};
}

Result<PlanarSum> CspaceObstacle::slice(const Orientation& theta, Semantics semantics) const {
  SumOptions options;
  options.semantics = semantics;
  return placed_sum(state_->base->placed(theta), options);
}

bool CspaceObstacle::contains(double x, double y, const Orientation& theta) const {
  // The obstacle of moderate operands is moderate.
  if (!(std::abs(x) <= 4 * kLargestCoordinate && std::abs(y) <= 4 * kLargestCoordinate)) return false;
  const auto base = pair_of_regions(
      state_->obstacle, state_->robot,
      {.moved = 1, .reflect_q = true, .further = {{{Point{x, y}}, {Point{0, 0}}}}, .spread = Spread::any});
  const PlacedPair at = (*base)->placed(theta);
  const Lattice& l = *at.lattice;
  SegmentPosition position;
  position.first.pair = {static_cast<std::uint32_t>(l.points[0]->input.size() - 1),
                         static_cast<std::uint32_t>(l.points[1]->input.size() - 1)};
  const Pair z = position.first.pair;
  position.x = l.points[0]->x[z.p] + l.points[1]->x[z.q];
  position.y = l.points[0]->y[z.p] + l.points[1]->y[z.q];
  position.error = kPositionInSteps * l.span;
  position.on = segment_from(l, z);
  return Collision(l, *at.p, *at.q, true).overlaps(position);
}

}  // namespace dymsum
