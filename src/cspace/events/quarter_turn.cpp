#include "cspace/events/quarter_turn.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

constexpr std::int64_t kLargest = std::int64_t{1} << 28;
constexpr std::int64_t kExact = std::int64_t{1} << 10;
constexpr std::array<Heading, 4> kHeadings{Heading{1, 0}, Heading{0, 1}, Heading{-1, 0}, Heading{0, -1}};

}  // namespace

bool QuarterTurn::representable(const TurningForms& forms) {
  for (std::uint32_t op = 0; op < 2; ++op)
    for (std::uint32_t v = 0; v < forms.size(op); ++v) {
      const auto& [x, y] = forms.grid_point(op, v);
      if (abs(x) >= kLargest || abs(y) >= kLargest) return false;
    }
  return true;
}

QuarterTurn::QuarterTurn(const TurningForms& forms, int quarter)
    : forms_(forms), heading_(kHeadings[static_cast<std::size_t>(quarter)]) {
  const auto c = static_cast<std::int64_t>(heading_.c), s = static_cast<std::int64_t>(heading_.s);
  for (std::uint32_t op = 0; op < 2; ++op)
    for (std::uint32_t v = 0; v < forms.size(op); ++v) {
      const auto x = static_cast<std::int64_t>(forms.grid_point(op, v).x),
                 y = static_cast<std::int64_t>(forms.grid_point(op, v).y);
      at_[op].push_back(op == 0 ? Vec{x, y} : Vec{c * x - s * y, s * x + c * y});
      exact_forms_ = exact_forms_ && std::abs(x) <= kExact && std::abs(y) <= kExact;
    }
}

QuarterTurn::Vec QuarterTurn::direction(const WalkSegment& s) const {
  const Vec &a = at_[s.side][s.edge], &b = at_[s.side][forms_.operand(s.side).next[s.edge]];
  return {b.x - a.x, b.y - a.y};
}

std::int64_t QuarterTurn::side(const WalkSegment& s, Pair v) const {
  const Vec d = direction(s), from = position(TurningForms::start(s)), to = position(v);
  return d.x * (to.y - from.y) - d.y * (to.x - from.x);
}

// The origin is at the start of a, as in TurningForms::concurrency.
bool QuarterTurn::concurrent(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const {
  const Vec d = direction(a), e = direction(b), f = direction(c);
  const std::int64_t ca = f.x * d.y - f.y * d.x, ab = d.x * e.y - d.y * e.x;
  return exact::i128{side(b, TurningForms::start(a))} * ca + exact::i128{side(c, TurningForms::start(a))} * ab == 0;
}

int QuarterTurn::sign_beside(const TrigForm2& f, double width) const {
  if (f.at(heading_) != 0) return 0;
  // At quarter turns cosines and sines, also of twice the angle, are 0, 1 and -1.
  const double c = heading_.c, s = heading_.s, c2 = c * c - s * s, s2 = 2 * c * s;
  const std::array<double, 4> derivative{f.slope(heading_), -(f.b * c + f.g * s) - 4 * (f.b2 * c2 + f.g2 * s2),
                                         f.b * s - f.g * c + 8 * (f.b2 * s2 - f.g2 * c2),
                                         f.b * c + f.g * s + 16 * (f.b2 * c2 + f.g2 * s2)};
  double factor = 4;  // 2^(m + 1)
  for (std::size_t m = 1; m <= derivative.size(); ++m, factor *= 2) {
    const double d = derivative[m - 1];
    if (d == 0) continue;
    const double next = std::abs(f.b) + std::abs(f.g) + factor * (std::abs(f.b2) + std::abs(f.g2));
    if (!(std::abs(d) > next * std::abs(width) / static_cast<double>(m + 1) * exact::kOutwards)) return 0;
    return (d > 0) == (width > 0 || m % 2 == 0) ? 1 : -1;
  }
  return 0;
}

bool QuarterTurn::aligned(std::uint32_t e, std::uint32_t f) const {
  const Vec d = direction({1, e, 0}), g = direction({0, f, 0});
  return d.x * g.y - d.y * g.x == 0 && d.x * g.x + d.y * g.y > 0;
}

// Crowded: more pairs of edges are aligned than there are edges. With each come a dozen events or more, where its
// segments meet others; a whole slice looks at some segments per edge.
CrowdedQuarters::CrowdedQuarters(const TurningForms& forms, const std::vector<Alignment>& alignments) {
  if (!QuarterTurn::representable(forms)) return;
  for (std::size_t k = 0; k < 4; ++k) {
    const double theta = (k == 3 ? 3 : static_cast<double>(k)) * std::numbers::pi / 2;
    const auto low = std::lower_bound(alignments.begin(), alignments.end(), theta - kAngleSlack,
                                      [](const Alignment& a, double t) { return a.theta < t; });
    auto high = low;
    while (high != alignments.end() && high->theta <= theta + kAngleSlack) ++high;
    const double per_edge = static_cast<double>(high - low) / (forms.size(0) + forms.size(1));
    if (per_edge <= 1) continue;
    const QuarterTurn turn(forms, static_cast<int>(k));
    const auto pair = std::find_if(low, high, [&](const Alignment& a) { return turn.aligned(a.e, a.f); });
    if (pair != high) quarters_[k].emplace(CrowdedQuarter{turn, *pair, per_edge});
  }
}

const CrowdedQuarter* CrowdedQuarters::at(int chart, double t) const {
  if (t != -1 && t != 0 && t != 1) return nullptr;
  const int number = t == 0 ? 2 * chart : t > 0 ? 2 * chart + 1 : 3 - 2 * chart;
  const std::optional<CrowdedQuarter>& quarter = quarters_[static_cast<std::size_t>(number)];
  return quarter ? &*quarter : nullptr;
}

}  // namespace dymsum::planar
