// Rooms to move in: robots, obstacles, and where to start and to go.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "cspace/planner/test_rooms.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/region.h"

namespace dymsum::sampling {

struct Room {
  std::string name;
  Region robot, obstacle;
  std::vector<Configuration> positions;  ///< free ones, of which every pair is a question
  double size = 0;                       ///< the motions stay within [-size, size]
};

using test_rooms::box, test_rooms::bug_trap, test_rooms::region, test_rooms::two_rooms;

/// A cave with deep corners.
inline Region cave(std::mt19937_64& random) {
  for (;;) {
    Part part{box(-8, -8, 8, 8), {Ring{}}};
    for (int k = 0; k < 14; ++k) {
      const double r = 1 + static_cast<double>(random() % 6), angle = -2 * std::numbers::pi * k / 14;
      part.holes[0].push_back({std::round(2 * r * std::cos(angle)) / 2, std::round(2 * r * std::sin(angle)) / 2});
    }
    if (Result<Region> found = Region::create({{part}, {}, {}})) return std::move(found).value();
  }
}

/// Boxes at random positions in a frame.
inline Region boxes(std::mt19937_64& random) {
  for (;;) {
    std::vector<Region> all{region({{box(-9, -9, 9, 9), {{{-8, -8}, {-8, 8}, {8, 8}, {8, -8}}}}})};
    const auto at = [&](int n) { return static_cast<double>(random() % static_cast<unsigned>(n)); };
    for (int k = 0; k < 12; ++k) {
      const double x = at(16) - 8, y = at(16) - 8;
      all.push_back(region({{box(x, y, x + 0.5 + at(4), y + 0.5 + at(4)), {}}}));
    }
    Result<Region> found = union_of(all)->rounded();
    if (found.ok() && found->touching_points().empty()) return std::move(found).value();
  }
}

inline Region small_robot(std::mt19937_64& random) {
  const auto at = [&] { return 0.25 * (static_cast<double>(random() % 13) - 6); };
  for (;;) {
    RegionData data;
    data.parts.emplace_back();
    for (int k = 0; k < 3 + static_cast<int>(random() % 4); ++k) data.parts[0].outer.push_back({at(), at()});
    const Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.empty() && repaired->region.touching_points().empty())
      return repaired->region;
  }
}

inline std::vector<Room> known_rooms() {
  const double right = std::numbers::pi / 2;
  const Region bar = region({{box(-3, -0.5, 3, 0.5), {}}}), square = region({{box(0, 0, 1, 1), {}}});
  const Region hook = region({{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}}});
  const Region wedge = region({{{{-0.4, -0.3}, {0.5, -0.2}, {0.1, 0.4}}, {}}});
  const std::vector<Configuration> both{{-6, 0, right}, {6, 0, right}, {6, 0, -right}, {-6, 3, 0}};
  return {{"bar and doorway", bar, two_rooms(-1, 1), both, 12},
          {"bar and a doorway too narrow", bar, two_rooms(-0.45, 0.45), both, 12},
          {"hook and jamb", hook, two_rooms(-1.25, 1.25), {{-7, -2, 0}, {7, 2, 2 * right}, {7, -2, right}}, 12},
          {"hook and a doorway too narrow", hook, two_rooms(-0.75, 0.5), {{-7, -2, 0}, {7, 2, 2 * right}}, 12},
          {"bar in a corridor",
           bar,
           region({{box(-20, -3, 20, 3), {{{-19, -2}, {-19, 2}, {19, 2}, {19, -2}}}}}),
           {{-10, 0, 0}, {10, 1, 0.1}, {10, 0, 2 * right}, {0, 0, -2.9}},
           20},
          {"bug trap", wedge, bug_trap(0.5), {{2, 2, 1}, {-9, 3, -2}, {2, -2, -1}}, 11},
          {"bug trap with its mouth shut", wedge, bug_trap(0.25), {{2, 2, 1}, {-9, 3, -2}, {2, -2, -1}}, 11},
          {"square and slot", square, two_rooms(-0.25, 0.875), {{-5, 1.5, 0.3}, {5, -2.25, 2}}, 12},
          {"square and a slot a hair too narrow",
           square,
           two_rooms(0, 1 - 0x1p-20),
           {{-5, 1.5, 0.3}, {5, -2.25, 2}, {-9, -2.25, 2}},
           12}};
}

}  // namespace dymsum::sampling
