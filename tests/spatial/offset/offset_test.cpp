// Offsets: their bounds, by distances and by closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/solid_offset.h"
#include "dymsum/solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

constexpr double kPi = 3.14159265358979323846;

Mesh mesh(const MeshData& data) { return Mesh::create(data).value(); }

TEST(TessellatedBall, LiesBetweenItsRadiiAndOnItsSideOfTheBall) {
  for (const double radius : {1.0, 0.3, 1000.0, 1e-9}) {
    for (const double fraction : {0.3, 0.05, 0.004}) {
      for (const OffsetBound bound : {OffsetBound::inside, OffsetBound::outside}) {
        const TessellatedBall ball = tessellated_ball(radius, fraction * radius, bound).value();
        EXPECT_LE(ball.high - ball.low, fraction * radius);
        if (bound == OffsetBound::inside) EXPECT_LE(ball.high, radius);
        else EXPECT_GE(ball.low, radius);
        for (const Point3& v : ball.mesh.vertices()) EXPECT_LE(std::hypot(v.x, v.y, v.z), ball.high);
        const double size = 4 * kPi / 3;
        EXPECT_GE(volume(ball.mesh), size * std::pow(ball.low, 3) * (1 - 1e-12));
        EXPECT_LE(volume(ball.mesh), size * std::pow(ball.high, 3) * (1 + 1e-12));
        EXPECT_LE(static_cast<double>(ball.mesh.faces().size()), 40 + 8 / fraction);
      }
    }
  }
}

TEST(TessellatedBall, RefusesWhatIsNoRadiusOrTooFine) {
  EXPECT_EQ(tessellated_ball(0, 1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(tessellated_ball(NAN, 1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(tessellated_ball(1, 0).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(tessellated_ball(1, 1e-9).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(offset(mesh(box(1)), 0, 1).error().code, ErrorCode::out_of_range);
}

TEST(SolidOffset, OfACubeHasTheVolumeOfSteinersFormula) {
  const auto steiner = [](double d) { return 8 + 24 * d + 6 * kPi * d * d + 4 * kPi / 3 * d * d * d; };
  for (const OffsetBound bound : {OffsetBound::inside, OffsetBound::outside}) {
    const SolidOffset out = offset(mesh(box(1)), 0.5, 0.02, bound).value();
    EXPECT_GE(out.solid.volume(), steiner(out.low) * (1 - 1e-12));
    EXPECT_LE(out.solid.volume(), steiner(out.high) * (1 + 1e-12));
    EXPECT_TRUE(bound == OffsetBound::inside ? out.high <= 0.5 : out.low >= 0.5);
    const SolidOffset in = offset(mesh(box(1)), -0.5, 0.02, bound).value();
    EXPECT_GE(in.solid.volume(), std::pow(2 + 2 * in.low, 3) * (1 - 1e-12));
    EXPECT_LE(in.solid.volume(), std::pow(2 + 2 * in.high, 3) * (1 + 1e-12));
    EXPECT_TRUE(bound == OffsetBound::inside ? in.high <= -0.5 : in.low >= -0.5);
  }
}

/// From the ell, positive outside, negative inside.
double distance_to_ell(const Point3& p) {
  const auto to_box = [&](double x0, double y0, double x1, double y1) {
    const double dx = std::max({x0 - p.x, p.x - x1, 0.0}), dy = std::max({y0 - p.y, p.y - y1, 0.0}),
                 dz = std::max({-p.z, p.z - 10, 0.0});
    return std::hypot(dx, dy, dz);
  };
  const double outside = std::min(to_box(0, 0, 10, 4), to_box(0, 0, 4, 10));
  if (outside > 0) return outside;
  return -std::min(
      {p.x, p.y, p.z, 10 - p.x, 10 - p.y, 10 - p.z, std::hypot(std::max(4 - p.x, 0.0), std::max(4 - p.y, 0.0))});
}

TEST(SolidOffset, SurfaceLiesBetweenTheTwoDistances) {
  for (const double distance : {0.75, -0.75}) {
    for (const OffsetBound bound : {OffsetBound::inside, OffsetBound::outside}) {
      const SolidOffset result = offset(mesh(ell()), distance, 0.1, bound).value();
      EXPECT_LE(result.high - result.low, 0.1);
      EXPECT_TRUE(bound == OffsetBound::inside ? result.high <= distance : result.low >= distance);
      ASSERT_GT(result.solid.faces.size(), 8u);
      const MeshData surface = result.solid.rounded().value().mesh;
      for (const Face& f : surface.faces) {
        const Point3 &a = surface.vertices[f[0]], &b = surface.vertices[f[1]], &c = surface.vertices[f[2]];
        const Point3 centre{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
        for (const Point3& at : {a, centre}) {
          EXPECT_GE(distance_to_ell(at), result.low - 1e-12);
          EXPECT_LE(distance_to_ell(at), result.high + 1e-12);
        }
      }
    }
  }
  EXPECT_TRUE(offset(mesh(ell()), -3, 0.5).value().solid.faces.empty()) << "arms 4 wide";
}

}  // namespace
}  // namespace dymsum
