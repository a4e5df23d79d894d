#include "thesis/convex_polygon_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "exact/big.h"
#include "exact/grid.h"
#include "exact/orient.h"
#include "planar/motion/orientation.h"
#include "spatial/gauss/overlay.h"

namespace dymsum {
namespace {

using exact::BigInteger;
using exact::BigRational;

constexpr double kNever = -std::numeric_limits<double>::infinity();

// Of a coordinate of a unit vector, in units u of itself: its own rounding and the quotient's, and the length's, that
// of a square root (1) of a sum of squares (2 + 1 + 1, halved).
constexpr int kUnit = 2 + 3;
/// Of the sign's form, times the sum of the map's entries: two unit vectors and an entry (1) make a term, with two
/// products and two sums; coordinates of unit vectors are at most 1.
constexpr double kSignError = exact::rounding_bound(2 * kUnit + 1 + 2 + 2, 32);
/// Of the spectral norm of c T - I for T = new old^-1, times c. Entries of the maps are less than 2 and carry 1; those
/// of T are sums of two products of at most 4, so they err by 2 * 4 * 3 + 8 = 32, and c T and the difference from I
/// are rounded: 2 * 8. Norms err by twice what entries do.
constexpr double kTurnError = exact::rounding_bound(2 * (32 + 16), 128);
/// What a certificate leaves out of the angle that it holds for: a margin is at most the norm, its difference from the
/// error, the quotient and the difference from this bound are rounded.
constexpr double kMarginError = exact::rounding_bound(3, 8192);

/// Strictly convex, counter-clockwise. Edge k runs from vertex k to the next one.
struct Polygon {
  std::vector<std::uint32_t> source;  // numbers in the region
  std::vector<Point> at;
  std::vector<std::array<BigInteger, 2>> edge;  // on a grid of the polygon's own
  std::vector<Point> direction;                 // unit vectors, up to kUnit of each coordinate

  std::uint32_t size() const { return static_cast<std::uint32_t>(at.size()); }
  std::uint32_t after(std::uint32_t k) const { return k + 1 == size() ? 0 : k + 1; }
  std::uint32_t before(std::uint32_t k) const { return k == 0 ? size() - 1 : k - 1; }
};

Result<Polygon> make_polygon(const Region& region) {
  if (region.parts().size() != 1 || !region.parts()[0].holes.empty() || !region.polylines().empty() ||
      !region.points().empty())
    return Error{ErrorCode::unsupported_operand, "a convex polygon is one part without holes, and nothing else", {}};
  const Ring& ring = region.parts()[0].outer;
  Polygon p;
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const int turn = exact::orient_sign(ring[k == 0 ? ring.size() - 1 : k - 1], ring[k], ring[(k + 1) % ring.size()]);
    if (turn < 0) {
      Error error{ErrorCode::not_convex, "the polygon has a reflex vertex", {}};
      error.evidence.part = error.evidence.ring = 0;
      error.evidence.vertex = k;
      error.evidence.x = ring[k].x;
      error.evidence.y = ring[k].y;
      return error;
    }
    if (turn == 0) continue;
    p.source.push_back(k);
    p.at.push_back(ring[k]);
  }
  std::vector<double> all;
  for (const Point& v : p.at) all.insert(all.end(), {v.x, v.y});
  const int exponent = exact::common_exponent(all);
  for (std::uint32_t k = 0; k < p.size(); ++k) {
    const Point &a = p.at[k], &b = p.at[p.after(k)];
    const exact::Big x = exact::grid_coordinate<exact::Big>(b.x, a.x, exponent),
                     y = exact::grid_coordinate<exact::Big>(b.y, a.y, exponent);
    p.edge.push_back({x.value(), y.value()});
    // Rounded once each; what a common factor loses of the smaller one is far below the error of the unit vector.
    const BigInteger most = std::max(BigInteger(abs(x.value())), BigInteger(abs(y.value())));
    const double dx = exact::round_to_double(BigRational(x.value(), most)),
                 dy = exact::round_to_double(BigRational(y.value(), most));
    const double length = std::sqrt(dx * dx + dy * dy);
    p.direction.push_back({dx / length, dy / length});
  }
  return p;
}

/// The map of a pose as integers over a common positive denominator, row by row.
struct ExactMatrix {
  std::array<BigInteger, 4> m;
  BigInteger den;

  static ExactMatrix of(const PlanarPose& pose) {
    const auto [n, d] = planar::tan_half_of(pose.rotation);
    const BigInteger c = d * d - n * n, s = 2 * n * d;
    const BigRational x = exact::exact_value(pose.scale[0].exact()), y = exact::exact_value(pose.scale[1].exact());
    const BigInteger left = numerator(x) * denominator(y), right = numerator(y) * denominator(x);
    return {{c * left, -s * right, s * left, c * right}, (d * d + n * n) * denominator(x) * denominator(y)};
  }
};

/// From Q's coordinates to P's up to a positive factor: the adjoint of P's map, whose determinant is positive, after
/// Q's.
std::array<BigInteger, 4> relative(const ExactMatrix& p, const ExactMatrix& q) {
  const auto& a = p.m;
  const auto& b = q.m;
  std::array<BigInteger, 4> r{a[3] * b[0] - a[1] * b[2], a[3] * b[1] - a[1] * b[3], a[0] * b[2] - a[2] * b[0],
                              a[0] * b[3] - a[2] * b[1]};
  const BigInteger divisor = gcd(gcd(r[0], r[1]), gcd(r[2], r[3]));
  for (BigInteger& c : r) c /= divisor;
  return r;
}

using Mat2 = std::array<double, 4>;

/// The largest and the product of the singular values come from these two circles.
double spectral_norm(const Mat2& m) {
  return (std::hypot(m[0] + m[3], m[2] - m[1]) + std::hypot(m[0] - m[3], m[1] + m[2])) / 2 * exact::kOutwards;
}

/// How far directions turn between two maps that are not far apart, at most; 4, more than any angle, otherwise. As in
/// space: c T = I + E moves a vector v by at most |E v|.
double turn_between(const Mat2& before, const Mat2& now) {
  const Mat2 t{now[0] * before[3] - now[1] * before[2], now[1] * before[0] - now[0] * before[1],
               now[2] * before[3] - now[3] * before[2], now[3] * before[0] - now[2] * before[1]};
  const double trace = t[0] + t[3];
  if (!(trace > 0)) return 4;
  const double c = 2 / trace;
  const double e = spectral_norm({c * t[0] - 1, c * t[1], c * t[2], c * t[3] - 1}) + kTurnError * c;
  return e < 0.4 ? std::asin(e) * exact::kOutwards : 4;
}

}  // namespace

class ConvexPolygonSum::State {
 public:
  Polygon p, q;
  PlanarPose p_pose, q_pose;
  PolygonWork work;
  std::array<BigInteger, 4> map{1, 0, 0, 1};  // from Q's coordinates to P's
  Mat2 approx{1, 0, 0, 1};                    // the largest entry in [1, 2)
  double error = 0, norm = 1;                 // of signs in doubles; of approx
  std::vector<std::uint32_t> extreme;         // the vertex of Q that is extreme in the direction of each edge of P
  std::vector<double> until;                  // the angle up to which that is known, on the clock of all moves
  double clock = 0;

  void turn_to(const PlanarPose& p_to, const PlanarPose& q_to);
  double value(std::uint32_t i, std::uint32_t j) const;
  int true_sign(std::uint32_t i, std::uint32_t j);
  int sign(std::uint32_t i, std::uint32_t j);
  bool parallel(std::uint32_t i, std::uint32_t j) const;
  void climb(std::uint32_t i, std::uint32_t from);
  const PolygonWork& correct();
  const PolygonWork& restart();
  BigInteger cross(std::uint32_t i, std::uint32_t j) const;
  BigInteger dot(std::uint32_t i, std::uint32_t j) const;
  std::array<BigInteger, 2> mapped(std::uint32_t j) const {
    return {map[0] * q.edge[j][0] + map[1] * q.edge[j][1], map[2] * q.edge[j][0] + map[3] * q.edge[j][1]};
  }
};

void ConvexPolygonSum::State::turn_to(const PlanarPose& p_to, const PlanarPose& q_to) {
  p_pose = p_to;
  q_pose = q_to;
  map = relative(ExactMatrix::of(p_to), ExactMatrix::of(q_to));
  BigInteger most = 0;
  for (const BigInteger& c : map) most = std::max(most, BigInteger(abs(c)));
  const BigRational unit(BigInteger(1), BigInteger(1) << static_cast<unsigned>(msb(most)));
  const Mat2 before = approx;
  for (int k = 0; k < 4; ++k) approx[k] = exact::round_to_double(BigRational(map[k]) * unit);
  clock = (clock + turn_between(before, approx)) * exact::kUp;
  norm = spectral_norm(approx);
  error = kSignError * (std::abs(approx[0]) + std::abs(approx[1]) + std::abs(approx[2]) + std::abs(approx[3]));
}

BigInteger ConvexPolygonSum::State::cross(std::uint32_t i, std::uint32_t j) const {
  const auto e = mapped(j);
  return p.edge[i][0] * e[1] - p.edge[i][1] * e[0];
}
BigInteger ConvexPolygonSum::State::dot(std::uint32_t i, std::uint32_t j) const {
  const auto e = mapped(j);
  return p.edge[i][0] * e[0] + p.edge[i][1] * e[1];
}

/// The sine of the angle from edge i of P to edge j of Q, times the length of the mapped unit vector: positive when
/// that edge falls in the direction of edge i's outward normal.
double ConvexPolygonSum::State::value(std::uint32_t i, std::uint32_t j) const {
  const Point u = p.direction[i], v = q.direction[j];
  return u.x * (approx[2] * v.x + approx[3] * v.y) - u.y * (approx[0] * v.x + approx[1] * v.y);
}

/// Never zero: Q counts as turned counter-clockwise by an infinitesimal angle, so that an edge parallel to edge i falls
/// and one against it rises.
int ConvexPolygonSum::State::sign(std::uint32_t i, std::uint32_t j) {
  const double v = value(i, j);
  if (v > error) return 1;
  if (v < -error) return -1;
  ++work.exact_signs;
  if (const int s = cross(i, j).sign()) return s;
  return dot(i, j).sign();
}

bool ConvexPolygonSum::State::parallel(std::uint32_t i, std::uint32_t j) const {
  return std::abs(value(i, j)) <= error && cross(i, j).sign() == 0 && dot(i, j).sign() > 0;
}

/// To the vertex of Q with a rising edge before it and a falling one after it. Every step rises.
void ConvexPolygonSum::State::climb(std::uint32_t i, std::uint32_t from) {
  std::uint32_t v = from;
  while (sign(i, v) < 0) {
    v = q.after(v);
    ++work.steps;
  }
  if (v == from)
    for (; sign(i, q.before(v)) > 0; ++work.steps) v = q.before(v);
  const double margin = std::min(std::abs(value(i, v)), std::abs(value(i, q.before(v)))) - error;
  until[i] = (clock + (margin / norm - kMarginError)) * exact::kDown;
  extreme[i] = v;
}

const PolygonWork& ConvexPolygonSum::State::correct() {
  work = {};
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    if (until[i] > clock) continue;
    const std::uint32_t before = extreme[i];
    ++work.vertex_checks;
    climb(i, before);
    work.vertex_errors += extreme[i] != before;
  }
  return work;
}

const PolygonWork& ConvexPolygonSum::State::restart() {
  work = {};
  for (std::uint32_t i = 0; i < p.size(); ++i) climb(i, i == 0 ? 0 : extreme[i - 1]);
  work.vertex_checks = p.size();
  return work;
}

ConvexPolygonSum::ConvexPolygonSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
ConvexPolygonSum::ConvexPolygonSum(const ConvexPolygonSum& other) : state_(std::make_unique<State>(*other.state_)) {}
ConvexPolygonSum& ConvexPolygonSum::operator=(const ConvexPolygonSum& other) { return *this = ConvexPolygonSum(other); }
ConvexPolygonSum::ConvexPolygonSum(ConvexPolygonSum&&) noexcept = default;
ConvexPolygonSum& ConvexPolygonSum::operator=(ConvexPolygonSum&&) noexcept = default;
ConvexPolygonSum::~ConvexPolygonSum() = default;

Result<ConvexPolygonSum> ConvexPolygonSum::create(const Region& p, const Region& q) {
  Result<Polygon> a = make_polygon(p), b = make_polygon(q);
  if (!a) return a.error();
  if (!b) return b.error();
  auto state = std::make_unique<State>();
  state->p = std::move(a).value();
  state->q = std::move(b).value();
  state->extreme.assign(state->p.size(), 0);
  state->until.assign(state->p.size(), kNever);
  state->turn_to({}, {});
  state->restart();
  return ConvexPolygonSum(std::move(state));
}

const PolygonWork& ConvexPolygonSum::set(const PlanarPose& p, const PlanarPose& q) {
  State& s = *state_;
  if (p == s.p_pose && q == s.q_pose) return s.work = {};
  s.turn_to(p, q);
  return s.correct();
}
const PolygonWork& ConvexPolygonSum::rebuild() {
  state_->extreme[0] = 0;
  return state_->restart();
}
const PolygonWork& ConvexPolygonSum::work() const { return state_->work; }
const PlanarPose& ConvexPolygonSum::p_pose() const { return state_->p_pose; }
const PlanarPose& ConvexPolygonSum::q_pose() const { return state_->q_pose; }
bool ConvexPolygonSum::same_combinatorics(const ConvexPolygonSum& other) const {
  return state_->extreme == other.state_->extreme;
}

PolygonSum ConvexPolygonSum::sum() const {
  const State& s = *state_;
  std::vector<PolygonSum::Vertex> pairs;  // by the numbers of the polygons
  for (std::uint32_t i = 0; i < s.p.size(); ++i) {
    // Along edge i of P at a vertex of Q, then along Q up to where the next edge of P starts; the first edge of Q may
    // be parallel to edge i.
    const std::uint32_t next = s.p.after(i), end = s.extreme[next];
    std::uint32_t v = s.extreme[i];
    pairs.push_back({i, v});
    if (v != end && s.parallel(i, v)) v = s.q.after(v);
    for (; v != end; v = s.q.after(v)) pairs.push_back({next, v});
  }
  std::rotate(pairs.begin(), std::min_element(pairs.begin(), pairs.end()), pairs.end());
  PolygonSum sum;
  const ExactMatrix a = ExactMatrix::of(s.p_pose), b = ExactMatrix::of(s.q_pose);
  const auto placed = [](const ExactMatrix& m, Point at, int row) -> BigRational {
    return (BigRational(m.m[2 * row]) * exact::exact_value(at.x) +
            BigRational(m.m[2 * row + 1]) * exact::exact_value(at.y)) /
           BigRational(m.den);
  };
  for (const PolygonSum::Vertex& v : pairs) {
    sum.vertices.push_back({s.p.source[v.p], s.q.source[v.q]});
    const auto coordinate = [&](int row) {
      return exact::to_rational(placed(a, s.p.at[v.p], row) + placed(b, s.q.at[v.q], row));
    };
    sum.exact.push_back({coordinate(0), coordinate(1)});
  }
  return sum;
}

Rational PolygonSum::area_exact() const {
  BigRational twice = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const RationalPoint &a = exact[k], &b = exact[(k + 1) % exact.size()];
    twice += exact::exact_value(a.x) * exact::exact_value(b.y) - exact::exact_value(a.y) * exact::exact_value(b.x);
  }
  return exact::to_rational(BigRational(twice / 2));
}

std::vector<Point> PolygonSum::rounded() const {
  std::vector<Point> points;
  for (const RationalPoint& v : exact) points.push_back({v.x.to_double(), v.y.to_double()});
  return points;
}

}  // namespace dymsum
