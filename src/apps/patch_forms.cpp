#include "patch_forms.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace dymsum::apps {
namespace {

constexpr double kPi = std::numbers::pi;

// Vertices by their numbers, and where the straight run that starts at each of them ends.
struct Numbered {
  std::vector<Point> at;
  std::vector<std::uint32_t> run_end;
};

template <class F>
void for_each_ring(const Region& region, F&& f) {
  for (const Part& part : region.parts()) {
    f(part.outer);
    for (const Ring& hole : part.holes) f(hole);
  }
}

Numbered numbered(const Region& region) {
  std::set<std::pair<double, double>> corners;  // vertices that are not in the middle of a straight line
  for_each_ring(region.canonical(), [&](const Ring& ring) {
    for (const Point& v : ring) corners.insert({v.x, v.y});
  });
  Numbered n;
  for_each_ring(region, [&](const Ring& ring) {
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
  FormMaker(const Region& obstacle, const Region& robot, Point origin)
      : obstacle_(numbered(obstacle)), robot_(numbered(robot)) {
    for (Point& v : obstacle_.at) v = v - origin;
    for (Point& v : robot_.at) v = {-v.x, -v.y};
  }

  ContactLine line(const Contact& c) const {
    const Numbered& moving = c.kind == Contact::Kind::edge_of_p ? obstacle_ : robot_;
    const std::uint32_t edge = c.kind == Contact::Kind::edge_of_p ? c.p : c.q;
    return {start(c), moving.at[moving.run_end[edge]] - moving.at[edge], c.kind == Contact::Kind::edge_of_q};
  }
  // Edges start at the vertices of their numbers.
  Hinge start(const Contact& c) const { return {obstacle_.at[c.p], robot_.at[c.q]}; }

  PatchForm form(const Patch& p) const {
    PatchForm f;
    f.own = line(p.contact);
    f.left = {p.left_corner, start(p.contact), line(p.left)};
    f.right = {p.right_corner, start(p.right), line(p.right)};
    return f;
  }
  double reach() const { return farthest(robot_); }
  double size() const { return farthest(obstacle_) + reach(); }

 private:
  static double farthest(const Numbered& n) {
    double most = 0;
    for (const Point& v : n.at) most = std::max(most, std::hypot(v.x, v.y));
    return most * (1 + 0x1p-40);
  }
  Numbered obstacle_, robot_;
};

PointRange around(Point a) { return {{a.x, a.x}, {a.y, a.y}}; }
Range join(Range a, Range b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

MovingRange moving(const Hinge& h, const Turn& turn, double half) {
  const Point arm = turn * h.b;
  return {around(h.a) + turning(arm, half), turning(quarter(arm), half), true};
}

// The direction of a line.
MovingRange moving_along(const ContactLine& l, const Turn& turn, double half) {
  if (!l.turns) return {around(l.along), around({0, 0}), true};
  const Point now = turn * l.along;
  return {turning(now, half), turning(quarter(now), half), true};
}

Range reciprocal(Range a) { return {1 / a.high, 1 / a.low}; }

// Roughly how far an angle of an obstacle is from its nearest other one.
double gap_around(const CspaceObstacle& obstacle, std::uint32_t angle) {
  const std::vector<EventAngle>& all = obstacle.angles();
  const std::size_t n = all.size();
  if (n == 1) return 2 * kPi;
  const auto apart = [&](std::size_t k) { return std::abs(std::remainder(all[k].theta - all[angle].theta, 2 * kPi)); };
  return std::min(apart((angle + 1) % n), apart((angle + n - 1) % n));
}

// a + b cos(theta) + c sin(theta), the numerator of the share at which `other` crosses `own`, at theta0 + phi: its
// coefficients of cos(phi) and sin(phi), and the value at phi = 0. One of the lines turns, the other does not.
struct Wave {
  double at_zero = 0, cosine = 0, sine = 0;
};
Wave numerator(const ContactLine& own, const ContactLine& other, const Turn& turn) {
  const Point a = other.start.a - own.start.a, b = other.start.b - own.start.b;
  if (other.turns) {
    const Point k = turn * other.along;
    const double constant = cross(b, other.along);
    return {constant + cross(a, k), cross(a, k), cross(a, quarter(k))};
  }
  const Point arm = turn * b;
  const double constant = cross(a, other.along);
  return {constant + cross(arm, other.along), cross(arm, other.along), cross(quarter(arm), other.along)};
}

}  // namespace

Range operator*(Range a, Range b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}

// v cos d + quarter(v) sin d.
PointRange turning(Point v, double half) {
  const Range c{1 - half * half / 2, 1}, s{-half, half};
  return {v.x * c + -v.y * s, v.y * c + v.x * s};
}

PatchForms::PatchForms(const CspaceObstacle& obstacle) {
  const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
  origin_ = {x0 / 2 + x1 / 2, y0 / 2 + y1 / 2};
  const FormMaker maker(obstacle.obstacle(), obstacle.robot(), origin_);
  forms_.reserve(obstacle.patches().size());
  for (const Patch& p : obstacle.patches()) forms_.push_back(maker.form(p));
  size_ = maker.size();
  reach_ = maker.reach();
  for (const EventAngle& a : obstacle.angles()) angle_margin_ = std::max(angle_margin_, 2 * (a.high - a.low));
  for (std::uint32_t p = 0; p < forms_.size(); ++p)
    for (PatchEnd* end : {&forms_[p].left, &forms_[p].right})
      find_coincidence(obstacle, obstacle.patches()[p], forms_[p].own, *end);
}

// With phi = theta - theta0 and both lines the same at phi = 0, numerator and denominator are q sin(phi) - p (1 -
// cos(phi)) with p = 0 for the denominator; tan(phi / 2) = (1 - cos(phi)) / sin(phi). Where the crossing lasts until
// lines become parallel, it stays on the edges, hence they coincide.
void PatchForms::find_coincidence(const CspaceObstacle& obstacle, const Patch& patch, const ContactLine& own,
                                  PatchEnd& end) const {
  if (end.corner || patch.begin == Patch::kNone || own.turns == end.other.turns) return;
  for (const std::uint32_t angle : {patch.begin, patch.end}) {
    const double theta = obstacle.angles()[angle].theta;
    const Turn turn(theta);
    const Point d = direction(own, turn), k = direction(end.other, turn);
    const double lengths = std::hypot(d.x, d.y) * std::hypot(k.x, k.y);
    if (std::abs(cross(d, k)) > 0x1p-44 * lengths || gap_around(obstacle, angle) < 0x1p-40) continue;
    const Wave n = numerator(own, end.other, turn);
    const double down = own.turns ? cross(quarter(d), k) : cross(d, quarter(k));
    end.coincides = true;
    end.theta0 = theta;
    end.share0 = n.sine / down;
    end.share1 = -n.cosine / down;
    return;
  }
}

// With e = 2^-48 size: the cosine, the sine and the angle err by 2^-50 together, so that a rotated vector of length l
// errs by less than 2^-49 l, and a hinge by e. The share is cross(gap, other) / cross(d, other): the gap errs by 2 e,
// directions by 2^-49 of their length, products by 2^-51; what the share errs by is multiplied by the length of d, of
// which the share itself is at most one.
PlacedEnd PatchForms::end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const {
  const double e = 0x1p-48 * size_;
  if (end.corner) return {place(end.hinge, turn), e};
  const Point s = place(form.own.start, turn), d = direction(form.own, turn);
  const Point gap = place(end.other.start, turn) - s, other = direction(end.other, turn);
  const double across = cross(d, other), share = std::clamp(cross(gap, other) / across, 0.0, 1.0);
  const double length = std::sqrt(dot(d, d)), product = length * std::sqrt(dot(other, other));
  const double certain = std::abs(across) - 0x1p-46 * product - 0x1p-1000;
  if (!(certain > 0)) return {s, std::numeric_limits<double>::infinity()};
  const double wide = std::abs(gap.x) + std::abs(gap.y) + length;
  return {{s.x + share * d.x, s.y + share * d.y}, 2 * e + (4 * e + 0x1p-46 * wide) * (product / certain)};
}

PlacedEnd PatchForms::end_at(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn) const {
  if (!end.coincides) return this->end(form, end, turn);
  const double phi = std::remainder(theta - end.theta0, 2 * kPi);
  const double share = std::clamp(end.share0 + end.share1 * std::tan(phi / 2), 0.0, 1.0);
  const Point s = place(form.own.start, turn), d = direction(form.own, turn);
  return {{s.x + share * d.x, s.y + share * d.y}, 0x1p-42 * size_};
}

MovingRange PatchForms::end_within(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn,
                                   double half) const {
  if (end.corner) return moving(end.hinge, turn, half);
  const MovingRange s = moving(form.own.start, turn, half), d = moving_along(form.own, turn, half);
  if (end.coincides) {
    const double phi = std::remainder(theta - end.theta0, 2 * kPi);
    const Range tangent{std::tan((phi - half) / 2), std::tan((phi + half) / 2)}, all = end.share1 * tangent;
    const Range share{std::clamp(end.share0 + all.low, 0.0, 1.0), std::clamp(end.share0 + all.high, 0.0, 1.0)};
    const Range faster = (end.share1 / 2) * (Range{1, 1} + tangent * tangent);
    return {s.at + share * d.at, s.speed + faster * d.at + share * d.speed, true};
  }
  const MovingRange o = moving(end.other.start, turn, half), k = moving_along(end.other, turn, half);
  const Range across = cross(d.at, k.at);
  if (across.low <= 0 && across.high >= 0) {
    const PointRange far = s.at + d.at;
    return {{join(s.at.x, far.x), join(s.at.y, far.y)}, {}, false};
  }
  const PointRange gap = o.at - s.at;
  const Range one_over = reciprocal(across), share_now = cross(gap, k.at) * one_over;
  const Range share{std::clamp(share_now.low, 0.0, 1.0), std::clamp(share_now.high, 0.0, 1.0)};
  const Range up = cross(o.speed - s.speed, k.at) + cross(gap, k.speed);
  const Range down = cross(d.speed, k.at) + cross(d.at, k.speed);
  const Range faster = (up - share * down) * one_over;
  return {s.at + share * d.at, s.speed + faster * d.at + share * d.speed, true};
}

PointRange PatchForms::box(const PatchForm& form, double theta, double half) const {
  const Turn turn(theta);
  const PointRange a = end_within(form, form.left, theta, turn, half).at;
  const PointRange b = end_within(form, form.right, theta, turn, half).at;
  const double margin = 0x1p-40 * size_;
  const Range wider{-margin, margin};
  return {join(a.x, b.x) + wider, join(a.y, b.y) + wider};
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
  if (p.begin == Patch::kNone) return add(-kPi, kPi);
  const double begin = obstacle.angles()[p.begin].theta, end = obstacle.angles()[p.end].theta;
  if (p.begin < p.end) return add(begin, end);
  if (begin < kPi) add(begin, kPi);
  add(-kPi, end);
}

}  // namespace dymsum::apps
