// Signs of fractions: those that their nearest doubles prove, and those that they leave open.
#include "spatial/convolution/operand_signs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracles/random.h"
#include "oracles/sanitized.h"

namespace dymsum::oracles {
namespace {

using exact::BigInteger;
using exact::BigRational;
using exact::Fraction;
using spatial::ExactVertex;

int sign_of(const BigRational& v) { return v.sign(); }
std::array<BigRational, 3> minus(const std::array<BigRational, 3>& a, const std::array<BigRational, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
std::array<BigRational, 3> cross(const std::array<BigRational, 3>& u, const std::array<BigRational, 3>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

TEST(OperandSigns, OfFractionsAreThoseOfRationals) {
  // Positions of a small grid in sevenths, scaled by 2^power, some off by less than doubles tell: many lie in one
  // plane.
  Random random(77);
  int zero = 0, close = 0;
  for (const int power : {0, 900, -900}) {
    for (int round = 0; round < rounds(400); ++round) {
      std::vector<std::array<BigRational, 3>> at(4);
      std::vector<ExactVertex> vertices;
      const BigInteger shift = BigInteger(1) << std::abs(power);
      for (auto& p : at) {
        for (BigRational& c : p) {
          c = BigRational(random.below(4), 7);
          if (random.chance(5)) c += BigRational(random.below(3) - 1, BigInteger(3) << 200);
          if (power > 0) c *= shift;
          if (power < 0) c /= shift;
        }
        vertices.push_back({Fraction(p[0]), Fraction(p[1]), Fraction(p[2])});
      }
      const spatial::SignsOfFractions signs(vertices);
      const auto u = minus(at[1], at[0]), v = minus(at[2], at[0]), w = minus(at[3], at[0]), n = cross(u, v);
      const BigRational volume = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
      EXPECT_EQ(signs.orient(0, 1, 2, 3), sign_of(volume));
      EXPECT_EQ(signs.normal(0, 1, 2, exact::Axis::x), sign_of(n[0]));
      EXPECT_EQ(signs.normal(0, 1, 2, exact::Axis::y), sign_of(n[1]));
      EXPECT_EQ(signs.normal(0, 1, 2, exact::Axis::z), sign_of(n[2]));
      EXPECT_EQ(signs.order(0, 1, exact::Axis::y), sign_of(u[1]));
      const BigInteger cube = shift * shift * shift;
      const BigRational size = power > 0 ? BigRational(cube) : BigRational(BigInteger(1), cube);
      zero += volume == 0;
      close += volume != 0 && abs(volume) < BigRational(size / BigInteger(BigInteger(1) << 100));
    }
  }
  EXPECT_GT(zero, rounds(400) / 4);
  EXPECT_GT(close, rounds(400) / 100);
}

}  // namespace
}  // namespace dymsum::oracles
