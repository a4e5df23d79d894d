// Which contacts the engines name: the same ones, except where several that run along one line carry the vertex.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/tiny_regions.h"

namespace dymsum {
namespace {

using Q = exact::BigRational;

struct Position {
  Q x, y;
};
Q turn(const Position& a, const Position& b, const Position& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The segment a contact names, for operands of one ring each.
std::pair<Position, Position> segment(const Ring& p, const Ring& q, const Contact& c) {
  const bool of_p = c.kind == Contact::Kind::edge_of_p;
  const Ring& owner = of_p ? p : q;
  const std::size_t edge = of_p ? c.p : c.q;
  const Point from = owner[edge], to = owner[(edge + 1) % owner.size()], corner = of_p ? q[c.q] : p[c.p];
  return {{Q(from.x) + Q(corner.x), Q(from.y) + Q(corner.y)}, {Q(to.x) + Q(corner.x), Q(to.y) + Q(corner.y)}};
}

/// How many contacts along the line of one carry a position.
int carriers(const Ring& p, const Ring& q, const Contact& named, const Position& at) {
  const auto [a, b] = segment(p, q, named);
  int count = 0;
  for (const auto kind : {Contact::Kind::edge_of_p, Contact::Kind::edge_of_q})
    for (std::uint32_t i = 0; i < p.size(); ++i)
      for (std::uint32_t j = 0; j < q.size(); ++j) {
        const auto [c, d] = segment(p, q, {kind, i, j});
        if (turn(a, b, c) != 0 || turn(a, b, d) != 0) continue;
        count += (c.x - at.x) * (d.x - at.x) + (c.y - at.y) * (d.y - at.y) <= 0;
      }
  return count;
}

/// Compares the contacts of the outer rings' vertices; returns how many differ, each where several contacts carry the
/// vertex.
int differing(const Region& p, const Region& q, const PlanarSum& a, const PlanarSum& b) {
  int count = 0;
  EXPECT_EQ(a, b);
  for (std::size_t part = 0; part < a.parts.size(); ++part)
    for (std::size_t k = 0; k < a.parts[part].outer.vertices.size(); ++k) {
      const SumVertex &u = a.parts[part].outer.vertices[k], &v = b.parts[part].outer.vertices[k];
      const RationalPoint exact = a.exact(u);
      const Position at{exact::exact_value(exact.x), exact::exact_value(exact.y)};
      for (const auto contact : {&SumVertex::in, &SumVertex::out}) {
        if (u.*contact == v.*contact) continue;
        ++count;
        EXPECT_GT(carriers(p.parts()[0].outer, q.parts()[0].outer, u.*contact, at), 1);
      }
    }
  return count;
}

PlanarSum sum_by(const Region& p, const Region& q, Engine engine) {
  SumOptions options;
  options.engine = engine;
  return minkowski_sum(p, q, options).value();
}

TEST(EngineContacts, AreTheSameInGeneralPosition) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Region p = shapes::noisy_star(30, 0.7, seed), q = shapes::noisy_star(11, 0.7, seed + 100);
    const PlanarSum fast = sum_by(p, q, Engine::fast);
    for (const Engine engine : {Engine::brute, Engine::winding})
      EXPECT_EQ(differing(p, q, fast, sum_by(p, q, engine)), 0) << "seed " << seed;
  }
}

TEST(EngineContacts, DifferOnGridsOnlyWhereSeveralCarryTheVertex) {
  const std::vector<RegionData> triangles = oracles::all_small_polygons(3);
  int differ = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    for (std::size_t j = i % 5; j < triangles.size(); j += 5) {
      const Region p = Region::create(triangles[i]).value(), q = Region::create(triangles[j]).value();
      const PlanarSum fast = sum_by(p, q, Engine::fast);
      for (const Engine engine : {Engine::brute, Engine::winding})
        differ += differing(p, q, fast, sum_by(p, q, engine));
    }
  RecordProperty("differing", differ);
}

}  // namespace
}  // namespace dymsum
