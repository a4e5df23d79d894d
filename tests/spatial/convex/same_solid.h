// A solid that followed against one from nothing, and against what it says that it changed.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dymsum/convex_solid.h"
#include "spatial/convex/convex_cases.h"

namespace dymsum::test {

/// Face by face: the same vertices at the same positions, the same facets, nothing else.
inline void expect_same_solid(const ConvexSolid& kept, const SpatialSum& fresh, const std::string& where) {
  std::map<ConvexSum::Vertex, std::uint32_t> live;
  for (std::uint32_t v = 0; v < kept.vertices.size(); ++v) {
    if (kept.vertices[v].p == ConvexSolid::kFree) continue;
    ASSERT_TRUE(live.emplace(kept.vertices[v], v).second) << where;
  }
  ASSERT_EQ(live.size(), kept.vertex_count) << where;
  ASSERT_EQ(live.size(), fresh.vertices.size()) << where;
  const std::vector<ConvexSum::Vertex> pairs = vertex_pairs(fresh);
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    const auto v = live.find(pairs[k]);
    ASSERT_NE(v, live.end()) << where;
    ASSERT_EQ(kept.at[v->second], fresh.vertices[k]) << where;
  }
  std::vector<NamedFace> faces;
  for (std::size_t f = 0; f < kept.facets.size(); ++f) {
    if (kept.facets[f].count == 0) continue;
    NamedFace& face = faces.emplace_back(NamedFace{{kept.facets[f].p, kept.facets[f].q}, {}});
    for (const std::uint32_t v : kept.corners_of(f)) face.corners.push_back(kept.vertices[v]);
    std::rotate(face.corners.begin(), std::min_element(face.corners.begin(), face.corners.end()), face.corners.end());
  }
  std::sort(faces.begin(), faces.end());
  ASSERT_EQ(kept.facet_count, fresh.faces.size()) << where;
  ASSERT_EQ(faces, structure(fresh)) << where;
}

/// The vertices of a facet by pairs; none where its index is free.
inline std::vector<ConvexSum::Vertex> pairs_of(const ConvexSolid& solid, std::size_t facet) {
  std::vector<ConvexSum::Vertex> pairs;
  if (facet < solid.facets.size())
    for (const std::uint32_t v : solid.corners_of(facet)) pairs.push_back(solid.vertices[v]);
  return pairs;
}

/// Facets and vertices that are not listed are as before, those that are listed changed as it says.
inline void expect_true_changes(const ConvexSolid& before, const ConvexSolid& now, const std::string& where) {
  using Kind = FacetChange::Kind;
  std::map<std::uint32_t, std::vector<FacetChange>> listed;
  for (const FacetChange& c : now.changes.facets) listed[c.facet].push_back(c);
  ASSERT_TRUE(std::is_sorted(now.changes.facets.begin(), now.changes.facets.end(),
                             [](const FacetChange& a, const FacetChange& b) { return a.facet < b.facet; }));
  for (std::uint32_t f = 0; f < now.facets.size(); ++f) {
    std::vector<ConvexSum::Vertex> was = pairs_of(before, f), is = pairs_of(now, f);
    const auto it = listed.find(f);
    ASSERT_EQ(it == listed.end(), was == is && (is.empty() || (before.facets[f].p == now.facets[f].p &&
                                                               before.facets[f].q == now.facets[f].q)))
        << where << " facet " << f;
    if (it == listed.end()) continue;
    std::sort(was.begin(), was.end());
    std::sort(is.begin(), is.end());
    std::vector<ConvexSum::Vertex> both;
    std::set_intersection(was.begin(), was.end(), is.begin(), is.end(), std::back_inserter(both));
    const auto count = [](const std::vector<ConvexSum::Vertex>& v) { return static_cast<std::uint32_t>(v.size()); };
    std::vector<FacetChange> expected;
    if (it->second.size() == 1 && it->second[0].kind == Kind::turned) {
      ASSERT_EQ(was, is) << where;
      expected = {{Kind::turned, f, 0, 0}};
    } else if (it->second.size() == 1 && it->second[0].kind == Kind::reshaped) {
      ASSERT_TRUE(!was.empty() && !is.empty() && was != is) << where;
      expected = {{Kind::reshaped, f, count(is) - count(both), count(was) - count(both)}};
    } else {
      if (!was.empty()) expected.push_back({Kind::disappeared, f, 0, count(was)});
      if (!is.empty()) expected.push_back({Kind::appeared, f, count(is), 0});
    }
    ASSERT_EQ(it->second, expected) << where << " facet " << f;
  }
  std::vector<std::uint32_t> appeared, disappeared;
  const ConvexSum::Vertex free{ConvexSolid::kFree, ConvexSolid::kFree};
  for (std::uint32_t v = 0; v < now.vertices.size(); ++v) {
    const ConvexSum::Vertex was = v < before.vertices.size() ? before.vertices[v] : free;
    if (was == now.vertices[v]) {
      ASSERT_TRUE(now.changes.moved || before.at[v] == now.at[v]) << where;
      continue;
    }
    ASSERT_TRUE(was == free || now.vertices[v] == free) << where << ": not in use for something else at once";
    (was == free ? appeared : disappeared).push_back(v);
  }
  ASSERT_EQ(now.changes.vertices_appeared, appeared) << where;
  ASSERT_EQ(now.changes.vertices_disappeared, disappeared) << where;
}

/// Which of n indices lie in ranges that are in order and apart.
inline std::vector<bool> covered_by(const std::vector<IndexRange>& ranges, std::size_t n) {
  std::vector<bool> covered(n, false);
  std::size_t end = 0;
  for (const IndexRange& r : ranges) {
    EXPECT_GE(r.first, end);
    end = r.first + r.count;
    EXPECT_LE(end, n);
    std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(r.first), r.count, true);
  }
  return covered;
}

/// Buffers brought up to date equal those written anew, and are what they were outside the ranges that they name.
inline void expect_true_buffers(const ConvexSolid& solid, const SolidBuffers& before, const SolidBuffers& now,
                                const std::string& where) {
  SolidBuffers fresh;
  solid.write(fresh);
  ASSERT_EQ(now.positions, fresh.positions) << where;
  ASSERT_EQ(now.triangles, fresh.triangles) << where;
  const auto expect_covered = [&](const auto& was, const auto& is, const std::vector<IndexRange>& ranges) {
    const std::vector<bool> covered = covered_by(ranges, is.size() / 3);
    for (std::size_t i = 0; i < is.size(); ++i) {
      const bool same = i < was.size() && was[i] == is[i];
      ASSERT_TRUE(same || covered[i / 3]) << where << " " << i;
    }
  };
  expect_covered(before.positions, now.positions, now.positions_changed);
  expect_covered(before.triangles, now.triangles, now.triangles_changed);
}

}  // namespace dymsum::test
