// Pieces in floats: those that touch are never distinguished, and those a little farther apart are. Nothing looks at
// pairs again that are distinguished. Most of what kApart counts are slopes over half a radian, which no touch in a
// narrow range reaches: there it is a hundred times what roundings are seen to make, and the second distance keeps it
// from growing.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "oracles/random.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {
namespace {

/// A segment of an edge at the midpoint of the range, and the fractions of it at which its piece begins and ends.
struct DrawnPiece {
  std::uint32_t side = 0;
  Point fixed, turning, d;
  double head = 0, tail = 1;

  // Fixed vertices in [0, 31/32], turning ones at most 1/64 from the centre: the span is 1.
  explicit DrawnPiece(oracles::Random& random) : side(static_cast<std::uint32_t>(random.below(2))) {
    const double size = random.chance(70) ? 1 : std::ldexp(1.0, -random.below(12));
    const auto fixed_one = [&] { return 0.484 + 0.484 * random.signed_unit(); };
    const auto turning_one = [&] { return 0.011 * random.signed_unit(); };
    fixed = {fixed_one(), fixed_one()};
    turning = {turning_one(), turning_one()};
    d = side == 0 ? Point{size * (fixed_one() - fixed.x), size * (fixed_one() - fixed.y)}
                  : Point{size * (turning_one() - turning.x), size * (turning_one() - turning.y)};
    if (random.chance(50)) head = std::abs(random.signed_unit()) / 2;
    if (random.chance(50)) tail = 1 - std::abs(random.signed_unit()) / 2;
  }
  Point at(double fraction) const {
    return {fixed.x + turning.x + fraction * d.x, fixed.y + turning.y + fraction * d.y};
  }
  void add_to(PieceLines& lines) const { lines.add(side, fixed, turning, d, head, tail); }
};

/// The second one moved until one of its ends touches the first one, or is so far off it that all of it is farther.
std::optional<DrawnPiece> moved_to(const DrawnPiece& a, DrawnPiece b, bool by_head, double fraction, double off) {
  const Point on = a.at(a.head + fraction * (a.tail - a.head)), end = b.at(by_head ? b.head : b.tail),
              other = b.at(by_head ? b.tail : b.head);
  const double length = std::hypot(a.d.x, a.d.y),
               away = a.d.x * (other.y - end.y) - a.d.y * (other.x - end.x) > 0 ? off : -off;
  b.fixed.x += on.x - end.x - away * a.d.y / length;
  b.fixed.y += on.y - end.y + away * a.d.x / length;
  if (std::min(b.fixed.x, b.fixed.y) < 0 || std::max(b.fixed.x, b.fixed.y) > 0.96875) return std::nullopt;
  return b;
}

TEST(PieceLinesBounds, pieces_that_touch_are_not_told_apart_and_those_a_little_away_are) {
  oracles::Random random(24);
  int touching = 0, away = 0;
  for (int k = 0; k < 60000; ++k) {
    const DrawnPiece a(random), drawn(random);
    const bool by_head = random.chance(50);
    const double fraction = std::abs(random.signed_unit());
    for (const double off : {0.0, 512 * exact::kFloatRoundoff}) {
      const std::optional<DrawnPiece> b = moved_to(a, drawn, by_head, fraction, off);
      if (!b) continue;
      PieceLines lines(1, 0x1p-40);
      a.add_to(lines);
      b->add_to(lines);
      const std::uint32_t apart = lines.apart({0, 1, 0, 1}, {1, 0, 1, 0});
      ASSERT_EQ(apart, off == 0 ? 0u : 15u) << k;
      ++(off == 0 ? touching : away);
    }
  }
  EXPECT_GT(touching, 4000);
  EXPECT_GT(away, 4000);
}

// Edges that doubles hardly know to be orthogonal are in the chart that exact products tell. Roundings of free edges
// reach a fiftieth of what is granted.
TEST(PieceLinesBounds, charts_of_alignments_of_nearly_orthogonal_edges) {
  oracles::Random random(25);
  for (int k = 0; k < 2000; ++k) {
    RegionData fixed, turning;
    fixed.parts.emplace_back();
    turning.parts.emplace_back();
    for (const Point v : {Point{0, 0}, {1, 0}, {0.7, 0.8}, {-0.2, 0.6}}) {
      const Point p{v.x + 0.1 * random.signed_unit(), v.y + 0.1 * random.signed_unit()};
      const double by = 0x1p-51 * random.signed_unit();
      fixed.parts[0].outer.push_back(p);
      turning.parts[0].outer.push_back({-p.y + by * p.x, p.x + by * p.y});
    }
    const auto base = pair_of_regions(Region::create(std::move(fixed)).value(),
                                      Region::create(std::move(turning)).value(), PairOptions{.moved = 1})
                          .value();
    const TurningForms forms(*base);
    for (std::uint32_t e = 0; e < 4; ++e)
      for (std::uint32_t f = 0; f < 4; ++f) {
        const auto vector = [&](std::uint32_t op, std::uint32_t i) {
          const TurningForms::Vec &from = forms.grid_point(op, i),
                                  &to = forms.grid_point(op, forms.operand(op).next[i]);
          return std::array<exact::BigInteger, 2>{exact::BigInteger(exact::BigInteger(to.x) - from.x),
                                                  exact::BigInteger(exact::BigInteger(to.y) - from.y)};
        };
        const auto d = vector(1, e), g = vector(0, f);
        const int along = exact::BigInteger(d[0] * g[0] + d[1] * g[1]).sign(),
                  across = exact::BigInteger(d[0] * g[1] - d[1] * g[0]).sign();
        const int chart = along != 0 ? (along > 0 ? 0 : 1) : across > 0 ? 0 : 1;
        ASSERT_EQ(forms.alignment_chart(e, f), chart) << k;
      }
  }
}

}  // namespace
}  // namespace dymsum::planar
