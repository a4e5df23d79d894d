#include "dymsum/cspace_obstacle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"
#include "cspace/obstacle/convex_obstacle.h"
#include "cspace/obstacle/event_windows.h"
#include "cspace/obstacle/obstacle_export.h"
#include "cspace/obstacle/obstacle_sweep.h"
#include "dymsum/region.h"
#include "exact/orient.h"
#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// Passages through a point: where rings touch, a straight wire may pass between them, through a point: without
// clearance, but turning and sliding.

/// The direction from z to a point, or the opposite one.
struct SectorEnd {
  Point to;
  bool opposite = false;
};

struct Sector {
  SectorEnd from, to;  ///< counter-clockwise
};

class Around {
 public:
  explicit Around(Point z) : z_(z) {}

  bool passable(const Region& region) const {
    const std::vector<Sector> free = free_sectors(region);
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Sector opposite{{free[j].from.to, true}, {free[j].to.to, true}};
        if (starts_in(free[i].from, opposite) || starts_in(opposite.from, free[i])) return true;
      }
    return false;
  }

 private:
  struct Ray {
    Point to;
    bool out;  // along a ring, which has the region on its left
  };

  // What is filled lies counter-clockwise from a ring's way out to its way in.
  std::vector<Sector> free_sectors(const Region& region) const {
    std::vector<Ray> rays;
    const auto add = [&](const Ring& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()];
        if (a == z_ || inside_edge(a, b)) rays.push_back({b, true});
        if (b == z_ || inside_edge(a, b)) rays.push_back({a, false});
      }
    };
    for (const Part& part : region.parts()) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
    }
    const auto half = [&](Point p) { return p.y > z_.y || (p.y == z_.y && p.x > z_.x) ? 0 : 1; };
    std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
      return half(a.to) != half(b.to) ? half(a.to) < half(b.to) : exact::orient_sign(z_, a.to, b.to) > 0;
    });
    std::vector<Sector> free;
    for (std::size_t k = 0; k < rays.size(); ++k)
      if (!rays[k].out) free.push_back({{rays[k].to}, {rays[(k + 1) % rays.size()].to}});
    return free;
  }
  bool inside_edge(Point a, Point b) const {
    if (z_.x < std::min(a.x, b.x) || z_.x > std::max(a.x, b.x) || z_.y < std::min(a.y, b.y) ||
        z_.y > std::max(a.y, b.y))
      return false;
    return z_ != a && z_ != b && exact::orient_sign(a, b, z_) == 0;
  }

  int cross(const SectorEnd& a, const SectorEnd& b) const {
    return exact::orient_sign(z_, a.to, b.to) * (a.opposite == b.opposite ? 1 : -1);
  }
  bool ahead(const SectorEnd& a) const { return (a.to.x != z_.x ? a.to.x > z_.x : a.to.y > z_.y) != a.opposite; }
  // Counter-clockwise from a to b: 0 for no turn, 1 for less than a half one, 2 for a half one, 3 for more.
  int turn(const SectorEnd& a, const SectorEnd& b) const {
    const int c = cross(a, b);
    return c != 0 ? (c > 0 ? 1 : 3) : ahead(a) == ahead(b) ? 0 : 2;
  }
  // Whether u is in [from, to).
  bool starts_in(const SectorEnd& u, const Sector& s) const {
    const int a = turn(s.from, u), b = turn(s.from, s.to);
    return a != b ? a < b : (a == 1 || a == 3) && cross(u, s.to) > 0;
  }

  Point z_;
};

/// A touching point of a region through which straight lines of a whole range of directions pass without meeting its
/// interior on the way: they enter by one of the free sectors there and leave by another one. None where each free
/// sector lies opposite to a filled one, as where a vertex touches the midpoint of an edge. Exact. O(n) per touching
/// point.
std::optional<Point> point_passage(const Region& region) {
  for (const Point& z : region.touching_points())
    if (Around(z).passable(region)) return z;
  return std::nullopt;
}

// The obstacle of any two regions: windows of angles, their events, and the sweep over them.

void count(const PreparedWindow& p, ObstacleWork& work) {
  ++work.windows;
  work.segments += p.window->segments.size();
  work.candidate_pairs += p.found.pairs;
  work.candidate_triples += p.found.triples;
  work.potential_events += p.found.events.size();
}

/// Queries whether to go on, on the thread that made it, and stops on the others too.
class RotationPoll {
 public:
  explicit RotationPoll(const Progress& progress) : progress_(progress) {}
  void at(double fraction) { fraction_ = fraction; }
  void operator()() {
    if (std::this_thread::get_id() == caller_ && progress_ && !progress_("angles", fraction_)) stop_ = true;
    if (stop_.load(std::memory_order_relaxed)) throw Cancelled{};
  }

 private:
  const Progress& progress_;
  const std::thread::id caller_ = std::this_thread::get_id();
  double fraction_ = 0;
  std::atomic<bool> stop_{false};
};

// Ranges are prepared side by side, some at a time, and passed one after the other. Throws Cancelled.
void pass_turn(const EventWindows& windows, ObstacleSweep& sweep, RotationPoll& poll,
               const std::function<void()>& again) {
  constexpr int kAtATime = 16;
  std::vector<std::vector<PreparedWindow>> some(kAtATime);
  bool started = false, halved = false;
  for (int first = 0; first < windows.count(); first += kAtATime) {
    poll.at(static_cast<double>(first) / windows.count());
    again();
    const int last = std::min(windows.count(), first + kAtATime);
    base::parallel_parts(static_cast<std::size_t>(last - first), 0, [&](std::size_t k) {
      const bool at_once = halved && k > 0;
      some[k] = windows.prepare(first + static_cast<int>(k),
                                at_once ? EventWindows::Halved::always : EventWindows::Halved::where_crowded, again);
    });
    // Where all of some ranges had to be halved the next ones will have to be as well; their first one is asked.
    halved = std::all_of(some.begin(), some.begin() + (last - first),
                         [](const std::vector<PreparedWindow>& parts) { return parts.size() > 1; });
    for (int k = 0; k < last - first; ++k)
      for (PreparedWindow& p : some[static_cast<std::size_t>(k)]) {
        count(p, sweep.work());
        if (!started) sweep.start(p.range, p.found, *p.filter);
        started = true;
        sweep.pass(p.range, std::move(p.found), *p.filter, p.at_end);
      }
    if (last == windows.count()) sweep.close(*some[static_cast<std::size_t>(last - first - 1)].back().filter);
  }
}

std::uint64_t surfaces(const TurningForms& forms, const RotationCatalog& catalog) {
  std::uint64_t n = 0;
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < forms.size(side); ++e)
      for (std::uint32_t v = 0; v < forms.size(1 - side); ++v) n += catalog.may_exist({side, e, v});
  return n;
}

/// Fills everything but robot, obstacle and base, which are set. Errors: cancelled; unsupported_operand for
/// regions that touch themselves.
Result<void> general_obstacle(planar::ObstacleState& state, const ObstacleOptions& options) {
  const bool touching = !state.robot.touching_points().empty() || !state.obstacle.touching_points().empty();
  const std::shared_ptr<const OperandPair> base = touching ? numbered_by_walk(*state.base) : state.base;
  const TurningForms forms(*base);
  const RotationCatalog catalog(forms);
  if (static_cast<double>(forms.size(0)) * forms.size(1) > 0x1p27)
    return Error{ErrorCode::unsupported_operand, "more than 2^27 pairs of vertices", {}};
  RotationPoll poll(options.progress);
  const std::function<void()> again = [&] { poll(); };
  ObstacleSweep sweep(forms, catalog, base, options.reference, again);
  // It names contacts as regions do, and knows no pieces without area.
  if (!touching && !options.reference) {
    PlanarLocalOptions near_events;  // boxes lie anywhere: nothing of the last one is near the next one
    near_events.engine = LocalEngine::hierarchy;
    if (Result<PlanarLocalSum> near = PlanarLocalSum::create(state.obstacle, state.robot, near_events))
      sweep.use(*std::move(near));
  }
  try {
    pass_turn(EventWindows(forms, catalog, options.reference), sweep, poll, again);
  } catch (const Cancelled&) {
    return cancelled();
  }
  const SweptBoundary& found = sweep.found();
  export_obstacle(found, forms, state);
  state.always_concurrent = found.always_concurrent;
  state.work = found.work;
  state.work.surfaces = surfaces(forms, catalog);
  for (const ObstacleEvent& e : found.events) {
    state.work.alignments += e.kind == ObstacleEvent::Kind::alignment;
    state.work.vertex_events += e.kind == ObstacleEvent::Kind::vertex_on_segment;
    state.work.triple_events += e.kind == ObstacleEvent::Kind::three_segments;
    state.work.tight_events += e.kind == ObstacleEvent::Kind::tight;
  }
  state.work.visible_events = found.events.size();
  return {};
}

}  // namespace
}  // namespace dymsum::planar

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
