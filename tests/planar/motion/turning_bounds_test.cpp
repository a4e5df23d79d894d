// Bounds of the doubles of turning operands against exact values: they hold, and are not many times too large.
#include "planar/motion/turning_forms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "dymsum/orientation.h"
#include "dymsum/shapes.h"
#include "oracles/digits.h"
#include "oracles/random.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;
using oracles::Random;

struct MadeForms {
  std::shared_ptr<const OperandPair> base;
  std::unique_ptr<TurningForms> forms;

  MadeForms(const Region& p, const Region& q) {
    base = pair_of_regions(p, q, PairOptions{.moved = 1}).value();
    forms = std::make_unique<TurningForms>(*base);
  }
  /// A vertex in the forms' doubles, less the centre of the rotating operand.
  std::array<BigRational, 2> vertex(std::uint32_t op, std::uint32_t v) const {
    const BigRational unit =
        exact::exact_value(std::ldexp(1.0, base->lattice->grid_exponent)) / exact::exact_value(base->lattice->unit);
    const TurningForms::Vec& g = forms->grid_point(op, v);
    std::array<BigRational, 2> at{BigRational(g.x) * unit, BigRational(g.y) * unit};
    if (op == 0) return at;
    return {at[0] - exact::exact_value(forms->centre().x), at[1] - exact::exact_value(forms->centre().y)};
  }
  /// A value of `degree` lengths in the forms' doubles: p / (1 + t^2)^(degree / 2) at t.
  BigRational value(const exact::Polynomial& p, const BigRational& t, int degree) const {
    BigRational sum = 0;
    for (int k = p.degree(); k >= 0; --k) sum = sum * t + BigRational(p[k].value());
    const BigRational unit =
        exact::exact_value(std::ldexp(1.0, base->lattice->grid_exponent)) / exact::exact_value(base->lattice->unit);
    for (int k = 0; k < degree; ++k) sum *= unit;
    for (int k = 0; k < degree / 2; ++k) sum /= 1 + t * t;
    return sum;
  }
};

/// A ring of vertices on free doubles about (x, y), so that every coordinate of a lattice is rounded.
Region ring(Random& random, double x, double y, double size) {
  RegionData data;
  data.parts.emplace_back();
  const int n = 5;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.4 * random.signed_unit()) / n;
    data.parts[0].outer.push_back({x + size * std::cos(angle), y + size * std::sin(angle)});
  }
  return Region::create(std::move(data)).value();
}

/// The heading of 2 atan(t), as wrong as kHeading allows where `wrong`.
Heading heading_at(double t, bool wrong, Random& random) {
  const double d = 1 + t * t, off = 15 * exact::kRoundoff;
  Heading h{(1 - t * t) / d, 2 * t / d};
  if (wrong) h = {h.c + (random.chance(50) ? off : -off), h.s + (random.chance(50) ? off : -off)};
  return h;
}

struct Fractions {
  double side = 0, placed = 0, cross = 0, concurrency = 0;
};

void add(double& most, double value, const BigRational& truth, double bound) {
  if (bound > 0)
    most = std::max(most, exact::round_to_double(BigRational(abs(exact::exact_value(value) - truth))) / bound);
}

Fractions largest_fractions(int rounds) {
  Random random(11);
  Fractions most;
  for (int k = 0; k < rounds; ++k) {
    const double sizes[] = {1, 0x1p-3, 0x1p-9};
    const double sp = sizes[random.below(3)], sq = sizes[random.below(3)];
    const MadeForms m(ring(random, 1.3 * random.signed_unit(), 1.1, sp), ring(random, 0.7, random.signed_unit(), sq));
    const TurningForms& f = *m.forms;
    for (int i = 0; i < 40; ++i) {
      const double t = random.signed_unit();
      const BigRational at = exact::exact_value(t);
      const Heading h = heading_at(t, random.chance(70), random);
      const auto segment = [&] {
        const auto side = static_cast<std::uint32_t>(random.below(2));
        return WalkSegment{side, static_cast<std::uint32_t>(random.below(5)),
                           static_cast<std::uint32_t>(random.below(5))};
      };
      const WalkSegment a = segment(), b = segment(), c = segment();
      const Pair v = TurningForms::start(b);
      const BigRational side = m.value(f.exact_side(a, v, 0), at, 2);
      add(most.side, f.side(a, v).at(h), side, f.side_error(a));
      const Point d = f.direction(a, h), o = f.position(TurningForms::start(a), h), x = f.position(v, h);
      add(most.placed, d.x * (x.y - o.y) - d.y * (x.x - o.x), side, f.side_error(a));
      const BigRational cross = m.value(f.exact_cross(a, b, 0), at, 2);
      const double lengths = f.length1(a) * f.length1(b);
      add(most.cross, f.cross(a, b).at(h), cross, kTurnedCross * lengths);
      const Point e = f.direction(b, h);
      add(most.cross, d.x * e.y - d.y * e.x, cross, kTurnedCross * lengths);
      if (a.side != b.side || b.side != c.side)
        add(most.concurrency, f.concurrency(a, b, c).at(h), m.value(f.exact_concurrency(a, b, c, 0), at, 4),
            f.concurrency_error(a, b, c));
    }
  }
  return most;
}

TEST(TurningBounds, forms_err_by_less_and_not_by_much_less) {
  const Fractions most = largest_fractions(100);
  RecordProperty("shares", std::to_string(most.side) + " " + std::to_string(most.placed) + " " +
                               std::to_string(most.cross) + " " + std::to_string(most.concurrency));
  for (const double fraction : {most.side, most.placed, most.cross, most.concurrency}) {
    EXPECT_LE(fraction, 1);
    EXPECT_GT(fraction, 1.0 / 40) << most.side << ' ' << most.placed << ' ' << most.cross << ' ' << most.concurrency;
  }
}

struct Turned {
  BigRational c, s;
  explicit Turned(double t) {
    const BigRational at = exact::exact_value(t);
    c = (1 - at * at) / (1 + at * at);
    s = 2 * at / (1 + at * at);
  }
  std::array<BigRational, 2> operator()(const std::array<BigRational, 2>& p) const {
    return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
  }
};

// Places, directions, and what is made of them: differences and sides at a position, positions turned back.
TEST(TurningBounds, places_err_by_less_and_not_by_much_less) {
  Random random(13);
  double position = 0, direction = 0, of_difference = 0, of_side = 0, back = 0;
  for (int k = 0; k < 60; ++k) {
    const double sizes[] = {1, 0x1p-3, 0x1p-9};
    const MadeForms m(ring(random, 1.3 * random.signed_unit(), 1.1, sizes[random.below(3)]),
                      ring(random, 0.7, random.signed_unit(), sizes[random.below(3)]));
    const TurningForms& f = *m.forms;
    const double span = f.span();
    for (int i = 0; i < 40; ++i) {
      const double t = random.signed_unit();
      const Turned turned(t);
      const Heading h = heading_at(t, random.chance(70), random);
      const auto any = [&] { return static_cast<std::uint32_t>(random.below(5)); };
      const Pair v{any(), any()};
      const Point at = f.position(v, h);
      const auto q = m.vertex(0, v.p), p = turned(m.vertex(1, v.q));
      add(position, at.x, q[0] + p[0], kTurnedPosition * span);
      add(position, at.y, q[1] + p[1], kTurnedPosition * span);
      const WalkSegment edge{1, any(), any()};
      const Point d = f.direction(edge, h);
      const auto from = m.vertex(1, edge.edge), to = m.vertex(1, f.operand(1).next[edge.edge]);
      const auto e = turned({to[0] - from[0], to[1] - from[1]});
      add(direction, d.x, e[0], kTurnedDirection * f.length1(edge));
      add(direction, d.y, e[1], kTurnedDirection * f.length1(edge));
      // A position that errs by two positions, against vertices of either operand.
      const double off = 2 * kTurnedPosition * span, zx = at.x + (random.chance(50) ? off : -off) * 0.9,
                   zy = at.y + (random.chance(50) ? off : -off) * 0.9;
      const Pair w{any(), any()};
      const Point moved = f.position({0, w.q}, h), of_fixed = f.points(0)[w.p], zero = f.points(0)[0];
      const double tx = zx - (moved.x - zero.x), ty = zy - (moved.y - zero.y);
      const auto wq = m.vertex(0, w.p), wp = turned(m.vertex(1, w.q));
      const BigRational ex = q[0] + p[0] - wp[0] - wq[0], ey = q[1] + p[1] - wp[1] - wq[1];
      add(of_difference, tx - of_fixed.x, ex, kOverlapPosition * span);
      add(of_side, d.x * (ty - of_fixed.y) - d.y * (tx - of_fixed.x), e[0] * ey - e[1] * ex,
          kOverlapSide * f.length1(edge) * span);
      // As TurnedRings does where the resting operand turned for the user.
      const Point offset{3 * random.signed_unit(), random.signed_unit()};
      const double x = (h.c * at.x - h.s * at.y) + (h.c * offset.x - h.s * offset.y);
      const auto whole = turned({exact::exact_value(at.x) + exact::exact_value(offset.x),
                                 exact::exact_value(at.y) + exact::exact_value(offset.y)});
      add(back, x, whole[0], kTurnedBack * span + kTurnedOffset * (std::abs(offset.x) + std::abs(offset.y)));
    }
  }
  for (const double most : {position, direction, of_difference, of_side, back}) {
    EXPECT_LE(most, 1);
    EXPECT_GT(most, 1.0 / 16) << position << ' ' << direction << ' ' << of_difference << ' ' << of_side << ' ' << back;
  }
}

// Fractions of crossings from the worst sides and cross products that are possible, in units of what a side is granted.
TEST(TurningBounds, shares_of_crossings_err_by_less_and_not_by_much_less) {
  Random random(14);
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    const double e = 0x1p-40, side = e * (88.0 / 256), end = e * (79.0 / 256), cross = e * (56.0 / 256);
    const double d = e * (1 + 50 * std::abs(random.signed_unit())), t = std::abs(random.signed_unit());
    const auto wrong = [&](double by) { return random.chance(50) ? by : -by; };
    const double n = t * d + wrong(side + end), whole = d + wrong(cross);
    if (!(whole > e)) continue;
    add(most, n * (1 / whole), exact::exact_value(t), kCrossingSlack * e / whole + kCrossingFraction);
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 8);
}

// Angles against those of fifty digits: of orientations, and of where segments begin and end.
TEST(TurningBounds, angles_err_by_less) {
  using oracles::Digits;
  Random random(15);
  const Digits turn = 2 * Digits::pi();
  double of_double = 0, of_difference = 0, of_span = 0;
  const auto off = [&](const Digits& a) {  // from a multiple of a turn
    return static_cast<double>(abs(Digits(a - turn * round(Digits(a / turn)))));
  };
  for (int k = 0; k < 40; ++k) {
    const MadeForms m(ring(random, 1.3 * random.signed_unit(), 1.1, 1),
                      ring(random, 0.7, random.signed_unit(), 0x1p-3));
    const RotationCatalog catalog(*m.forms);
    const auto angle = [&](std::uint32_t op, std::uint32_t edge) {
      const auto a = m.vertex(op, edge), b = m.vertex(op, m.forms->operand(op).next[edge]);
      return Digits(atan2(Digits(BigRational(b[1] - a[1])), Digits(BigRational(b[0] - a[0]))));
    };
    const double t = random.signed_unit() * (random.chance(50) ? 1 : 100), u = random.signed_unit();
    const double theta = Orientation::of(exact::to_rational(exact::exact_value(t)))->radians(),
                 phi = Orientation::of(exact::to_rational(exact::exact_value(u)))->radians();
    const Digits truly = 2 * atan(Digits(t)), other = 2 * atan(Digits(u));
    of_double = std::max(of_double, off(Digits(theta) - truly) / kAngleDouble);
    of_difference = std::max(of_difference, off(Digits(theta - phi) - (truly - other)) / kAngleDifference);
    for (std::uint32_t side = 0; side < 2; ++side)
      for (std::uint32_t e = 0; e < 5; ++e)
        for (std::uint32_t v = 0; v < 5; ++v) {
          const WalkSegment s{side, e, v};
          if (!catalog.may_exist(s)) continue;
          const std::uint32_t op = 1 - side, in = m.forms->operand(op).prev[v];
          const RotationCatalog::Span span = catalog.span(s, theta);
          const Digits at_in = side == 0 ? Digits(angle(0, e) - truly - angle(1, in))
                                         : Digits(angle(0, in) - truly - angle(1, e)),
                       at_out = side == 0 ? Digits(angle(0, e) - truly - angle(1, v))
                                          : Digits(angle(0, v) - truly - angle(1, e));
          of_span = std::max({of_span, off(Digits(side == 0 ? span.to : span.from) - at_in) / kAngleSlack,
                              off(Digits(side == 0 ? span.from : span.to) - at_out) / kAngleSlack});
        }
  }
  EXPECT_LE(of_double, 1);
  EXPECT_GT(of_double, 1.0 / 64);
  EXPECT_LE(of_difference, 1);
  EXPECT_GT(of_difference, 1.0 / 1024);
  EXPECT_LE(of_span, 1);
  EXPECT_GT(of_span, 1.0 / 8192);
}

// A turning edge so short that the roundings of its ends are a good part of it, crossed by a long one at a small angle.
TEST(TurningBounds, short_edges_meet_what_crosses_them) {
  Random random(12);
  int crossing = 0;
  for (int k = 0; k < 400; ++k) {
    const double y = 0.8 + 0.1 * random.signed_unit(), far = 0.9 + 0.05 * random.signed_unit(), ulp = 0x1p-53;
    const Point a{far, y}, b{far - 17 * ulp, y + 31 * ulp};
    RegionData turning;
    turning.parts.emplace_back();
    turning.parts[0].outer = {{-0.71, -0.63}, {far - 0.01, -0.6}, a, b, {-0.7, 0.83}};
    // Where the midpoint of the short edge is at this angle, from the vertex v of the standing operand.
    const double t = 0.2 + 0.1 * random.signed_unit(), d = 1 + t * t, c = (1 - t * t) / d, s = 2 * t / d;
    const BigRational rt = exact::exact_value(t), rc = (1 - rt * rt) / (1 + rt * rt), rs = 2 * rt / (1 + rt * rt);
    const auto turned = [&](const BigRational& px, const BigRational& py) {
      return std::array{BigRational(rc * px - rs * py), BigRational(rs * px + rc * py)};
    };
    const auto r = [](double v) { return exact::exact_value(v); };
    const auto midpoint = turned((r(a.x) + r(b.x)) / 2, (r(a.y) + r(b.y)) / 2), low = turned(r(-0.71), r(-0.63));
    const Point v{0, 0};
    // The long edge, plus the vertex opposite, passes there: nearly parallel to the short one, the other way.
    const double gx = b.x - a.x, gy = b.y - a.y, length = std::hypot(gx, gy), off = 0.1 * random.signed_unit();
    const double ux = (c * gx - s * gy) / length, uy = (s * gx + c * gy) / length;
    const Point g{ux - off * uy, uy + off * ux};
    const Point centre{exact::round_to_double(BigRational(midpoint[0] - low[0])),
                       exact::round_to_double(BigRational(midpoint[1] - low[1]))};
    RegionData standing;
    standing.parts.resize(2);
    standing.parts[0].outer = {{-0.3, -0.1}, {v.x, v.y}, {-0.3, 0.1}};
    standing.parts[1].outer = {{centre.x + 0.5 * g.x, centre.y + 0.5 * g.y},
                               {centre.x - 0.5 * g.x, centre.y - 0.5 * g.y},
                               {centre.x + g.y, centre.y - g.x}};
    const auto p = Region::create(std::move(standing)), q = Region::create(std::move(turning));
    if (!p.ok() || !q.ok()) continue;
    const MadeForms m(*p, *q);
    const TurningForms& f = *m.forms;
    const RotationCatalog catalog(f);
    const RotationGrid grid(f, 8);
    const RotatingWindow window(grid, catalog, 2 * std::atan(t), 0x1p-40, false);
    const auto across = [&](const RotatingSegment& i, const RotatingSegment& j) {
      const auto sign = [&](Pair x) { return f.exact_side(i, x, 0).sign_at(rt); };
      return sign(j.start()) * sign(j.end) < 0;
    };
    const auto same = [](Pair i, Pair j) { return i == j; };
    std::set<std::pair<std::uint32_t, std::uint32_t>> meet;
    for (const RotationCandidate& n : window.candidates)
      meet.insert(std::minmax(window.segment_of(n.a), window.segment_of(n.b)));
    for (std::uint32_t i = 0; i < window.segments.size(); ++i)
      for (std::uint32_t j = i + 1; j < window.segments.size(); ++j) {
        const RotatingSegment &x = window.segments[i], &z = window.segments[j];
        if (!x.throughout || !z.throughout || std::min(f.length1(x), f.length1(z)) > 0x1p-40) continue;
        if (same(x.start(), z.start()) || same(x.start(), z.end) || same(x.end, z.start()) || same(x.end, z.end))
          continue;
        if (!across(x, z) || !across(z, x)) continue;
        ++crossing;
        EXPECT_TRUE(meet.contains({i, j})) << k;
      }
  }
  EXPECT_GT(crossing, 50);
}

}  // namespace
}  // namespace dymsum::planar
