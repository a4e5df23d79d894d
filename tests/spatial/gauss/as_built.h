// What an overlay that followed a motion has to equal and to report.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "spatial/gauss/overlay.h"

namespace dymsum::test {

struct PolytopePair {
  spatial::Polytope p, q;
};

/// The map of a pose of P, Q staying where it is.
inline spatial::RelativeMap map_of(const SolidPose& p) {
  return spatial::RelativeMap(spatial::PoseFactors::of(p), spatial::PoseFactors::of({}));
}

/// Every crossing by its number: the edges that meet.
inline std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> by_number(const spatial::Overlay& o) {
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> all;
  for (std::uint32_t e = 0; e < o.poly(0).edge_count(); ++e)
    for (std::uint32_t id = o.first_crossing(0, e); id != spatial::kNoCrossing; id = o.crossing(id).next[0])
      all[id] = {e, o.crossing(id).q / 2};
  return all;
}

/// A fresh overlay has the same vertices, the same crossings in the same order along the arcs of both operands, and
/// what the update says that it changed is what has changed: crossings that stay keep their numbers, new ones are
/// reported.
inline void expect_as_built(const spatial::Overlay& before, const spatial::Overlay& moved,
                            const spatial::RelativeMap& map, const std::string& where) {
  spatial::Overlay fresh(moved.poly(0), moved.poly(1));
  fresh.build(map);
  ASSERT_TRUE(moved == fresh) << where;
  ASSERT_LE(moved.work().crossing_checks, before.crossing_count()) << where;
  ASSERT_EQ(moved.crossing_count(), fresh.crossing_count()) << where;
  const auto old = by_number(before), now = by_number(moved);
  ASSERT_EQ(now.size(), moved.crossing_count()) << where;
  const std::set<std::uint32_t> reported(moved.changes().crossings.begin(), moved.changes().crossings.end());
  for (const auto& [id, edges] : now) {
    const auto it = old.find(id);
    ASSERT_EQ(!reported.contains(id), it != old.end() && it->second == edges) << where;
  }
  for (int op = 0; op < 2; ++op) {
    const std::set<std::uint32_t> faces(moved.changes().faces[op].begin(), moved.changes().faces[op].end());
    ASSERT_EQ(faces.size(), moved.changes().faces[op].size()) << where;
    for (std::uint32_t f = 0; f < moved.poly(op).face_count(); ++f)
      ASSERT_EQ(faces.contains(f), before.extreme(op, f) != moved.extreme(op, f)) << where;
  }
}

}  // namespace dymsum::test
