// Depth of points, segments and open surfaces in a solid.
#include <gtest/gtest.h>

#include <random>

#include "depth/touching_oracle.h"
#include "dymsum/solids.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

Mesh thin(std::vector<Point3> vertices, std::vector<Face> faces) {
  return Mesh::with_thin_parts({std::move(vertices), std::move(faces)}).value();
}

/// The square of the distance of a position to a solid's surface, in rationals.
BigRational squared_distance(const TouchingShape& shape, const Position& x) {
  const auto minus = [](const Position& a, const Position& b) {
    return Position{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto dot = [](const Position& a, const Position& b) {
    return BigRational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  std::optional<BigRational> least;
  const auto offer = [&](const Position& at) {
    const Position d = minus(at, x);
    if (const BigRational s = dot(d, d); !least || s < *least) least = s;
  };
  for (const Position& v : shape.at) offer(v);
  for (const auto& [a, b] : shape.edges) {
    const Position d = minus(shape.at[b], shape.at[a]);
    const BigRational s = dot(minus(x, shape.at[a]), d) / dot(d, d);
    if (s > 0 && s < 1) offer({shape.at[a][0] + s * d[0], shape.at[a][1] + s * d[1], shape.at[a][2] + s * d[2]});
  }
  for (std::uint32_t f = 0; f < shape.faces.size(); ++f) {
    const Face& face = shape.faces[f];
    Position n{};
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Position &a = shape.at[face[k]], &b = shape.at[face[(k + 1) % face.size()]];
      for (std::size_t i = 0; i < 3; ++i) n[i] += a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
    const BigRational s = dot(minus(shape.at[face[0]], x), n) / dot(n, n);
    const Position foot{x[0] + s * n[0], x[1] + s * n[1], x[2] + s * n[2]};
    if (feature_holds(shape, {SolidFeature::Kind::face, f, 0}, foot)) offer(foot);
  }
  return *least;
}

TEST(ThinDepth, of_a_point_is_its_distance_to_the_surface) {
  std::mt19937_64 random(3);
  const Mesh point = thin({{0.25, -0.5, 0.125}}, {{0}});
  int inside = 0;
  for (int round = 0; round < 40; ++round) {
    const Mesh p = round == 0   ? Mesh::create(ell()).value()
                   : round == 1 ? Mesh::create(tunnel()).value()
                                : random_solids::valid_polyhedron(random);
    SolidDepth pair = SolidDepth::create(p, point).value(), other = SolidDepth::create(point, p).value();
    for (int k = 0; k < 5; ++k) {
      const auto along = [&] { return 0.25 * (static_cast<double>(random() % 33) - 16); };
      const Point3 at{along(), along(), along()};
      const SolidDistance d = pair.at(at);
      const Position x{exact::exact_value(at.x + 0.25), exact::exact_value(at.y - 0.5),
                       exact::exact_value(at.z + 0.125)};
      EXPECT_EQ(exact::exact_value(d.squared), squared_distance(touching_shape(p, {}), x)) << round;
      const SolidDistance back = other.at({-at.x, -at.y, -at.z});
      EXPECT_EQ(back.squared, d.squared);
      EXPECT_EQ(back.meeting, d.meeting);
      inside += d.meeting == Meeting::overlapping;
    }
  }
  EXPECT_GT(inside, 10);
}

TEST(ThinDepth, of_segments_and_open_surfaces_separates_and_nothing_shorter_does) {
  std::mt19937_64 random(4);
  const Mesh segment = thin({{-1, 0, 0}, {1.5, 1, 0.5}}, {{0, 1}}),
             line = thin({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}, {{0, 1}, {1, 2}}),
             sheet = thin({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 1}}, {{0, 1, 2}, {0, 2, 3}}),
             square = thin({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}});
  int overlapping = 0;
  const int rounds = oracles::rounds(24);
  for (int round = 0; round < rounds; ++round) {
    const Mesh p = round % 6 == 0   ? Mesh::create(ell()).value()
                   : round % 6 == 1 ? Mesh::create(tunnel()).value()
                                    : random_solids::valid_polyhedron(random);
    const Mesh& q = *std::array{&segment, &line, &sheet, &square}[static_cast<std::size_t>(round % 4)];
    DepthOptions options;
    options.engine = DepthEngine::boundary;
    SolidDepth pair = SolidDepth::create(p, q).value(), reference = SolidDepth::create(p, q, options).value();
    for (int k = 0; k < 4; ++k) {
      const auto along = [&] { return 0.5 * (static_cast<double>(random() % 17) - 8); };
      const Point3 at{along(), along(), along()};
      const SolidDistance d = pair.at(at);
      EXPECT_TRUE(d == reference.at(at)) << round << " " << k;
      overlapping += d.meeting == Meeting::overlapping;
      for (const SolidWay& way : d.ways) {
        Position moved = exact_position(way.move);
        moved[0] += exact::exact_value(at.x), moved[1] += exact::exact_value(at.y),
            moved[2] += exact::exact_value(at.z);
        std::map<std::pair<SolidFeature, SolidFeature>, int> found;
        for (const SolidTouch& c : way.contacts) found[{c.p, c.q}] = c.dimension;
        EXPECT_EQ(found, touching_by_definition(touching_shape(p, {}), touching_shape(q, moved))) << round << " " << k;
      }
      if (d.meeting != Meeting::overlapping) continue;
      std::vector<RationalPoint3> nearer;
      for (int i = 0; i < 20; ++i) {
        std::normal_distribution<double> normal;
        const Point3 v{normal(random), normal(random), normal(random)};
        const double s = 0.999 * d.distance / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        nearer.push_back({Rational::of(at.x + s * v.x).value(), Rational::of(at.y + s * v.y).value(),
                          Rational::of(at.z + s * v.z).value()});
      }
      for (const bool in : contains_each(p, negated(q), nearer, Semantics::open).value()) EXPECT_TRUE(in);
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(overlapping, oracles::rounds(10));
}

TEST(ThinDepth, a_sheet_lies_flush_on_a_box_and_two_thin_operands_are_refused) {
  const Mesh box = solids::box(0, 0, 0, 4, 4, 4),
             sheet = thin({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  SolidDepth pair = SolidDepth::create(box, sheet).value();
  const SolidDistance d = pair.at({1, 1, 3.5});
  EXPECT_EQ(d.distance, 0.5);
  ASSERT_EQ(d.ways.size(), 1U);
  EXPECT_EQ(d.ways[0].contacts.size(), 9U);
  EXPECT_EQ(d.ways[0].contacts[0].dimension, 2);
  EXPECT_EQ(pair.along({1, 1, 3.5}, {0, 0, 1}), Rational::of(0.5).value());
  EXPECT_EQ(pair.at({1, 1, 4}).meeting, Meeting::touching);
  const Result<SolidDepth> both = SolidDepth::create(sheet, sheet);
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum::test
