// Faces with holes, and rings that touch, split by a sweep: against areas and edges counted by hand.
#include "spatial/mesh/triangulate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "dymsum/shapes.h"

namespace dymsum::spatial_test {
namespace {

using Rings = std::vector<std::vector<std::uint32_t>>;

/// Positions with small integer coordinates.
struct Lattice final : spatial::PlaneOrder {
  std::vector<std::array<long, 2>> at;

  bool before(std::uint32_t a, std::uint32_t b) override { return at[a] < at[b]; }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    const long value = twice_area(a, b, c);
    ++turns;
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  long twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return (at[b][0] - at[a][0]) * (at[c][1] - at[a][1]) - (at[b][1] - at[a][1]) * (at[c][0] - at[a][0]);
  }
  std::size_t turns = 0;
};

/// Triangles with area that have the rings' area and edges, each other edge once either way.
void expect_split(const Rings& rings, Lattice& plane) {
  const auto triangles = spatial::sweep_triangles(rings, plane);
  ASSERT_TRUE(triangles);
  long area = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k], b = ring[(k + 1) % ring.size()];
      area += plane.at[a][0] * plane.at[b][1] - plane.at[a][1] * plane.at[b][0];
      --edges[{a, b}];
    }
  for (const auto& t : *triangles) {
    EXPECT_GT(plane.twice_area(t[0], t[1], t[2]), 0);
    area -= plane.twice_area(t[0], t[1], t[2]);
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  EXPECT_EQ(area, 0);
  for (const auto& [edge, count] : edges) {
    EXPECT_TRUE(count == 0 || count == 1) << edge.first << " " << edge.second;
    if (count == 1) {
      EXPECT_EQ((edges[{edge.second, edge.first}]), 1);
    }
  }
}

/// The rings around cells of a lattice, sheared, joined in any way at positions where four sides meet.
Rings around_cells(const std::vector<std::vector<bool>>& cells, int shear, Lattice& plane) {
  const int n = static_cast<int>(cells.size());
  const auto in = [&](int x, int y) { return x >= 0 && y >= 0 && x < n && y < n && cells[x][y]; };
  const auto position = [&](int x, int y) { return static_cast<std::uint32_t>(x * (n + 1) + y); };
  plane.at.clear();
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y) plane.at.push_back({x + shear * y, 2 * y - shear * x});
  std::multimap<std::uint32_t, std::uint32_t> sides;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y) {
      if (!in(x, y)) continue;
      if (!in(x, y - 1)) sides.emplace(position(x, y), position(x + 1, y));
      if (!in(x + 1, y)) sides.emplace(position(x + 1, y), position(x + 1, y + 1));
      if (!in(x, y + 1)) sides.emplace(position(x + 1, y + 1), position(x, y + 1));
      if (!in(x - 1, y)) sides.emplace(position(x, y + 1), position(x, y));
    }
  Rings rings;
  while (!sides.empty()) {
    const std::uint32_t start = sides.begin()->first;
    std::uint32_t at = start;
    rings.emplace_back();
    do {
      const auto side = sides.find(at);
      rings.back().push_back(at);
      at = side->second;
      sides.erase(side);
    } while (at != start);
  }
  return rings;
}

TEST(SweepTriangles, cells_of_lattices_with_holes_that_touch) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 400; ++round) {
    const std::size_t n = 2 + random() % 6;
    std::vector<std::vector<bool>> cells(n, std::vector<bool>(n));
    for (auto& row : cells)
      for (std::size_t y = 0; y < n; ++y) row[y] = random() % 3 > 0;
    Lattice plane;
    const Rings rings = around_cells(cells, static_cast<int>(random() % 3) - 1, plane);
    SCOPED_TRACE(round);
    expect_split(rings, plane);
  }
}

TEST(SweepTriangles, shapes_with_bridges_and_thousands_of_corners_take_no_square_of_steps) {
  for (const int n : {10, 100, 2000}) {
    // A comb with long teeth, a star, and both ways of a bridge to a hole.
    Lattice comb, star, ring;
    Rings combs(1), stars(1);
    for (int k = 0; k < n; ++k)
      for (const auto& [x, y] :
           {std::array<long, 2>{2 * k, 0}, {2 * k + 1, 0}, {2 * k + 1, 900 + k % 7}, {2 * k + 2, 900}})
        comb.at.push_back({x, y});
    comb.at.push_back({2 * n, 1000}), comb.at.push_back({0, 1000});
    for (std::uint32_t k = 0; k < comb.at.size(); ++k) combs[0].push_back(k);
    expect_split(combs, comb);
    for (int k = 0; k < 2 * n; ++k) {
      const double a = std::numbers::pi * k / n, r = k % 2 == 0 ? 1e6 : 3e5;
      star.at.push_back({std::lround(r * std::cos(a)), std::lround(r * std::sin(a))});
      stars[0].push_back(static_cast<std::uint32_t>(k));
    }
    expect_split(stars, star);
    EXPECT_LT(comb.turns, 400.0 * n * std::log2(n));
    EXPECT_LT(star.turns, 400.0 * n * std::log2(n));
    ring.at = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {3, 6}, {6, 6}, {6, 3}};
    expect_split({{0, 4, 5, 6, 7, 4, 0, 1, 2, 3}}, ring);
    // Slits: by itself, from a corner, from a hole, and with a branch.
    expect_split({{0, 1, 2, 3}, {4, 6}}, ring);
    expect_split({{0, 4, 0, 1, 2, 3}}, ring);
    expect_split({{0, 1, 2, 3}, {4, 5, 7}, {7, 6}}, ring);
    expect_split({{0, 1, 2, 3}, {4, 5, 4, 6, 4, 7}}, ring);
  }
}

TEST(SweepTriangles, rings_that_cross_are_none) {
  Lattice plane;
  plane.at = {{0, 0}, {4, 4}, {4, 0}, {0, 4}, {2, 0}};
  EXPECT_FALSE(spatial::sweep_triangles(Rings{{0, 1, 2, 3}}, plane));
  EXPECT_FALSE(spatial::sweep_triangles(Rings{{0, 4, 2}}, plane)) << "no area";
  EXPECT_FALSE(spatial::sweep_triangles(Rings{{0, 2}}, plane));
  EXPECT_EQ(spatial::sweep_triangles(Rings{}, plane)->size(), 0u);
}

}  // namespace
}  // namespace dymsum::spatial_test
