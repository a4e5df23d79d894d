#include "cspace/queries/patch_forms.h"

#include "cspace/events/walked_rings.h"
#include "cspace/queries/crossing_gap.h"
#include "cspace/queries/end_curve.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace dymsum::cspace {
namespace {

// The errors of a patch's end, in units of u.
// - turned: a vector of length l by cosine, sine and angle, which err by 8 together: 8 sqrt(2) l, products and sum 2 l.
// - hinge: its turned part, the fixed part (1) and the sum: at most the size.
// - crossing: of two lines, over the sine s of their angle: the difference of two positions (3) of at most the size
//   times a unit vector (5), product, difference and quotient; the length on the edge times twice 5 and 2 for what the
//   sine errs by.
// Directions of edges that are short against the size err by more, as their ends do: that rotates a line about its
// start by no more than an end errs. Where the lines are so nearly parallel that this changes the sine, the bounds are
// larger than the edge.
constexpr double kHinge = exact::rounding_bound(14 + 1 + 1, 32);
constexpr double kCrossing = exact::rounding_bound(12, 16);
// The error of the cross product of two rotated vectors is this times their lengths; and besides, of one with a gap,
// the quotient and the product that make a position of it.
constexpr double kCross = exact::rounding_bound(2 * 14 + 3 + (14 + 3) + 3, 128);
// The error of the ranges of a box is this times the size: rotated vectors, and a dozen of products and sums.
constexpr double kBox = exact::rounding_bound(2 * 14 + 2 * 12, 8192);

// Vertices by their indices, and where the straight run that starts at each of them ends.
struct Numbered {
  std::vector<Point> at, exact;
  std::vector<std::uint32_t> run_end;
};

Numbered numbered(const Region& region) {
  std::set<std::pair<double, double>> corners;  // vertices that are not inside a straight line
  planar::for_each_ring(region.canonical(), [&](const Ring& ring) {
    for (const Point& v : ring) corners.insert({v.x, v.y});
  });
  Numbered n;
  planar::for_each_ring(region, [&](const Ring& ring) {
    const std::size_t first = n.at.size(), size = ring.size();
    n.at.insert(n.at.end(), ring.begin(), ring.end());
    for (std::size_t i = 0; i < size; ++i) {
      std::size_t k = (i + 1) % size;
      while (k != i && corners.count({ring[k].x, ring[k].y}) == 0) k = (k + 1) % size;
      n.run_end.push_back(static_cast<std::uint32_t>(first + k));
    }
  });
  return n;
}

// Contacts of numbered operands as functions of the angle.
class FormMaker {
 public:
  FormMaker(const Region& obstacle, const Region& robot, Point origin, double per_unit)
      : obstacle_(numbered(obstacle)), robot_(numbered(robot)) {
    const auto in_units = [&](Point v) { return Point{per_unit * v.x, per_unit * v.y}; };
    for (Point& v : robot_.at) v = in_units({-v.x, -v.y});
    robot_.exact = robot_.at;
    for (const Point v : obstacle_.at) obstacle_.exact.push_back(in_units(v));
    for (Point& v : obstacle_.at) v = in_units(v - origin);
    size_ = size();
  }

  ContactLine line(const Contact& c) const {
    const Numbered& moving = c.kind == Contact::Kind::edge_of_p ? obstacle_ : robot_;
    const std::uint32_t edge = c.kind == Contact::Kind::edge_of_p ? c.p : c.q;
    const Point along = moving.at[moving.run_end[edge]] - moving.at[edge];
    const double length = std::hypot(along.x, along.y);
    return {start(c), along, {along.x / length, along.y / length}, length, c.kind == Contact::Kind::edge_of_q};
  }
  // Edges start at the vertices of their numbers.
  Hinge start(const Contact& c) const { return {obstacle_.at[c.p], robot_.at[c.q]}; }

  PatchForm form(const Patch& p) const {
    PatchForm f;
    f.own = line(p.contact);
    f.left = end(p.contact, f.own, p.left, p.left_corner, start(p.contact), 0);
    f.right = end(p.contact, f.own, p.right, p.right_corner, start(p.right), f.own.length);
    return f;
  }
  double reach() const { return farthest(robot_); }
  double size() const { return farthest(obstacle_) + reach(); }

 private:
  PatchEnd end(const Contact& own, const ContactLine& l, const Contact& other, bool corner, const Hinge& hinge,
               double at) const {
    PatchEnd e;
    e.corner = corner;
    e.hinge = hinge;
    e.at = at;
    e.other = line(other);
    if (!corner) place_crossing(own, l, other, e);
    return e;
  }
  // The crossing of the line through s + R t along u with the one through o + R p along m, all unit vectors, is at
  // cross(A + R B, m) / cross(u, m), A = o - s, B = p - t, where those of u, m turn that belong to the robot.
  void place_crossing(const Contact& own, const ContactLine& l, const Contact& other, PatchEnd& e) const {
    const Point a = e.other.start.a - l.start.a, b = e.other.start.b - l.start.b, u = l.unit, m = e.other.unit;
    e.mixed = l.turns != e.other.turns;
    if (!e.mixed) {
      const double s = cross(u, m);
      e.constant = (l.turns ? cross(b, m) : cross(a, m)) / s;
      e.cosine = (l.turns ? cross(a, m) : cross(b, m)) / s;
      e.sine = (l.turns ? dot(a, m) : -dot(b, m)) / s;
      e.error = kCrossing * (size_ + l.length) / std::abs(s);
      return;
    }
    e.parallel = l.turns ? std::atan2(cross(u, m), dot(u, m)) : std::atan2(cross(m, u), dot(m, u));
    e.constant = l.turns ? dot(b, u) : dot(a, u);
    e.tangent = l.turns ? -cross(b, u) : cross(a, u);
    const auto edge = [](const Numbered& n, std::uint32_t k) { return std::array{n.exact[k], n.exact[n.run_end[k]]}; };
    const Contact &fixed = l.turns ? other : own, &turning = l.turns ? own : other;
    const CrossingGaps gaps = crossing_gaps(edge(obstacle_, fixed.p), edge(robot_, turning.q),
                                            obstacle_.exact[turning.p], robot_.exact[fixed.q]);
    e.gap = {gaps[0], l.turns ? -gaps[1] : gaps[1]};
    // The angle by which the robot rotates from its edge to the obstacle's counts.
    if (e.fast(0, l.length) || e.fast(1, l.length))
      e.half_tangent = half_tangents(edge(robot_, turning.q), edge(obstacle_, fixed.p));
  }
  static double farthest(const Numbered& n) {
    double most = 0;
    for (const Point& v : n.at) most = std::max(most, std::hypot(v.x, v.y));
    return most * exact::kOutwards;
  }
  Numbered obstacle_, robot_;
  double size_ = 0;
};

// Exact: coordinates are scaled up, and the largest to at most 2.
double per_unit_of(const Region& obstacle, const Region& robot) {
  const auto [x0, y0, x1, y1] = bounds(obstacle);
  const auto [u0, v0, u1, v1] = bounds(robot);
  double most = 0;
  for (const double v : {x0, y0, x1, y1, u0, v0, u1, v1}) most = std::max(most, std::abs(v));
  return most > 0 && most < 1 ? std::ldexp(1.0, std::min(1000, -std::ilogb(most))) : 1;
}

}  // namespace

PatchForms::PatchForms(const CspaceObstacle& obstacle) : per_unit_(per_unit_of(obstacle.obstacle(), obstacle.robot())) {
  const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
  origin_ = {x0 / 2 + x1 / 2, y0 / 2 + y1 / 2};
  const FormMaker maker(obstacle.obstacle(), obstacle.robot(), origin_, per_unit_);
  forms_.reserve(obstacle.patches().size());
  for (const Patch& p : obstacle.patches()) forms_.push_back(maker.form(p));
  size_ = maker.size();
  reach_ = maker.reach();
  for (const EventAngle& a : obstacle.angles()) angle_margin_ = std::max(angle_margin_, 2 * (a.high - a.low));
}

// The fraction is cross(gap, other) / cross(d, other): the gap errs by two hinges; what the fraction errs by is
// multiplied by the length of d, of which the fraction itself is at most one.
PlacedEnd PatchForms::end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const {
  const double e = kHinge * size_;
  if (end.corner) return {position(end.hinge, turn), e};
  const Point s = position(form.own.start, turn), d = direction(form.own, turn);
  const Point gap = position(end.other.start, turn) - s, other = direction(end.other, turn);
  const double across = cross(d, other), fraction = std::clamp(cross(gap, other) / across, 0.0, 1.0);
  const double length = std::sqrt(dot(d, d)), product = length * std::sqrt(dot(other, other));
  const double proved = std::abs(across) - kCross * product - exact::kUnderflow;
  if (!(proved > 0)) return {s, std::numeric_limits<double>::infinity()};
  const double wide = std::abs(gap.x) + std::abs(gap.y) + length;
  return {{s.x + fraction * d.x, s.y + fraction * d.y}, 2 * e + (4 * e + kCross * wide) * (product / proved)};
}

// The ends of all segments, each on the line of the contact.
PointRange PatchForms::box(const PatchForm& form, double theta, double half) const {
  const Turn turn(theta);
  const PointRange arm = turning(turn * form.own.start.b, half);
  const Point a = form.own.start.a, d = form.own.turns ? turn * form.own.unit : form.own.unit;
  const PointRange along = form.own.turns ? turning(d, half) : PointRange{{d.x, d.x}, {d.y, d.y}};
  const double margin = kBox * size_;
  PointRange box;
  for (const PatchEnd* end : {&form.left, &form.right}) {
    const Range at = EndCurve(*end, form.own.length, theta).range(-half, half);
    const PointRange there{a.x + arm.x + at * along.x, a.y + arm.y + at * along.y};
    box = end == &form.left ? there : PointRange{join(box.x, there.x), join(box.y, there.y)};
  }
  const Range wider{-margin, margin};
  return {box.x + wider, box.y + wider};
}

void PatchForms::split(const CspaceObstacle& obstacle, std::uint32_t patch, double longest,
                       std::vector<PatchPiece>& out) {
  const Patch& p = obstacle.patches()[patch];
  const auto add = [&](double low, double high) {
    const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / longest)));
    for (int k = 0; k < parts; ++k) {
      const double width = (high - low) / parts;
      out.push_back({patch, low + k * width, k + 1 == parts ? high : low + (k + 1) * width});
    }
  };
  if (p.begin == Patch::kNone) return add(-std::numbers::pi, std::numbers::pi);
  const double begin = obstacle.angles()[p.begin].theta, end = obstacle.angles()[p.end].theta;
  if (p.begin < p.end) return add(begin, end);
  if (begin < std::numbers::pi) add(begin, std::numbers::pi);
  add(-std::numbers::pi, end);
}

}  // namespace dymsum::cspace
