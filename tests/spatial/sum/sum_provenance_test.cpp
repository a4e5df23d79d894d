// What touches at faces, edges, vertices and tight features of a sum, by the exact positions of the named features.
#include <gtest/gtest.h>

#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using Kind = SolidFeature::Kind;
using Vector = std::array<Rational, 3>;

Vector vec(const Point3& p) { return {*Rational::of(p.x), *Rational::of(p.y), *Rational::of(p.z)}; }
Vector vec(const RationalPoint3& p) { return {p.x, p.y, p.z}; }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Vector& v) { return v == Vector{}; }

class Witness {
 public:
  Witness(const MeshData& p, const MeshData& q) : mesh_{&p, &q} {}

  /// A point of the pair's sum, and the directions that it spans.
  Vector origin(const SolidContact& c) const {
    const Vector a = vec(first(0, c.p)), b = vec(first(1, c.q));
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  }
  std::vector<Vector> spans(const SolidContact& c) const {
    std::vector<Vector> directions;
    for (int o = 0; o < 2; ++o) {
      const SolidFeature& f = o == 0 ? c.p : c.q;
      if (f.kind == Kind::edge) directions.push_back(minus(vec(mesh_[o]->vertices[f.b]), vec(mesh_[o]->vertices[f.a])));
      if (f.kind != Kind::face) continue;
      const Face& face = mesh_[o]->faces[f.a];
      for (std::size_t k = 1; k < face.size(); ++k)
        directions.push_back(minus(vec(mesh_[o]->vertices[face[k]]), vec(mesh_[o]->vertices[face[0]])));
    }
    return directions;
  }
  /// Whether x lies in the affine hull of the pair's sum.
  bool carries(const SolidContact& c, const Vector& x) const {
    const Vector gap = minus(x, origin(c));
    if (is_zero(gap)) return true;
    const std::vector<Vector> d = spans(c);
    for (std::size_t i = 0; i < d.size(); ++i) {
      if (is_zero(cross(d[i], gap))) return true;
      for (std::size_t j = i + 1; j < d.size(); ++j)
        if (const Vector n = cross(d[i], d[j]); !is_zero(n) && dot(n, gap) == Rational()) return true;
    }
    return false;
  }

 private:
  Point3 first(int o, const SolidFeature& f) const {
    return mesh_[o]->vertices[f.kind == Kind::face ? mesh_[o]->faces[f.a][0] : f.a];
  }
  const MeshData* mesh_[2];
};

void expect_provenance(const MeshData& p, const MeshData& q, const SpatialSum& sum, const std::string& what) {
  const Witness witness(p, q);
  std::vector<Vector> at;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) at.push_back(vec(sum.exact(v)));
  for (const SpatialFace& face : sum.faces)
    for (const auto& loop : face.loops)
      for (const std::uint32_t v : loop) EXPECT_TRUE(witness.carries({face.p, face.q}, at[v])) << what;
  ASSERT_EQ(sum.vertex_contacts.size(), sum.vertices.size());
  for (std::size_t v = 0; v < at.size(); ++v)
    EXPECT_TRUE(!sum.vertex_contacts[v] || witness.carries(*sum.vertex_contacts[v], at[v])) << what;
  std::size_t sides = 0, facet_edges = 0, along = 0;
  for (const SpatialFace& face : sum.faces)
    for (const auto& loop : face.loops) facet_edges += loop.size();
  for (const SpatialEdge& edge : sum.edges()) {
    EXPECT_LT(edge.from, edge.to) << what;
    sides += edge.faces.size();
    if (!edge.contact) continue;
    ++along;
    for (const std::uint32_t v : {edge.from, edge.to}) EXPECT_TRUE(witness.carries(*edge.contact, at[v])) << what;
    EXPECT_NE(edge.contact->p.kind == Kind::vertex && edge.contact->q.kind == Kind::vertex, true) << what;
  }
  EXPECT_EQ(sides, facet_edges) << what;
  EXPECT_TRUE(sides == 0 || along > 0) << what;
  ASSERT_EQ(sum.tight_faces.size(), sum.tight_face_contacts.size());
  ASSERT_EQ(sum.tight_segments.size(), sum.tight_segment_contacts.size());
  ASSERT_EQ(sum.tight_points.size(), sum.tight_point_contacts.size());
  for (std::size_t k = 0; k < sum.tight_faces.size(); ++k)
    for (const SolidContact& side : sum.tight_face_contacts[k])
      for (const std::uint32_t v : sum.tight_faces[k][0]) EXPECT_TRUE(witness.carries(side, at[v])) << what;
  for (std::size_t k = 0; k < sum.tight_segments.size(); ++k) {
    EXPECT_GE(sum.tight_segment_contacts[k].size(), 2u) << what;
    for (const SolidContact& c : sum.tight_segment_contacts[k])
      for (const std::uint32_t v : sum.tight_segments[k]) EXPECT_TRUE(witness.carries(c, at[v])) << what;
  }
  for (std::size_t k = 0; k < sum.tight_points.size(); ++k) {
    EXPECT_GE(sum.tight_point_contacts[k].size(), 2u) << what;
    for (const SolidContact& c : sum.tight_point_contacts[k])
      EXPECT_TRUE(witness.carries(c, at[sum.tight_points[k]])) << what;
  }
}

TEST(SumProvenance, names_features_whose_sum_is_there) {
  const auto expect = [](const MeshData& p, const MeshData& q, const std::string& what) {
    expect_provenance(p, q, spatial::sum_of_solids(p, q, {}).value(), what);
  };
  expect(tunnel(), box(1), "tunnel and peg");
  expect(tunnel(), box(0.95), "tunnel and thin peg");
  expect(cavity(), box(1), "cavity and key");
  expect(ell(), solids::geodesic_sphere(2, 1, solids::kDemoSnap).data(), "ell and ball");
  const Mesh ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap),
             cube = solids::tessellated_cube(2, 2, solids::kDemoSnap);
  expect_provenance(ball.data(), cube.data(), minkowski_sum(ball, cube).value(), "convex");
  for (int k = 0; k < 6; ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(40 + k));
    const auto [p, q] = oracles::random_voxels(2, random);
    expect(oracles::voxel_mesh(p), oracles::voxel_mesh(q), "seed " + std::to_string(40 + k));
  }
}

TEST(SumProvenance, of_an_edge_of_sums_is_an_edge_and_a_vertex) {
  const SpatialSum sum = spatial::sum_of_solids(ell(), box(0.25), {}).value();
  EXPECT_EQ(sum.edges().size(), 18u);
  for (const SpatialEdge& edge : sum.edges()) {
    EXPECT_EQ(edge.faces.size(), 2u);
    EXPECT_TRUE(edge.contact.has_value()) << edge.from << " " << edge.to;
  }
  std::size_t corners = 0;
  for (const auto& contact : sum.vertex_contacts) corners += contact && contact->p.kind == Kind::vertex;
  EXPECT_EQ(corners, 12u) << "in the inner corner, too, the vertices touch";
}

}  // namespace
}  // namespace dymsum
