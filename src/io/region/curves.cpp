#include "io/region/curves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

namespace dymsum::io {

PlaneTransform PlaneTransform::after(const PlaneTransform& inner) const {
  if (identity()) return inner;
  if (inner.identity()) return *this;
  return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
          b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

Point PlaneTransform::apply(Point p) const {
  if (identity()) return p;
  return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
}

Point PlaneTransform::apply_vector(Point v) const {
  if (identity()) return v;
  return {a * v.x + c * v.y, b * v.x + d * v.y};
}

namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// The angle in [0, 360), exactly.
double within_a_turn(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

}  // namespace

Point direction(double degrees) {
  const double angle = within_a_turn(degrees);
  if (angle == 0 || angle == 360) return {1, 0};
  if (angle == 90) return {0, 1};
  if (angle == 180) return {-1, 0};
  if (angle == 270) return {0, -1};
  return {std::cos(angle * kRadian), std::sin(angle * kRadian)};
}

Point on_circle(Point centre, double radius, double degrees) {
  const Point d = direction(degrees);
  return {centre.x + radius * d.x, centre.y + radius * d.y};
}

// The centre lies on the chord's bisector, (1 / b - b) / 4 chords to its left.
EllipseArc bulge_arc(Point from, Point to, double b) {
  const double dx = to.x - from.x, dy = to.y - from.y, height = (1 / b - b) / 4;
  const Point u{dy * height - dx / 2, -dx * height - dy / 2};
  return {from, u, {-u.y, u.x}, 4 * std::atan(b)};
}

std::optional<EllipseArc> degree_arc(Point centre, double radius, double from_degrees, double to_degrees) {
  const double from = within_a_turn(from_degrees);
  double sweep = within_a_turn(to_degrees) - from;
  if (sweep == 0) return std::nullopt;
  if (sweep < 0) sweep += 360;
  const Point d = direction(from);
  const Point u{radius * d.x, radius * d.y};
  return EllipseArc{on_circle(centre, radius, from), u, {-u.y, u.x}, sweep * kRadian};
}

ChordChain ellipse_ring(Point centre, Point u, Point v, const CurveOptions& options) {
  const Point axes[] = {u, v, {-u.x, -u.y}, {-v.x, -v.y}};
  ChordChain ring;
  ring.add({centre.x + u.x, centre.y + u.y});
  for (int k = 0; k < 4; ++k) {
    const Point from = axes[k], to = axes[(k + 1) % 4];
    append_arc(ring, {ring.back(), from, to, std::numbers::pi / 2}, {centre.x + to.x, centre.y + to.y}, options);
  }
  ring.pop_back();
  ring.curves = 1;
  return ring;
}

namespace {

constexpr double kMostChords = 1e6;  // of a curve
constexpr int kMostHalvings = 40;

void require_finite(Point p) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) throw CurveFailure{CurveTrouble::not_finite};
}

/// A point with its weight as a third coordinate, by which the others are multiplied.
struct Weighted {
  double x, y, w;
  Point point() const { return {x / w, y / w}; }
};
using Control = std::vector<Weighted>;

Control weighted(const BezierCurve& curve) {
  Control control;
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    const double w = curve.weights.empty() ? 1 : curve.weights[k];
    control.push_back({curve.points[k].x * w, curve.points[k].y * w, w});
  }
  return control;
}

Weighted mix(const Weighted& a, const Weighted& b, double t) {
  return {(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y, (1 - t) * a.w + t * b.w};
}

/// The halves of a curve, by de Casteljau.
std::pair<Control, Control> halves(Control control) {
  Control first, last;
  while (!control.empty()) {
    first.push_back(control.front());
    last.push_back(control.back());
    for (std::size_t k = 0; k + 1 < control.size(); ++k) control[k] = mix(control[k], control[k + 1], 0.5);
    control.pop_back();
  }
  std::reverse(last.begin(), last.end());
  return {std::move(first), std::move(last)};
}

/// Positions along the chord from a, as fractions of it, and across, positive on its left, as lengths.
struct ChordFrame {
  Point a, d;
  double length;
  ChordFrame(Point from, Point to) : a(from), d{to.x - from.x, to.y - from.y}, length(std::hypot(d.x, d.y)) {}
  double along(Point p) const { return ((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (length * length); }
  double across(Point p) const { return (d.x * (p.y - a.y) - d.y * (p.x - a.x)) / length; }
};

double distance_to_segment(const ChordFrame& frame, Point p) {
  if (!(frame.length > 0)) return std::hypot(p.x - frame.a.x, p.y - frame.a.y);
  const double t = std::clamp(frame.along(p), 0.0, 1.0);
  return std::hypot(p.x - (frame.a.x + t * frame.d.x), p.y - (frame.a.y + t * frame.d.y));
}

/// The vertices strictly between the ends of the hull's side on the left (side 1) or the right (-1), in their order.
/// Requires points whose feet on the chord lie between its ends.
std::vector<Point> hull_side(const ChordFrame& frame, const std::vector<Point>& points, int side) {
  std::vector<std::pair<double, double>> flat{{0, 0}};  // along, height
  std::vector<Point> at{points.front()};
  std::vector<std::pair<double, Point>> inner;
  for (std::size_t k = 1; k + 1 < points.size(); ++k)
    if (side * frame.across(points[k]) > 0) inner.emplace_back(frame.along(points[k]) * frame.length, points[k]);
  std::sort(inner.begin(), inner.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  inner.emplace_back(frame.length, points.back());
  for (const auto& [along, p] : inner) {
    const double height = p == points.back() ? 0 : side * frame.across(p);
    while (flat.size() > 1) {
      const auto [x0, y0] = flat[flat.size() - 2];
      const auto [x1, y1] = flat.back();
      if ((x1 - x0) * (height - y0) - (y1 - y0) * (along - x0) < 0) break;  // bends towards the chord
      flat.pop_back();
      at.pop_back();
    }
    flat.emplace_back(along, height);
    at.push_back(p);
  }
  return {at.begin() + 1, at.end() - 1};
}

class BezierChords {
 public:
  BezierChords(ChordChain& chain, double error, CurveBound bound) : chain_(chain), error_(error), bound_(bound) {}

  void add(const Control& control, int halvings) {
    std::vector<Point> points;
    for (const Weighted& w : control) {
      points.push_back(w.point());
      require_finite(points.back());
    }
    if (halvings < kMostHalvings && !is_flat(points)) {
      const auto [first, last] = halves(control);
      add(first, halvings + 1);
      add(last, halvings + 1);
      return;
    }
    if (++chords_ > kMostChords) throw CurveFailure{CurveTrouble::too_many_chords};
    if (points.back() == chain_.back()) return;
    const ChordFrame frame(points.front(), points.back());
    const bool sides = bound_ != CurveBound::nearest && has_feet_inside(frame, points);
    if (sides)
      for (auto [version, side] : {std::pair{&chain_.left, 1}, std::pair{&chain_.right, -1}})
        for (const Point p : hull_side(frame, points, side)) version->push_back(p);
    chain_.add(points.back());
  }

 private:
  static bool has_feet_inside(const ChordFrame& frame, const std::vector<Point>& points) {
    return std::all_of(points.begin() + 1, points.end() - 1, [&](Point p) {
      const double t = frame.along(p);
      return t >= 0 && t <= 1;
    });
  }

  bool is_flat(const std::vector<Point>& points) const {
    const ChordFrame frame(points.front(), points.back());
    const bool near = std::all_of(points.begin() + 1, points.end() - 1,
                                  [&](Point p) { return distance_to_segment(frame, p) <= error_ / 2; });
    return near && (bound_ == CurveBound::nearest || (frame.length > 0 && has_feet_inside(frame, points)));
  }

  ChordChain& chain_;
  double error_;
  CurveBound bound_;
  double chords_ = 0;
};

}  // namespace

void ChordChain::add(Point p) {
  for (std::vector<Point>* version : {&on, &left, &right}) version->push_back(p);
}

void ChordChain::append(const ChordChain& next) {
  if (empty()) {
    *this = next;
    return;
  }
  for (auto [to, from] : {std::pair{&on, &next.on}, std::pair{&left, &next.left}, std::pair{&right, &next.right}})
    to->insert(to->end(), from->begin() + 1, from->end());
  curves += next.curves;
}

void ChordChain::reverse() {
  for (std::vector<Point>* version : {&on, &left, &right}) std::reverse(version->begin(), version->end());
  std::swap(left, right);
}

void ChordChain::set_front(Point p) {
  for (std::vector<Point>* version : {&on, &left, &right}) version->front() = p;
}
void ChordChain::set_back(Point p) {
  for (std::vector<Point>* version : {&on, &left, &right}) version->back() = p;
}
void ChordChain::pop_back() {
  for (std::vector<Point>* version : {&on, &left, &right}) version->pop_back();
}

// cos t - 1 = -2 sin(t / 2)^2, without cancellation.
Point EllipseArc::at(double t) const {
  const double half = std::sin(t / 2), c = -2 * half * half, s = std::sin(t);
  return {start.x + (c * u.x + s * v.x), start.y + (c * u.y + s * v.y)};
}

// cos t / cos h - 1 = -2 sin((t + h) / 2) sin((t - h) / 2) / cos h.
Point EllipseArc::corner(double t, double h) const {
  const double c = -2 * std::sin((t + h) / 2) * std::sin((t - h) / 2) / std::cos(h), s = std::sin(t) / std::cos(h);
  return {start.x + (c * u.x + s * v.x), start.y + (c * u.y + s * v.y)};
}

// The largest singular value of the matrix with the columns u and v: half the sum of the lengths of
// (u.x + v.y, u.y - v.x) and (u.x - v.y, u.y + v.x). Four roundings, below 2^-50 together.
double EllipseArc::reach() const {
  const double sum = std::hypot(u.x + v.y, u.y - v.x) + std::hypot(u.x - v.y, u.y + v.x);
  return sum / 2 * (1 + 0x1p-50);
}

void append_arc(ChordChain& chain, const EllipseArc& arc, Point to, const CurveOptions& options) {
  const double reach = arc.reach(), allowed = options.error ? *options.error / reach : kCurveError;
  if (!std::isfinite(reach)) throw CurveFailure{CurveTrouble::not_finite};
  ++chain.curves;
  // A step of less than a quarter: chords go around then. 1 / (1 + e) = 1 - e / (1 + e), and 1 - cos(x) = 2 sin(x/2)^2.
  const double largest = std::min(4 * std::asin(std::sqrt(allowed / (1 + allowed) / 2)), std::numbers::pi / 3);
  const double steps = std::max(1.0, std::ceil(std::abs(arc.sweep) / largest));
  if (!(steps <= kMostChords)) throw CurveFailure{CurveTrouble::too_many_chords};
  const double step = arc.sweep / steps;
  // Counter-clockwise on the unit circle and an image that is not mirrored: the circle is on the right of its chords.
  const double side = (arc.u.x * arc.v.y - arc.u.y * arc.v.x) * arc.sweep;
  std::vector<Point>&inner = side > 0 ? chain.left : chain.right, &outer = side > 0 ? chain.right : chain.left;
  for (int k = 0; k < static_cast<int>(steps); ++k) {
    const Point corner = arc.corner(step * (k + 0.5), step / 2);
    const bool last = k + 1 == static_cast<int>(steps);
    const Point next = last ? to : arc.at(step * (k + 1));
    require_finite(corner);
    require_finite(next);
    chain.on.push_back(next);
    inner.push_back(next);
    outer.push_back(corner);
    if (last) outer.push_back(next);
  }
}

// From the first point the centre is where the bisectors of the two chords meet. The arc from the first to the second
// point covers twice the angle at which these are seen from the third one, and so on: without the centre, which is far
// away where the three are nearly on a line.
void append_three_point_arc(ChordChain& chain, Point on, Point to, const CurveOptions& options) {
  const Point from = chain.back(), p{on.x - from.x, on.y - from.y}, q{to.x - from.x, to.y - from.y};
  if (from == to) {
    const Point u{-p.x / 2, -p.y / 2};
    append_arc(chain, {from, u, {-u.y, u.x}, std::numbers::pi}, on, options);
    append_arc(chain, {on, {-u.x, -u.y}, {u.y, -u.x}, std::numbers::pi}, to, options);
    --chain.curves;
    return;
  }
  const double bend = p.x * q.y - p.y * q.x, pp = p.x * p.x + p.y * p.y, qq = q.x * q.x + q.y * q.y;
  const Point u{-(q.y * pp - p.y * qq) / (2 * bend), -(p.x * qq - q.x * pp) / (2 * bend)};
  if (!std::isfinite(u.x) || !std::isfinite(u.y)) {
    chain.add(on);
    chain.add(to);
    return;
  }
  const auto seen = [](Point a, Point b) { return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y); };
  const Point r{to.x - on.x, to.y - on.y};
  const double first = 2 * std::copysign(std::abs(seen(q, r)), bend), second = 2 * seen(p, q);
  append_arc(chain, {from, u, {-u.y, u.x}, first}, on, options);
  const Point w{u.x + p.x, u.y + p.y};
  append_arc(chain, {on, w, {-w.y, w.x}, second}, to, options);
  --chain.curves;
}

void append_bezier(ChordChain& chain, const BezierCurve& curve, const CurveOptions& options) {
  ++chain.curves;
  const double error = options.error ? *options.error : kCurveError * curve_size(curve.points);
  BezierChords(chain, error, options.bound).add(weighted(curve), 0);
  chain.set_back(curve.points.back());
}

// The j-th control point between the knots t_i and t_(i+1) is the blossom of the spline at p - j times t_i and j times
// t_(i+1), which de Boor's triangle gives with an argument for each of its rows.
std::vector<BezierCurve> spline_curves(std::size_t degree, const std::vector<double>& knots,
                                       const BezierCurve& control) {
  const Control points = weighted(control);
  const auto blossom = [&](std::size_t i, std::size_t of_next) {
    Control d(points.begin() + static_cast<std::ptrdiff_t>(i - degree),
              points.begin() + static_cast<std::ptrdiff_t>(i + 1));
    for (std::size_t row = 1; row <= degree; ++row) {
      const double t = row <= of_next ? knots[i + 1] : knots[i];
      for (std::size_t k = degree; k >= row; --k) {
        const double low = knots[k + i - degree], high = knots[k + 1 + i - row];
        d[k] = mix(d[k - 1], d[k], (t - low) / (high - low));
      }
    }
    return d[degree];
  };
  std::vector<BezierCurve> curves;
  for (std::size_t i = degree; i < points.size(); ++i) {
    if (!(knots[i] < knots[i + 1])) continue;
    BezierCurve& curve = curves.emplace_back();
    for (std::size_t j = 0; j <= degree; ++j) {
      const Weighted at = blossom(i, j);
      curve.points.push_back(at.point());
      curve.weights.push_back(at.w);
      require_finite(curve.points.back());
    }
    if (curves.size() > 1) curve.points.front() = curves[curves.size() - 2].points.back();
  }
  return curves;
}

double curve_size(const std::vector<Point>& points) {
  const auto [left, right] =
      std::minmax_element(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](Point a, Point b) { return a.y < b.y; });
  return std::hypot(right->x - left->x, high->y - low->y);
}

const char* text_of(const CurveFailure& failure) {
  return failure.trouble == CurveTrouble::too_many_chords
             ? "a curve would have more than 1000000 chords: the error of curves is too small for it"
             : "a curve leaves the range of doubles";
}

namespace {

/// The version of a chain for a ring that has the region on its left, and is the chain or its reverse.
Ring version_of(ChordChain chain, const Ring& ring, CurveBound bound) {
  if (chain.curves == 0 || bound == CurveBound::nearest) return ring;
  if (chain.on != ring) {  // the first vertex of a ring stays first
    chain.reverse();
    for (std::vector<Point>* version : {&chain.on, &chain.left, &chain.right})
      std::rotate(version->begin(), version->end() - 1, version->end());
  }
  return bound == CurveBound::inside ? chain.left : chain.right;
}

/// Chains by their first vertices.
class ChainsOfRings {
 public:
  explicit ChainsOfRings(std::vector<ChordChain> chains) : chains_(std::move(chains)) {
    for (std::size_t k = 0; k < chains_.size(); ++k)
      starts_.emplace(std::pair(chains_[k].front().x, chains_[k].front().y), k);
  }

  Ring version(const Ring& ring, CurveBound bound) const {
    const auto [first, last] = starts_.equal_range({ring.front().x, ring.front().y});
    for (auto it = first; it != last; ++it) {
      const ChordChain& chain = chains_[it->second];
      const bool reversed = chain.on.size() == ring.size() &&
                            std::equal(chain.on.begin() + 1, chain.on.end(), std::make_reverse_iterator(ring.end()));
      if (chain.on == ring || reversed) return version_of(chain, ring, bound);
    }
    return ring;
  }

 private:
  std::vector<ChordChain> chains_;
  std::multimap<std::pair<double, double>, std::size_t> starts_;
};

}  // namespace

bool nest_chains(std::vector<ChordChain> chains, std::vector<Part>& parts, CurveBound bound, FillRule rule) {
  std::erase_if(chains, [](const ChordChain& chain) { return chain.empty(); });
  std::vector<Ring> rings;
  for (const ChordChain& chain : chains) rings.push_back(chain.on);
  std::vector<Part> nested;
  if (!nest_rings(std::move(rings), nested, rule)) return false;
  if (bound != CurveBound::nearest) {
    const ChainsOfRings known(std::move(chains));
    for (Part& part : nested) {
      part.outer = known.version(part.outer, bound);
      for (Ring& hole : part.holes) hole = known.version(hole, bound);
    }
  }
  std::move(nested.begin(), nested.end(), std::back_inserter(parts));
  return true;
}

Part part_of_chains(std::vector<ChordChain> rings, CurveBound bound) {
  Part part;
  for (std::size_t k = 0; k < rings.size(); ++k) (k == 0 ? part.outer : part.holes.emplace_back()) = rings[k].on;
  orient_rings(part);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    Ring& ring = k == 0 ? part.outer : part.holes[k - 1];
    if (!ring.empty()) ring = version_of(std::move(rings[k]), ring, bound);
  }
  return part;
}

}  // namespace dymsum::io
