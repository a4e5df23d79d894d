#include "cspace/queries/patch_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "cspace/events/walked_rings.h"

namespace dymsum::cspace {
namespace {

// The error of a value on the edge is this times the sizes of its terms. A wave's factors are sums of two products with
// a cosine and a sine (2 + 1 + 1), and those of x (2) take part as well: 4 + 2 + 1, for both terms, and two sums. The
// tangent of half of psi errs by what psi does (14), and by 8 for its quotient of a sum; product, sums and the sum with
// the gap's.
constexpr double kSlack = exact::rounding_bound(14 + 8 + 4, 32);
static_assert(2 * (4 + 2 + 1) + 2 <= 14 + 8 + 4);
// The errors of gap / sin(psi): the gap, the quotient; and of the sine, absolutely or times its terms: the parallel
// angle, an arc tangent of unit vectors (2 * 5 + 2), and the angle taken off.
constexpr double kGap = exact::rounding_bound(6, 32), kSine = exact::rounding_bound(14, 16);

}  // namespace

int nearest_parallel(const PatchEnd& end, double theta) {
  return static_cast<int>(std::lround((theta - end.parallel) / std::numbers::pi)) & 1;
}

double parallel_angle(const PatchEnd& end, int k) { return end.parallel + k * std::numbers::pi; }

EndCurve::EndCurve(const PatchEnd& end, double length, double reference) : length_(length) {
  constant_ = end.corner ? end.at : end.constant;
  if (end.corner) return;
  if (end.mixed) {
    const int k = nearest_parallel(end, reference);
    set_pole(end, k, std::remainder(reference - parallel_angle(end, k), 2 * std::numbers::pi));
    return;
  }
  kind_ = Kind::wave;
  const Turn turn(reference);
  first_ = end.cosine * turn.c + end.sine * turn.s;
  second_ = end.sine * turn.c - end.cosine * turn.s;
  slack_ = end.error + kSlack * (std::abs(constant_) + std::abs(end.cosine) + std::abs(end.sine));
}

EndCurve::EndCurve(const PatchEnd& end, double length, int k, double psi) : exact_(true), length_(length) {
  constant_ = end.constant;
  set_pole(end, k, psi);
}

void EndCurve::set_pole(const PatchEnd& end, int k, double psi) {
  kind_ = Kind::pole;
  first_ = end.tangent;
  gap_ = second_ = end.gap[static_cast<std::size_t>(k)];
  slack_ = kSlack * (std::abs(constant_) + std::abs(first_) + length_);
  psi_ = psi;
  cosine_ = std::cos(psi);
  sine_ = std::sin(psi);
}

double EndCurve::raw(const SmallRotation& x) const {
  if (kind_ == Kind::constant) return constant_;
  if (kind_ == Kind::wave) return constant_ + first_ * x.c + second_ * x.s;
  const Sines p = psi(x);
  const double smooth = constant_ - first_ * (p.s / (1 + p.c));
  return gap_ == 0 ? smooth : smooth + gap_ / p.s;
}

// psi and its sine err by kSine at most, or by kSine of their terms, which have one sign on the side of the reference;
// across the pole from there only as much as the terms. On the edge gap / sin(psi) is no longer than everything else
// together.
double EndCurve::error_at(double sine) const {
  if (kind_ != Kind::pole || gap_ == 0) return slack_;
  if (sine == 0) return std::numeric_limits<double>::infinity();
  const double fraction = std::min(std::abs(gap_ / sine), 2 * (length_ + std::abs(constant_) + std::abs(first_)));
  const double terms = exact_ ? std::abs(sine_) + std::abs(sine) : 1;
  return slack_ + fraction * (kGap + kSine * terms / std::abs(sine));
}

double EndCurve::error(const SmallRotation& x) const { return error_at(psi(x).s); }

EndCurve::Derivatives EndCurve::derivatives(const SmallRotation& x) const {
  if (kind_ == Kind::constant) return {constant_, 0, 0};
  if (kind_ == Kind::wave) {
    const double wave = first_ * x.c + second_ * x.s;
    return {constant_ + wave, second_ * x.c - first_ * x.s, -wave};
  }
  const Sines p = psi(x);
  const double t = p.s / (1 + p.c), half = (1 + t * t) / 2;
  Derivatives d{constant_ - first_ * t, -first_ * half, -first_ * half * t};
  if (gap_ != 0) {
    const double over = gap_ / p.s, cotangent = p.c / p.s;
    d.value += over;
    d.first -= over * cotangent;
    d.second += over * (1 / (p.s * p.s) + cotangent * cotangent);
  }
  return d;
}

Range EndCurve::range(double a, double b) const { return ranges(a, b).value; }

// Between 0 and pi, 1 / sin is monotone on either side of pi / 2, cos / sin^2 falls, and (1 + cos^2) / sin^3 behaves as
// 1 / sin does.
EndCurve::Ranges EndCurve::ranges(double a, double b) const {
  if (kind_ == Kind::constant) return {{constant_, constant_}, {}, {}, true, 0, 0};
  const SmallRotation u(a), v(b);
  if (kind_ == Kind::wave) {
    const double midpoint = (a + b) / 2, half = (b - a) / 2;
    const SmallRotation m(midpoint);
    const PointRange wave = turning({first_ * m.c + second_ * m.s, second_ * m.c - first_ * m.s}, half);
    const Range value = constant_ + wave.x;
    const Range wider{value.low - slack_, value.high + slack_};
    return {clamp(wider, 0, length_), wave.y, -1.0 * wave.x, true, slack_, slack_ / kSlack};
  }
  const Sines p = psi(u), q = psi(v);
  if (across_pole(p, q) || !(p.c > -0.5) || !(q.c > -0.5))
    return {{0, length_}, {}, {}, false, std::numeric_limits<double>::infinity(), 0};
  const Range t = between(p.s / (1 + p.c), q.s / (1 + q.c));
  const Range half = 0.5 * (1.0 + between(t.low * t.low, t.high * t.high));
  const Range wide_half{t.low <= 0 && t.high >= 0 ? 0.5 : half.low, half.high};
  Ranges r{constant_ + -first_ * t, -first_ * wide_half, -first_ * (wide_half * t), true, 0, slack_ / kSlack};
  if (gap_ != 0) {
    const double sign = p.s > 0 ? 1 : -1, s0 = std::abs(p.s), s1 = std::abs(q.s);
    const double most = p.c * q.c > 0 ? std::max(s0, s1) : 1, least = std::min(s0, s1);
    const auto second = [](double c, double s) { return (1 + c * c) / (s * s * s); };
    const double high = std::max(second(p.c, s0), second(q.c, s1));
    const double low = p.c * q.c > 0 ? std::min(second(p.c, s0), second(q.c, s1)) : 1;
    r.value = r.value + gap_ * (sign * Range{1 / most, 1 / least});
    r.first = r.first + -gap_ * between(p.c / (p.s * p.s), q.c / (q.s * q.s));
    r.second = r.second + gap_ * (sign * Range{low, high});
    r.error = error_at(least);
  } else {
    r.error = slack_;
  }
  r.value = clamp({r.value.low - r.error, r.value.high + r.error}, 0, length_);
  return r;
}

// Near the pole gap / sin(psi) exceeds all that would be left on the edge.
Range EndCurve::possible(double a, double b) const {
  if (kind_ != Kind::pole || gap_ == 0) return {a, b};
  const double near = std::abs(gap_) / (2 * (length_ + std::abs(constant_) + std::abs(first_)));
  const double from = a + psi_, to = b + psi_;
  if (to <= 0 || -from > to) return to > -near && from < -near ? Range{a, -near - psi_} : Range{a, b};
  return from < near && to > near ? Range{near - psi_, b} : Range{a, b};
}

namespace {

using base::exact_product, base::exact_sum;

// A number as the sum of its terms, exactly as long as nothing underflows: coordinates are scaled to at most 1.
using Terms = std::vector<double>;

void add(Terms& terms, double v) {
  std::size_t kept = 0;
  for (const double t : terms) {
    const DoublePair s = exact_sum(v, t);
    if (s.low != 0) terms[kept++] = s.low;
    v = s.high;
  }
  terms.resize(kept);
  if (v != 0) terms.push_back(v);
}

Terms product(const Terms& a, const Terms& b) {
  Terms out;
  for (const double x : a)
    for (const double y : b) {
      const DoublePair p = exact_product(x, y);
      add(out, p.low);
      add(out, p.high);
    }
  return out;
}

Terms sum(Terms a, const Terms& b, double sign) {
  for (const double y : b) add(a, sign * y);
  return a;
}

Terms arrow_between(double a, double b) {
  const DoublePair d = exact_sum(a, -b);
  Terms out;
  add(out, d.low);
  add(out, d.high);
  return out;
}

struct Arrow {
  DoublePair x, y;
};
Arrow from_to(Point a, Point b) { return {exact_sum(b.x, -a.x), exact_sum(b.y, -a.y)}; }
DoublePair cross_of_arrows(const Arrow& a, const Arrow& b) { return a.x * b.y - a.y * b.x; }
DoublePair dot_of_arrows(const Arrow& a, const Arrow& b) { return a.x * b.x + a.y * b.y; }
DoublePair square_of_arrow(const Arrow& a) { return a.x * a.x + a.y * a.y; }

// The signed distance of p from the line through a and b.
DoublePair height(Point p, const std::array<Point, 2>& line) {
  const Arrow d = from_to(line[0], line[1]);
  return cross_of_arrows(from_to(line[0], p), d) / square_root(square_of_arrow(d));
}

int sign_of(const Terms& terms) { return terms.empty() ? 0 : terms.back() > 0 ? 1 : -1; }

// 1 where p is as far from one line as q from the other one and on the same side, -1 on different ones, 0 where it is
// not as far, 2 on both lines: by the squares of the distances times those of the lengths.
int same_height(Point p, const std::array<Point, 2>& line, Point q, const std::array<Point, 2>& other) {
  const auto parts = [](Point point, const std::array<Point, 2>& l) {
    const Terms dx = arrow_between(l[1].x, l[0].x), dy = arrow_between(l[1].y, l[0].y);
    const Terms gx = arrow_between(point.x, l[0].x), gy = arrow_between(point.y, l[0].y);
    const Terms area = sum(product(gx, dy), product(gy, dx), -1);
    return std::array{area, sum(product(dx, dx), product(dy, dy), 1)};
  };
  const auto [area, length] = parts(p, line);
  const auto [other_area, other_length] = parts(q, other);
  if (area.empty() && other_area.empty()) return 2;
  const Terms one = product(product(area, area), other_length), two = product(product(other_area, other_area), length);
  return sum(one, two, -1).empty() ? sign_of(area) * sign_of(other_area) : 0;
}

}  // namespace

CrossingGaps crossing_gaps(const std::array<Point, 2>& fixed, const std::array<Point, 2>& turning, Point corner,
                           Point hand) {
  std::array<Point, 6> all{fixed[0], fixed[1], turning[0], turning[1], corner, hand};
  double most = 0, least = INFINITY;
  for (const Point& p : all)
    for (const double v : {std::abs(p.x), std::abs(p.y)}) {
      most = std::max(most, v);
      if (v != 0) least = std::min(least, v);
    }
  int exponent = 0;
  std::frexp(most, &exponent);
  for (Point& p : all) p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent)};
  const std::array<Point, 2> line{all[0], all[1]}, other{all[2], all[3]};
  const DoublePair a = height(all[4], line), b = -height(all[5], other);
  CrossingGaps gaps{(a + b).value(), (a - b).value()};
  // Products of eight coordinates and their roundings stay within the range of doubles.
  if (least >= std::ldexp(most, -60) && std::min(std::abs(gaps[0]), std::abs(gaps[1])) < 0x1p-85) {
    const int same = same_height(all[4], line, all[5], other);
    if (same > 0) gaps[0] = 0;
    if (same < 0 || same == 2) gaps[1] = 0;
  }
  for (double& gap : gaps) gap = std::ldexp(gap, exponent);
  return gaps;
}

// tan(phi / 2) = sin / (1 + cos) = (1 - cos) / sin, of which one does not cancel.
std::array<DoublePair, 2> half_tangents(const std::array<Point, 2>& a, const std::array<Point, 2>& b) {
  const auto unit = [](const std::array<Point, 2>& edge) {
    Arrow v = from_to(edge[0], edge[1]);
    int exponent = 0;
    std::frexp(std::max(std::abs(v.x.high), std::abs(v.y.high)), &exponent);
    for (DoublePair* d : {&v.x, &v.y}) *d = {std::ldexp(d->high, -exponent), std::ldexp(d->low, -exponent)};
    return v;
  };
  const Arrow u = unit(a), v = unit(b);
  const DoublePair lengths = square_root(square_of_arrow(u) * square_of_arrow(v)), c = dot_of_arrows(u, v),
                   s = cross_of_arrows(u, v);
  const auto half = [&](const DoublePair& cosine, const DoublePair& sine) {
    return cosine.high > 0 ? sine / (lengths + cosine) : (lengths - cosine) / sine;
  };
  return {half(c, s), half(-c, -s)};
}

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
