#include "cspace/motion/pivot.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "cspace/boundary/free_position.h"
#include "exact/rounding_bound.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

using exact::BigInteger;
using exact::BigRational;
using exact::Polynomial;

namespace {

Position exact_of(Point p) { return {exact::exact_value(p.x), exact::exact_value(p.y)}; }
Position minus(const Position& a, const Position& b) { return {BigRational(a.x - b.x), BigRational(a.y - b.y)}; }
BigRational cross(const Position& a, const Position& b) { return BigRational(a.x * b.y - a.y * b.x); }
BigRational dot(const Position& a, const Position& b) { return BigRational(a.x * b.x + a.y * b.y); }

// (1 + t^2) (a + b cos + g sin) times a common denominator; in chart 1 half a turn further.
Polynomial polynomial(const BigRational& a, const BigRational& b, const BigRational& g, int chart) {
  const BigRational sign = chart == 0 ? 1 : -1;
  const std::array<BigRational, 3> c{BigRational(a + sign * b), BigRational(2 * sign * g), BigRational(a - sign * b)};
  BigInteger common = 1;
  for (const BigRational& v : c) common = lcm(common, denominator(v));
  std::vector<exact::Big> whole;
  for (const BigRational& v : c) whole.emplace_back(BigInteger(numerator(v) * (common / denominator(v))));
  return Polynomial(std::move(whole));
}

// The error of a position that is rounded is this times |x| + |y|.
constexpr double kRounded = exact::rounding_bound(1, 2);
// The error of a vertex of the rotated robot is this times its reach: the heading's double and what its cosine and sine
// err by.
constexpr double kTurned = exact::rounding_bound(12 + 2, 32);
// The error of the form of a vertex over an edge is this times |edge|_1 and all coordinates: two differences and the
// position (3), products and their sums (2 for each of the three terms), and cosine and sine (16 each).
constexpr double kForm = exact::rounding_bound(3 * (3 + 2) + 2 * 16, 512);
// The error of half of the difference of two angles.
constexpr double kHalf = exact::rounding_bound(2 * 12 + 8, 8192);
// Circles that miss an edge by more than this fraction of all coordinates miss it; any fraction above a thousand
// roundings is right, as only those that come nearer are looked at.
constexpr double kNear = 0x1p-30;

// Counter-clockwise from `from`: whether a comes before b; `from` itself comes first.
bool earlier(const ExactAngle& from, const ExactAngle& a, const ExactAngle& b) {
  const bool a_ahead = compare(a, from) >= 0, b_ahead = compare(b, from) >= 0;
  return a_ahead == b_ahead ? compare(a, b) < 0 : a_ahead;
}

}  // namespace

Pivot::Pivot(const Region& robot, const Region& obstacle)
    : robot_(robot), obstacle_(obstacle), pose_(robot, obstacle) {}

void Pivot::stand(const Position& at) {
  at_ = at;
  near_ = {exact::round_to_double(at.x), exact::round_to_double(at.y)};
  error_ = kRounded * (std::abs(near_.x) + std::abs(near_.y)) + exact::kUnderflow;
}

bool Pivot::overlaps(const Orientation& theta) {
  const double c = std::cos(theta.radians()), s = std::sin(theta.radians());
  const Pose::Overlap quick = pose_.overlap(near_.x, near_.y, c, s, error_ + kTurned * pose_.reach());
  if (quick != Pose::Overlap::unsure) return quick == Pose::Overlap::yes;
  SumOptions options;
  options.semantics = Semantics::open;
  // Operands of an obstacle have a slice at every angle: coordinates are at most 2^400, of 2^1000 that sums take,
  // slices take lattices of any spread, and nothing stops this one. Where memory ends, there is no answer to return.
  const SliceMap map(std::move(cspace_slice(robot_, obstacle_, theta, options)).value());
  return map.where(SlicePoint(at_)) == SliceMap::Where::inside;
}

template <class Visit>
void Pivot::each_candidate(Visit visit) const {
  const auto n = static_cast<std::uint32_t>(pose_.robot().vertices.size());
  const auto m = static_cast<std::uint32_t>(pose_.obstacle().vertices.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      if (pose_.obstacle().next[j] != j) visit(Candidate{i, j, true});
      if (pose_.robot().next[i] != i) visit(Candidate{i, j, false});  // a point has no edge
    }
}

// d x (vertex - start of the edge), as the robot turns.
Pivot::Form Pivot::side_form(const Candidate& c) const {
  const Position r = exact_of(pose_.robot().vertices[c.robot]);
  const Position v = minus(exact_of(pose_.obstacle().vertices[c.obstacle]), at_);
  if (c.edge_of_obstacle) {
    const Position d = minus(minus(exact_of(pose_.obstacle().vertices[pose_.obstacle().next[c.obstacle]]), at_), v);
    return {BigRational(-cross(d, v)), cross(d, r), dot(d, r)};
  }
  const Position d = minus(exact_of(pose_.robot().vertices[pose_.robot().next[c.robot]]), r);
  return {BigRational(-cross(d, r)), cross(d, v), BigRational(-dot(d, v))};
}

// d . (vertex - start of the edge): on the edge where it is in [0, length].
Pivot::Form Pivot::along_form(const Candidate& c, BigRational& length) const {
  const Position r = exact_of(pose_.robot().vertices[c.robot]);
  const Position v = minus(exact_of(pose_.obstacle().vertices[c.obstacle]), at_);
  if (c.edge_of_obstacle) {
    const Position d = minus(minus(exact_of(pose_.obstacle().vertices[pose_.obstacle().next[c.obstacle]]), at_), v);
    length = dot(d, d);
    return {BigRational(-dot(d, v)), dot(d, r), BigRational(-cross(d, r))};
  }
  const Position d = minus(exact_of(pose_.robot().vertices[pose_.robot().next[c.robot]]), r);
  length = dot(d, d);
  return {BigRational(-dot(d, r)), dot(d, v), cross(d, v)};
}

// Whether the circle of the turning vertex comes near the edge at all: that of the robot's vertex about the position,
// or of the obstacle's about the robot's origin. The margin exceeds all rounding errors.
bool Pivot::in_reach(const Candidate& c) const {
  const Outline &robot = pose_.robot(), &obstacle = pose_.obstacle();
  const Point r = robot.vertices[c.robot], o = obstacle.vertices[c.obstacle], v{o.x - near_.x, o.y - near_.y};
  const Point a = c.edge_of_obstacle ? v : r;
  Point b = robot.vertices[robot.next[c.robot]];
  if (c.edge_of_obstacle) {
    const Point far = obstacle.vertices[obstacle.next[c.obstacle]];
    b = {far.x - near_.x, far.y - near_.y};
  }
  const double radius = c.edge_of_obstacle ? std::hypot(r.x, r.y) : std::hypot(v.x, v.y);
  const double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  const double most = std::max(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
  const double fraction = l > 0 ? std::clamp(-(a.x * dx + a.y * dy) / l, 0.0, 1.0) : 0.0;
  const double least = std::hypot(a.x + fraction * dx, a.y + fraction * dy);
  const double margin = kNear * (most + radius + std::abs(near_.x) + std::abs(near_.y) + std::abs(o.x) + std::abs(o.y));
  return radius <= most + margin && radius >= least - margin;
}

Contact Pivot::contact_of(const Candidate& c) {
  return {c.edge_of_obstacle ? Contact::Kind::edge_of_p : Contact::Kind::edge_of_q, c.obstacle, c.robot};
}

bool Pivot::persists(const Candidate& c) const {
  const Form f = side_form(c);
  if (f.a != 0 || f.b != 0 || f.g != 0) return false;
  BigRational length;
  const Form on = along_form(c, length);
  return on.b == 0 && on.g == 0 && on.a >= 0 && on.a <= length;
}

void Pivot::add_events(const Candidate& c, std::vector<PivotEvent>& to) const {
  const Form f = side_form(c);
  if (f.a == 0 && f.b == 0 && f.g == 0) return;
  BigRational length;
  const Form on = along_form(c, length);
  const Contact contact = contact_of(c);
  for (const int chart : {0, 1}) {
    const std::vector<exact::AlgebraicRoot> roots = exact::roots_in(polynomial(f.a, f.b, f.g, chart), -1, 1);
    if (roots.empty()) continue;
    const Polynomial low = polynomial(on.a, on.b, on.g, chart);
    const Polynomial high = polynomial(BigRational(length - on.a), BigRational(-on.b), BigRational(-on.g), chart);
    for (const exact::AlgebraicRoot& t : roots) {
      if (exact::sign_at(t, low) < 0 || exact::sign_at(t, high) < 0) continue;
      to.push_back({{chart, t}, contact});
    }
  }
}

// Whether the contact can happen within `half` of the heading: false is proved, by Taylor's formula.
bool Pivot::possible(const Candidate& c, Heading midpoint, double half) const {
  const Outline &robot = pose_.robot(), &obstacle = pose_.obstacle();
  const Point r = robot.vertices[c.robot], o = obstacle.vertices[c.obstacle], v{o.x - near_.x, o.y - near_.y};
  const Point to =
      c.edge_of_obstacle ? obstacle.vertices[obstacle.next[c.obstacle]] : robot.vertices[robot.next[c.robot]];
  const Point from = c.edge_of_obstacle ? o : r, d{to.x - from.x, to.y - from.y};
  const Point &still = c.edge_of_obstacle ? v : r, &turning = c.edge_of_obstacle ? r : v;
  const double along = d.x * turning.x + d.y * turning.y, g = c.edge_of_obstacle ? along : -along;
  const TrigForm form{-(d.x * still.y - d.y * still.x), d.x * turning.y - d.y * turning.x, g};
  const double size = std::abs(o.x) + std::abs(o.y) + std::abs(near_.x) + std::abs(near_.y) + pose_.reach();
  return !form.far_from_zero(midpoint, half, kForm * (std::abs(d.x) + std::abs(d.y)) * size);
}

void Pivot::sort_out(std::vector<PivotEvent>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const PivotEvent& a, const PivotEvent& b) { return compare(a.angle, b.angle) < 0; });
  const auto same = [](const PivotEvent& a, const PivotEvent& b) { return compare(a.angle, b.angle) == 0; };
  events.erase(std::unique(events.begin(), events.end(), same), events.end());
}

std::vector<PivotEvent> Pivot::events() const {
  std::vector<PivotEvent> events;
  each_candidate([&](const Candidate& c) {
    if (in_reach(c)) add_events(c, events);
  });
  sort_out(events);
  return events;
}

std::vector<PivotEvent> Pivot::events(const Orientation& from, const Orientation& to) const {
  const double two_pi = 2 * std::numbers::pi, a = from.radians(), b = to.radians() + (to.radians() < a ? two_pi : 0);
  const double half = 0.5 * (b - a) + kHalf;
  const Heading midpoint = Heading::of(0.5 * (a + b));
  std::vector<PivotEvent> events;
  each_candidate([&](const Candidate& c) {
    if (in_reach(c) && possible(c, midpoint, half)) add_events(c, events);
  });
  sort_out(events);
  return events;
}

std::vector<PivotGap> Pivot::gaps(const std::vector<PivotEvent>& events) {
  std::vector<PivotGap> gaps;
  const auto n = static_cast<std::uint32_t>(events.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t end = (k + 1) % n;
    gaps.push_back({k, end, overlaps(orientation_between(events[k].angle, events[end].angle))});
  }
  return gaps;
}

std::optional<Contact> Pivot::held() const {
  std::optional<Contact> held;
  each_candidate([&](const Candidate& c) {
    if (!held && in_reach(c) && persists(c)) held = contact_of(c);
  });
  return held;
}

std::vector<PivotEvent> Pivot::on_way(const Orientation& from, const Orientation& to, TurnDirection turn) const {
  const bool ahead = turn == TurnDirection::counter_clockwise;
  const ExactAngle begin = exact_angle(ahead ? from : to), end = exact_angle(ahead ? to : from);
  std::vector<PivotEvent> way = ahead ? events(from, to) : events(to, from);
  std::erase_if(way, [&](const PivotEvent& e) {
    return compare(e.angle, begin) != 0 && compare(e.angle, end) != 0 && !earlier(begin, e.angle, end);
  });
  std::stable_sort(way.begin(), way.end(),
                   [&](const PivotEvent& a, const PivotEvent& b) { return earlier(begin, a.angle, b.angle); });
  if (!ahead) std::reverse(way.begin(), way.end());
  return way;
}

std::optional<PivotStop> Pivot::stop(const Orientation& from, const Orientation& to, TurnDirection turn,
                                     Touching touch) {
  const ExactAngle last = exact_angle(to);
  PivotStop at{exact_angle(from), std::nullopt};
  if (overlaps(from)) return at;
  if (touch == Touching::forbidden)
    if (const std::optional<Contact> contact = held()) return PivotStop{at.angle, contact};
  // Whether the robot overlaps between the position reached and the next one.
  const auto blocked = [&](const ExactAngle& next) {
    if (compare(at.angle, next) == 0) return false;
    const bool ahead = turn == TurnDirection::counter_clockwise;
    return overlaps(ahead ? orientation_between(at.angle, next) : orientation_between(next, at.angle));
  };
  for (const PivotEvent& e : on_way(from, to, turn)) {
    if (blocked(e.angle)) return at;
    at = {e.angle, e.contact};
    if (touch == Touching::forbidden) return at;
  }
  if (blocked(last)) return at;
  return std::nullopt;
}

Orientation Pivot::beside(const Orientation& theta, const ExactAngle& to, TurnDirection turn) const {
  const ExactAngle from = exact_angle(theta);
  const bool ahead = turn == TurnDirection::counter_clockwise;
  ExactAngle nearest = to;
  for (const PivotEvent& e : events()) {
    if (compare(e.angle, from) == 0 || compare(e.angle, nearest) == 0) continue;
    if (ahead ? earlier(from, e.angle, nearest) : earlier(nearest, e.angle, from)) nearest = e.angle;
  }
  return ahead ? orientation_between(from, nearest) : orientation_between(nearest, from);
}

namespace {

// The robot at one position, turning: the angles at which it may stand there, single ones included. Exact.

class FreeRotation {
 public:
  /// Requires: an obstacle that lives as long as this.
  FreeRotation(const CspaceObstacle& obstacle, Point at);

  /// The marks are those of CspaceObstacle::turn_marks, the angles those of Pivot; between two of them one orientation
  /// decides what is free, at one with overlaps on both sides free_position does.
  std::vector<TurnMark> marks();
  std::vector<TurnMark> marks(const Orientation& from, const Orientation& to);

 private:
  bool is_free(const Orientation& theta) const { return !obstacle_.contains(at_.x, at_.y, theta); }
  bool is_free_at(const ExactAngle& angle);

  const CspaceObstacle& obstacle_;
  Point at_;
  Pivot pivot_;
  std::shared_ptr<const OperandPair>
      base_;  // with the position as a pair of further vertices; made when first requested
  std::optional<TurningForms> forms_;
};

FreeRotation::FreeRotation(const CspaceObstacle& obstacle, Point at)
    : obstacle_(obstacle), at_(at), pivot_(obstacle.robot(), obstacle.obstacle()) {
  pivot_.stand({exact::exact_value(at.x), exact::exact_value(at.y)});
}

// What is free on one side of an angle is free at it: overlapping is open.
std::vector<TurnMark> FreeRotation::marks() {
  const std::vector<PivotEvent> events = pivot_.events();
  const std::size_t n = events.size();
  std::vector<TurnMark> marks;
  for (std::size_t k = 0; k < n; ++k)
    marks.push_back({event_angle(events[k].angle), false,
                     is_free(orientation_between(events[k].angle, events[(k + 1) % n].angle))});
  for (std::size_t k = 0; k < n; ++k)
    marks[k].free = marks[(k + n - 1) % n].free_after || marks[k].free_after || is_free_at(events[k].angle);
  return marks;
}

std::vector<TurnMark> FreeRotation::marks(const Orientation& from, const Orientation& to) {
  const ExactAngle end = exact_angle(to);
  std::vector<TurnMark> marks;
  bool before = is_free(from);
  const std::vector<PivotEvent> events = pivot_.on_way(from, to, TurnDirection::counter_clockwise);
  for (std::size_t k = 0; k < events.size(); ++k) {
    const ExactAngle &angle = events[k].angle, &next = k + 1 < events.size() ? events[k + 1].angle : end;
    const bool after = is_free(compare(angle, end) == 0 ? to : orientation_between(angle, next));
    marks.push_back({event_angle(angle), before || after || is_free_at(angle), after});
    before = after;
  }
  return marks;
}

bool FreeRotation::is_free_at(const ExactAngle& angle) {
  if (!forms_) {
    // Robot and obstacle touch at this angle: the position is no further than both reach, 2^402 at most, of 2^1000 that
    // a pair takes; and a pair of any spread is never too wide.
    base_ = pair_of_regions(obstacle_.obstacle(), obstacle_.robot(),
                            {.moved = 1,
                             .reflect_q = true,
                             .further = {{{at_}, {Point{0, 0}}}},  // whose edges have no vertex there
                             .spread = Spread::any})
                .value();
    forms_.emplace(*base_, 1);
  }
  ExactPosition position;
  position.first.corner = {forms_->size(0), forms_->size(1)};
  return planar::is_free(SignsAt(*forms_, angle), position);
}

}  // namespace
}  // namespace dymsum::planar

namespace dymsum {

std::vector<TurnMark> CspaceObstacle::turn_marks(double x, double y) const {
  return planar::FreeRotation(*this, {x, y}).marks();
}

std::vector<TurnMark> CspaceObstacle::turn_marks(double x, double y, const Orientation& from,
                                                 const Orientation& to) const {
  return planar::FreeRotation(*this, {x, y}).marks(from, to);
}

}  // namespace dymsum
