// Whether two sums are the same with everything that touches: a family's and one from scratch.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dymsum/spatial_sum.h"

namespace dymsum {

inline void expect_same_sum(const SpatialSum& found, const SpatialSum& expected, const std::string& where) {
  ASSERT_TRUE(found == expected) << where << ": another set, " << found.faces.size() << " faces of "
                                 << expected.faces.size();
  ASSERT_EQ(found.shells, expected.shells) << where;
  for (std::size_t f = 0; f < found.faces.size(); ++f) {
    ASSERT_EQ(found.faces[f].p, expected.faces[f].p) << where << ", face " << f;
    ASSERT_EQ(found.faces[f].q, expected.faces[f].q) << where << ", face " << f;
    ASSERT_EQ(found.faces[f].shell, expected.faces[f].shell) << where << ", face " << f;
  }
  ASSERT_EQ(found.vertex_contacts, expected.vertex_contacts) << where;
  const std::vector<SpatialEdge> a = found.edges(), b = expected.edges();
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t e = 0; e < a.size(); ++e) ASSERT_EQ(a[e].contact, b[e].contact) << where << ", edge " << e;
  ASSERT_EQ(found.tight_faces, expected.tight_faces) << where;
  ASSERT_EQ(found.tight_face_contacts, expected.tight_face_contacts) << where;
  ASSERT_EQ(found.tight_segments, expected.tight_segments) << where;
  ASSERT_EQ(found.tight_segment_contacts, expected.tight_segment_contacts) << where;
  ASSERT_EQ(found.tight_points, expected.tight_points) << where;
  ASSERT_EQ(found.tight_point_contacts, expected.tight_point_contacts) << where;
  for (std::size_t v = 0; v < found.vertices.size(); ++v) {
    const double apart = std::max({std::abs(found.vertices[v].x - expected.vertices[v].x),
                                   std::abs(found.vertices[v].y - expected.vertices[v].y),
                                   std::abs(found.vertices[v].z - expected.vertices[v].z)});
    ASSERT_LE(apart, found.at_error + expected.at_error) << where << ", vertex " << v;
  }
}

}  // namespace dymsum
