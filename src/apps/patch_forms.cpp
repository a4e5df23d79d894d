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
  FormMaker(const Region& obstacle, const Region& robot, Point origin) : obstacle_(numbered(obstacle)), robot_(numbered(robot)) {
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

PointRange operator+(PointRange a, PointRange b) { return {a.x + b.x, a.y + b.y}; }
PointRange operator-(PointRange a, PointRange b) { return {a.x - b.x, a.y - b.y}; }
PointRange operator*(Range a, PointRange b) { return {a * b.x, a * b.y}; }
PointRange around(Point a) { return {{a.x, a.x}, {a.y, a.y}}; }
Range cross(const PointRange& a, const PointRange& b) { return a.x * b.y - a.y * b.x; }
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
}

// With e = 2^-48 size: the cosine, the sine and the angle err by 2^-50 together, so that a rotated vector of length l errs
// by less than 2^-49 l, and a hinge by e. Along the line: numerator and denominator are sums of two products of vectors
// of at most 4 size that err by 4 e: by less than 2^6 size e each.
PlacedEnd PatchForms::end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const {
  const double e = 0x1p-48 * size_;
  if (end.corner) return {place(end.hinge, turn), e};
  const Point s = place(form.own.start, turn), d = direction(form.own, turn);
  const Point gap = place(end.other.start, turn) - s, other = direction(end.other, turn);
  const double across = cross(d, other), share = std::clamp(cross(gap, other) / across, 0.0, 1.0);
  const double certain = std::abs(across) - 0x1p6 * size_ * e - 0x1p-1000;
  if (!(certain > 0)) return {share >= 0 ? Point{s.x + share * d.x, s.y + share * d.y} : s, std::numeric_limits<double>::infinity()};
  return {{s.x + share * d.x, s.y + share * d.y}, 4 * e + 4 * size_ * (0x1p7 * size_ * e / certain)};
}

MovingRange PatchForms::end_within(const PatchForm& form, const PatchEnd& end, const Turn& turn, double half) const {
  if (end.corner) return moving(end.hinge, turn, half);
  const MovingRange s = moving(form.own.start, turn, half), d = moving_along(form.own, turn, half);
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
  const PointRange a = end_within(form, form.left, turn, half).at, b = end_within(form, form.right, turn, half).at;
  const double margin = 0x1p-40 * size_;
  const Range wider{-margin, margin};
  return {join(a.x, b.x) + wider, join(a.y, b.y) + wider};
}

void PatchForms::split(const CspaceObstacle& obstacle, std::uint32_t patch, double longest, std::vector<PatchPiece>& out) {
  const Patch& p = obstacle.patches()[patch];
  const auto add = [&](double low, double high) {
    const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / longest)));
    for (int k = 0; k < parts; ++k) {
      const double from = low + (high - low) * k / parts, to = k + 1 == parts ? high : low + (high - low) * (k + 1) / parts;
      out.push_back({patch, from, to});
    }
  };
  if (p.begin == Patch::kNone) return add(-kPi, kPi);
  const double begin = obstacle.angles()[p.begin].theta, end = obstacle.angles()[p.end].theta;
  if (p.begin < p.end) return add(begin, end);
  if (begin < kPi) add(begin, kPi);
  add(-kPi, end);
}

}  // namespace dymsum::apps
