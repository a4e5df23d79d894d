// Single contacts: what is said to be one is no contact along an edge or a face, and there is a way to move apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "dymsum/solids.h"
#include "oracles/voxel_solids.h"
#include "spatial/boundary/tight_features.h"

namespace dymsum {
namespace {

using spatial::DirectionSource;
using spatial::FacetTable;
using spatial::LoneContacts;
using spatial::SolidOperand;
using spatial::SumEdge;
using spatial::SumFacet;
using spatial::SumPoint;

/// A tetrahedron with its first vertex in the origin.
MeshData pyramid(const Point3& a, const Point3& b, const Point3& c) {
  return {{{0, 0, 0}, a, b, c}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}}};
}
/// Nothing of it is parallel to an axis or to a plane of two.
MeshData askew() { return pyramid({5, 2, 1}, {2, 7, 3}, {1, 3, 5}); }

class Contacts {
 public:
  Contacts(const MeshData& p, const MeshData& q)
      : p_(spatial::solid_operand(p)),
        q_(spatial::solid_operand(q)),
        space_(spatial::make_sum_space(p_.vertices, q_.vertices)) {}

  /// Edge ab of P and vertex v of Q, or the other way round.
  bool edge(std::uint32_t a, std::uint32_t b, std::uint32_t v) {
    const auto id = space_->add_edges(std::array{SumEdge{{a, v}, {b, v}}});
    return LoneContacts(*space_, {}, p_, q_).edge(id);
  }
  bool edge_of_q(std::uint32_t a, std::uint32_t b, std::uint32_t v) {
    const auto id = space_->add_edges(std::array{SumEdge{{v, a}, {v, b}}});
    return LoneContacts(*space_, {}, p_, q_).edge(id);
  }
  bool corner(std::uint32_t v, std::uint32_t w) { return LoneContacts(*space_, {}, p_, q_).corner({v, w}); }
  bool facet(SumFacet::Kind kind, std::uint32_t i, std::uint32_t j) {
    FacetTable table;
    table.facets.push_back({});
    table.facets[0].facet.kind = kind, table.facets[0].facet.p = i, table.facets[0].facet.q = j;
    return LoneContacts(*space_, table, p_, q_).facet(0);
  }
  /// Edge ab of P, vertex 0 of Q, and the plane of two edges of Q.
  bool crosses(std::uint32_t a, std::uint32_t b, std::uint32_t u, std::uint32_t v) {
    const auto plane = space_->add_planes(std::array{
        spatial::PlaneSource{{0, 0}, {DirectionSource::Of::q, 0, u}, {DirectionSource::Of::q, 0, v}, false}});
    const auto id = space_->add_edges(std::array{SumEdge{{a, 0}, {b, 0}}});
    return LoneContacts(*space_, {}, p_, q_).crosses(id, plane);
  }
  static std::uint32_t triangle(const SolidOperand& s, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
      std::array<std::uint32_t, 3> want{a, b, c}, have = s.triangles[t];
      std::sort(want.begin(), want.end()), std::sort(have.begin(), have.end());
      if (want == have) return t;
    }
    return 0xffffffff;
  }
  static std::uint32_t wedge(const SolidOperand& s, std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t w = 0; w < s.wedges.size(); ++w)
      if (s.wedges[w].from == std::min(a, b) && s.wedges[w].to == std::max(a, b)) return w;
    return 0xffffffff;
  }
  const SolidOperand& p() const { return p_; }
  const SolidOperand& q() const { return q_; }

 private:
  SolidOperand p_, q_;
  std::unique_ptr<spatial::SumSpace> space_;
};

/// Faces x = 0, y = 0 and z = 0 meet in vertex 0; edges 0 1, 0 2, 0 3 run along the axes.
MeshData corner_of_axes() { return pyramid({0, 2, 0}, {2, 0, 0}, {0, 0, 2}); }

TEST(LoneContacts, of_an_edge_have_no_edge_in_its_faces_and_no_face_along_it) {
  EXPECT_TRUE(Contacts(corner_of_axes(), askew()).edge(0, 3, 0));
  EXPECT_TRUE(Contacts(askew(), corner_of_axes()).edge_of_q(0, 3, 0));
  // An edge in the plane x = 0, which goes through the edge along z, not along it.
  EXPECT_FALSE(Contacts(corner_of_axes(), pyramid({0, 2, 1}, {-2, 7, 3}, {-1, 3, 5})).edge(0, 3, 0));
  // A face through the axis z, none of whose edges lies in a face of the edge: it is spanned by (1, 1, 3), (1, 1, 5).
  EXPECT_FALSE(Contacts(corner_of_axes(), pyramid({1, 1, 5}, {1, 1, 3}, {2, 7, 1})).edge(0, 3, 0));
}

TEST(LoneContacts, of_an_edge_with_four_faces_are_none) {
  const MeshData cubes = oracles::voxel_mesh({{0, 0, 0}, {1, 1, 0}});
  std::uint32_t low = 0, high = 0;
  for (std::uint32_t v = 0; v < cubes.vertices.size(); ++v) {
    if (cubes.vertices[v] == Point3{1, 1, 0}) low = v;
    if (cubes.vertices[v] == Point3{1, 1, 1}) high = v;
  }
  EXPECT_FALSE(Contacts(cubes, askew()).edge(low, high, 0));
}

TEST(LoneContacts, of_two_corners_have_no_edge_in_a_face_of_the_other) {
  EXPECT_TRUE(Contacts(corner_of_axes(), askew()).corner(0, 0));
  EXPECT_TRUE(Contacts(askew(), corner_of_axes()).corner(0, 0));
  const MeshData beside = pyramid({0, 2, 1}, {-2, 7, 3}, {-1, 3, 5});  // its first edge lies in x = 0
  EXPECT_FALSE(Contacts(corner_of_axes(), beside).corner(0, 0));
  EXPECT_FALSE(Contacts(beside, corner_of_axes()).corner(0, 0));
}

TEST(LoneContacts, of_two_corners_leave_a_way_apart) {
  // Two cubes that touch in a corner have normals to all sides there; nothing of the sheared ones is parallel to them.
  const oracles::IntegerMap shear{{{7, 1, 2}, {-1, 6, 3}, {2, -3, 8}}};
  const oracles::Voxels two{{0, 0, 0}, {1, 1, 1}};
  const auto midpoint = [](const MeshData& mesh, const Point3& at) {
    return static_cast<std::uint32_t>(std::find(mesh.vertices.begin(), mesh.vertices.end(), at) -
                                      mesh.vertices.begin());
  };
  const MeshData p = oracles::voxel_mesh(two), q = oracles::voxel_mesh(two, shear),
                 one = oracles::voxel_mesh({{0, 0, 0}}, shear);
  const std::uint32_t of_p = midpoint(p, {1, 1, 1}), of_q = midpoint(q, {10, 8, 7});
  ASSERT_LT(of_p, p.vertices.size());
  ASSERT_LT(of_q, q.vertices.size());
  EXPECT_FALSE(Contacts(p, q).corner(of_p, of_q));
  // Tip on tip: the normals' sum is zero.
  MeshData tips = corner_of_axes();
  for (std::size_t v = 1; v < 4; ++v)
    tips.vertices.push_back({-tips.vertices[v].x, -tips.vertices[v].y, -tips.vertices[v].z});
  for (std::size_t f = 0; f < 4; ++f) {
    Face mirrored;
    for (const std::uint32_t v : tips.faces[f]) mirrored.insert(mirrored.begin(), v == 0 ? 0 : v + 3);
    tips.faces.push_back(mirrored);
  }
  EXPECT_FALSE(Contacts(tips, q).corner(0, of_q));
  EXPECT_TRUE(Contacts(p, one).corner(of_p, midpoint(one, {10, 8, 7}))) << "the other one has a way";
}

TEST(LoneContacts, inside_a_facet_have_nothing_parallel) {
  const MeshData along_x = pyramid({2, 0, 1}, {2, 7, 3}, {1, 3, 5});  // edge 0 1 lies in y = 0
  for (const bool swapped : {false, true}) {
    const auto facet = [&](const MeshData& solid) {
      Contacts c = swapped ? Contacts(solid, corner_of_axes()) : Contacts(corner_of_axes(), solid);
      const std::uint32_t face = Contacts::triangle(swapped ? c.q() : c.p(), 0, 2, 3);  // y = 0
      return swapped ? c.facet(SumFacet::Kind::vertex_face, 0, face) : c.facet(SumFacet::Kind::face_vertex, face, 0);
    };
    EXPECT_TRUE(facet(askew()));
    EXPECT_FALSE(facet(along_x));
  }
  // Edges of both: the one along z, beside the faces x = 0 and y = 0.
  const auto edges = [](const MeshData& q, bool swapped) {
    Contacts c = swapped ? Contacts(q, corner_of_axes()) : Contacts(corner_of_axes(), q);
    const std::uint32_t e = Contacts::wedge(swapped ? c.q() : c.p(), 0, 3),
                        g = Contacts::wedge(swapped ? c.p() : c.q(), 0, 1);
    return swapped ? c.facet(SumFacet::Kind::edge_edge, g, e) : c.facet(SumFacet::Kind::edge_edge, e, g);
  };
  for (const bool swapped : {false, true}) {
    EXPECT_TRUE(edges(askew(), swapped));
    EXPECT_FALSE(edges(along_x, swapped)) << "the edge lies in y = 0";
    EXPECT_FALSE(edges(pyramid({0, 2, 1}, {2, 7, 3}, {1, 3, 5}), swapped)) << "the edge lies in x = 0";
    EXPECT_FALSE(edges(pyramid({1, 1, 3}, {1, 1, 5}, {2, 7, 1}), swapped)) << "a face beside it goes through z";
    EXPECT_FALSE(edges(pyramid({1, 1, 3}, {2, 7, 1}, {1, 1, 5}), swapped)) << "the one on the other side";
  }
}

TEST(LoneContacts, edges_cross_planes_that_are_not_parallel_to_them) {
  EXPECT_TRUE(Contacts(corner_of_axes(), askew()).crosses(0, 3, 1, 2));
  EXPECT_FALSE(Contacts(corner_of_axes(), corner_of_axes()).crosses(0, 3, 1, 3));
}

}  // namespace
}  // namespace dymsum
