// Loops of an obstacle's slabs against static slices, and the random shapes that tests of obstacles share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/region_io.h"
#include "oracles/sanitized.h"
#include "oracles/vertices_by.h"

namespace dymsum::testing_obstacles {

using Random = std::mt19937_64;
using Cycle = std::vector<Contact>;

inline bool less(const Contact& a, const Contact& b) {
  return std::tuple{a.kind, a.p, a.q} < std::tuple{b.kind, b.p, b.q};
}

inline std::vector<Cycle> canonical(std::vector<Cycle> cycles) {
  for (Cycle& cycle : cycles) {
    // A segment may be on a cycle twice: the smallest of all rotations.
    Cycle best = cycle, turned = cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      if (std::lexicographical_compare(turned.begin(), turned.end(), best.begin(), best.end(), less)) best = turned;
    }
    cycle = best;
  }
  std::sort(cycles.begin(), cycles.end(), [](const Cycle& a, const Cycle& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return cycles;
}

inline std::vector<Cycle> of_slice(const PlanarSum& sum) {
  std::vector<Cycle> cycles;
  const auto add = [&](const SumRing& ring) {
    Cycle& cycle = cycles.emplace_back();
    for (const SumVertex& v : ring.vertices) cycle.push_back(v.out);
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return canonical(std::move(cycles));
}

/// A region's data with every position replaced.
template <class Map>
RegionData mapped(const Region& region, const Map& map) {
  return oracles::vertices_by(region.data(), map);
}

// The vector of an edge of a region, by its number.
inline Point edge_vector(const Region& region, std::uint32_t number) {
  std::uint32_t first = 0;
  for (const Part& part : region.parts())
    for (std::size_t k = 0; k <= part.holes.size(); ++k) {
      const Ring& ring = k == 0 ? part.outer : part.holes[k - 1];
      const auto n = static_cast<std::uint32_t>(ring.size());
      if (number < first + n) {
        const Point a = ring[number - first], b = ring[(number - first + 1) % n];
        return {b.x - a.x, b.y - a.y};
      }
      first += n;
    }
  return {};
}

// One edge in line with another one and the same vertex: where the boundary passes a touching point straight on, slices
// name the first only.
inline bool in_line(const CspaceObstacle& c, const Contact& a, const Contact& b) {
  if (a == b || a.kind != b.kind) return false;
  const bool of_p = a.kind == Contact::Kind::edge_of_p;
  if (of_p ? a.q != b.q : a.p != b.p) return false;
  const Region& region = of_p ? c.obstacle() : c.robot();
  const Point d = edge_vector(region, of_p ? a.p : a.q), e = edge_vector(region, of_p ? b.p : b.q);
  return d.x * e.y == d.y * e.x;
}

inline std::vector<Cycle> of_slab(const CspaceObstacle& c, std::uint32_t slab) {
  std::vector<Cycle> cycles;
  for (const auto& loop : c.loops(slab)) {
    Cycle& cycle = cycles.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Patch &p = c.patches()[loop[k]], &before = c.patches()[loop[k == 0 ? loop.size() - 1 : k - 1]];
      if (!(p.left_corner && in_line(c, before.contact, p.contact))) cycle.push_back(p.contact);
    }
  }
  return canonical(std::move(cycles));
}

inline std::uint32_t slabs(const CspaceObstacle& c) {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(c.angles().size()));
}

inline void expect_slices(const CspaceObstacle& c, Random& random, std::uint32_t most) {
  const std::uint32_t n = slabs(c);
  const std::uint32_t step = std::max(1u, n / most);
  for (std::uint32_t slab = static_cast<std::uint32_t>(random() % step); slab < n; slab += step) {
    const Orientation at = c.inside(slab);
    const std::vector<Cycle> expected = of_slice(*c.slice(at));
    ASSERT_EQ(of_slab(c, slab), expected) << "slab " << slab << " of " << n << " at " << at.radians() << "\nrobot "
                                          << format_region(c.robot(), RegionFormat::wkt) << "\nobstacle "
                                          << format_region(c.obstacle(), RegionFormat::wkt);
    // Constant between events: the same cycles at another orientation of the slab.
    const double low = c.angles()[slab].theta,
                 high = slab + 1 < n ? c.angles()[slab + 1].theta : c.angles()[0].theta + 2 * std::numbers::pi;
    const double fraction = 0.02 + 0.96 * static_cast<double>(random() % 4096) / 4096;
    const Orientation other = *Orientation::nearest(low + fraction * (high - low));
    if (c.slab_of(other) == slab) {
      ASSERT_EQ(of_slice(*c.slice(other)), expected) << "slab " << slab << " at " << other.radians();
    }
  }
}

inline Ring random_ring(Random& random, int reach, int most, double dx) {
  const auto at = [&] {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
  };
  Ring ring;
  const int n = 3 + static_cast<int>(random() % static_cast<unsigned>(most - 2));
  for (int i = 0; i < n; ++i) ring.push_back({at() + dx, at()});
  return ring;
}

inline Region random_shape(Random& random, int reach, int most, bool hole, int parts = 1) {
  for (;;) {
    RegionData data;
    for (int k = 0; k < parts; ++k) {
      data.parts.emplace_back();
      data.parts.back().outer = random_ring(random, reach, most, 2.5 * reach * k);
      if (hole) data.parts.back().holes.push_back(random_ring(random, reach, 3, 2.5 * reach * k));
    }
    Result<Repaired> repaired = repair(data);
    if (repaired.ok() && repaired->region.touching_points().empty() &&
        static_cast<int>(repaired->region.parts().size()) == parts)
      return repaired->region;
  }
}

inline Region polygon(Ring outer, std::vector<Ring> holes = {}) {
  RegionData data;
  data.parts.push_back({std::move(outer), std::move(holes)});
  return *Region::create(std::move(data));
}

/// Rotated in doubles, so that what would coincide on a grid is 10^-16 apart.
inline Region turned(const Region& region, double degrees) {
  const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta);
  return *Region::create(mapped(region, [&](Point p) { return Point{c * p.x - s * p.y, s * p.x + c * p.y}; }));
}

/// A bar with teeth as wide as their gaps.
inline Region toothed(int teeth) {
  Ring ring{{0, 0}, {2.0 * teeth - 1, 0}};
  for (int k = teeth - 1; k >= 0; --k) {
    ring.push_back({2.0 * k + 1, 3});
    ring.push_back({2.0 * k, 3});
    if (k == 0) break;
    ring.push_back({2.0 * k, 1});
    ring.push_back({2.0 * k - 1, 1});
  }
  return polygon(ring);
}

inline Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
inline Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

inline std::size_t free_components(const CspaceObstacle& c) {
  std::set<std::uint32_t> all;
  for (const FreeCell& cell : c.free_cells()) all.insert(cell.component);
  return all.size();
}

inline std::size_t tight_at(const CspaceObstacle& c, double theta) {
  std::size_t n = 0;
  for (const ObstacleEvent& e : c.events())
    n += e.kind == ObstacleEvent::Kind::tight && std::abs(c.angles()[e.angle].theta - theta) < 1e-12;
  return n;
}

inline const std::uint64_t kFractionOfSeeds = oracles::kSanitized ? 3 : 1;

// DYMSUM_FUZZ_OBSTACLES times the usual number of seeds; DYMSUM_SEED replays one.
template <class F>
inline void for_seeds(std::uint64_t usual, F&& f) {
  usual = std::max<std::uint64_t>(1, usual / kFractionOfSeeds);
  const char* first = std::getenv("DYMSUM_SEED");
  const char* count = std::getenv("DYMSUM_FUZZ_OBSTACLES");
  const std::uint64_t begin = first ? std::stoull(first) : 1, n = first ? 1 : usual * (count ? std::stoull(count) : 1);
  for (std::uint64_t seed = begin; seed < begin + n && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "DYMSUM_SEED=" << seed);
    Random random(seed);
    f(random);
  }
}

// Unit squares of a small board that hang together, as one polygon: edges in four directions only.
inline Region random_cells(Random& random, int size, double cell) {
  for (;;) {
    RegionData data;
    std::vector<Region> cells;
    for (int x = 0; x < size; ++x)
      for (int y = 0; y < size; ++y)
        if (random() % 3 != 0) cells.push_back(polygon(box(x * cell, y * cell, (x + 1) * cell, (y + 1) * cell)));
    if (cells.empty()) continue;
    const Result<Region> all = union_of(cells).value().rounded();
    if (all.ok() && all->touching_points().empty() && all->parts().size() == 1) return *all;
  }
}

// Squares of such a board that touch at corners somewhere, perhaps in several parts.
inline Region random_board(Random& random, int size, double cell) {
  for (;;) {
    std::vector<Region> cells;
    for (int x = 0; x < size; ++x)
      for (int y = 0; y < size; ++y)
        if (random() % 2 == 0) cells.push_back(polygon(box(x * cell, y * cell, (x + 1) * cell, (y + 1) * cell)));
    if (cells.empty()) continue;
    const Result<Region> all = union_of(cells).value().rounded();
    if (all.ok() && !all->touching_points().empty()) return *all;
  }
}

}  // namespace dymsum::testing_obstacles
