// The sum of convex solids against the hull of all sums of vertices, the brute force and the laws.
#include "dymsum/convex_sum.h"

#include "convex_cases.h"

namespace dymsum::test {
namespace {

Mesh as_mesh(const SolidSum& sum) { return *Mesh::create(sum.rounded()); }

TEST(ConvexSum, of_two_cubes_is_a_cube) {
  const SolidSum sum = *convex_sum(cube(1), cube(2));
  EXPECT_EQ(as_mesh(sum), cube(3));
  EXPECT_EQ(sum.facets.size(), 6u);
  EXPECT_EQ(sum.volume_exact().to_string(), "216/1");
  for (const SolidFacet& f : sum.facets) {
    EXPECT_EQ(f.p.kind, SolidFeature::Kind::face);
    EXPECT_EQ(f.q.kind, SolidFeature::Kind::face);
  }
}

TEST(ConvexSum, grid_polytopes_equal_the_hull_of_sums) {
  std::mt19937_64 random(11);
  for (int k = 0; k < 150; ++k) {
    const Mesh p = random_grid_polytope(random, 4 + k % 9, 3), q = random_grid_polytope(random, 4 + k % 7, 3);
    const SolidSum sum = *convex_sum(p, q);
    EXPECT_EQ(as_mesh(sum).canonical().data(), hull_of_sums(p, q).canonical().data()) << "case " << k;
    expect_closed(sum);
    EXPECT_EQ(sum, *convex_sum(p, q, {}, {}, ConvexEngine::brute)) << "case " << k;
  }
}

TEST(ConvexSum, rotated_grid_polytopes_equal_the_hull_of_sums) {
  // Multiples of the norms keep rotated coordinates whole.
  const std::vector<Rotation> turns{*Rotation::of(2, 1, 0, 0), *Rotation::of(2, 0, 0, -1), *Rotation::of(1, 1, 1, 1), *Rotation::of(1, 0, 1, 0),
                                    *Rotation::of(0, 2, 1, 0), *Rotation::of(1, 2, 2, 0)};
  std::mt19937_64 random(12);
  for (int k = 0; k < 120; ++k) {
    const Mesh p = random_grid_polytope(random, 4 + k % 9, 3, 45), q = random_grid_polytope(random, 4 + k % 7, 3, 45);
    const Rotation &a = turns[k % turns.size()], &b = turns[(k / 6) % turns.size()];
    const SolidSum sum = *convex_sum(p, q, {a, {}}, {b, {}});
    EXPECT_EQ(as_mesh(sum).canonical().data(), hull_of_sums(turned(p, a), turned(q, b)).canonical().data()) << "case " << k;
    EXPECT_EQ(sum, *convex_sum(p, q, {a, {}}, {b, {}}, ConvexEngine::brute)) << "case " << k;
  }
}

TEST(ConvexSum, solid_with_itself_and_with_its_reflection) {
  for (const solids::NamedMesh& m : solids::thesis_models()) {
    const SolidSum twice = *convex_sum(m.mesh, m.mesh);
    EXPECT_EQ(as_mesh(twice), *scaled(m.mesh, 2, 2, 2)) << m.name;
    const SolidSum difference = *convex_sum(m.mesh, negated(m.mesh));
    expect_closed(difference);
    EXPECT_EQ(as_mesh(difference).canonical().data(), negated(as_mesh(difference)).canonical().data()) << m.name;
  }
}

TEST(ConvexSum, measures_of_random_sums_agree) {
  std::mt19937_64 random(13);
  for (int k = 0; k < 20; ++k) {
    const Mesh p = random_round_polytope(random, 10 + 3 * k), q = random_round_polytope(random, 40);
    ConvexSum moving = *ConvexSum::create(p, q);
    SolidPose a{random_rotation(random), {random_scale(random), random_scale(random), random_scale(random)}}, b{random_rotation(random), {}};
    moving.set(a, b);
    const SolidSum sum = moving.sum();
    expect_closed(sum);
    EXPECT_EQ(sum.volume_exact(), moving.volume_exact()) << "facets and mixed volumes";
    EXPECT_NEAR(moving.volume() / sum.volume(), 1, 1e-11);
    EXPECT_EQ(sum.facets.size(), moving.face_vertex_count() + moving.edge_edge_count()) << "in general position";
    EXPECT_EQ(sum, *convex_sum(p, q, a, b, ConvexEngine::brute));
    // Commutes: the same facets with roles exchanged.
    const SolidSum other = *convex_sum(q, p, b, a);
    EXPECT_EQ(other.facets.size(), sum.facets.size());
    EXPECT_EQ(other.volume_exact(), sum.volume_exact());
  }
}

TEST(ConvexSum, support_adds_up_and_is_the_furthest_vertex) {
  std::mt19937_64 random(14);
  std::uniform_int_distribution<int> grid(-3, 3);
  const Mesh p = random_grid_polytope(random, 12, 4), q = random_grid_polytope(random, 9, 4);
  ConvexSum moving = *ConvexSum::create(p, q);
  for (int k = 0; k < 50; ++k) {
    const Point3 d{double(grid(random)), double(grid(random)), double(grid(random))};
    const auto height = [&](const Point3& x) { return d.x * x.x + d.y * x.y + d.z * x.z; };
    double most_p = -1e9, most_q = -1e9;
    for (const Point3& v : p.vertices()) most_p = std::max(most_p, height(v));
    for (const Point3& v : q.vertices()) most_q = std::max(most_q, height(v));
    const ConvexSum::Support s = moving.support(d);
    EXPECT_EQ(height(s.at), most_p + most_q);
    EXPECT_EQ(height(p.vertices()[s.vertex.p]), most_p);
    EXPECT_EQ(height(q.vertices()[s.vertex.q]), most_q);
  }
}

TEST(ConvexSum, huge_small_and_wide_coordinates_are_exact) {
  std::mt19937_64 random(15);
  const Mesh p = random_grid_polytope(random, 10, 3), q = random_grid_polytope(random, 8, 3);
  const SolidSum plain = *convex_sum(p, q);
  for (const double unit : {0x1p200, 0x1p-200}) {
    const SolidSum large = *convex_sum(*scaled(p, unit, unit, unit), *scaled(q, unit, unit, unit));
    EXPECT_EQ(large.facets, plain.facets);
    EXPECT_EQ(large.vertices, plain.vertices);
  }
  // A translation by 2^40 and by 2^-60 needs 100 bits and changes nothing but positions.
  MeshData far = p.data();
  for (Point3& v : far.vertices) v = {v.x + 0x1p40, v.y, v.z + 1};
  far.vertices[0].y += 0;  // stays on the grid
  EXPECT_EQ((*convex_sum(*Mesh::create(far), q)).facets, plain.facets);
  const Mesh thin = *scaled(p, 1, 0x1p-90, 0x1p60);
  const SolidSum wide = *convex_sum(thin, *scaled(q, 1, 0x1p-90, 0x1p60));
  EXPECT_EQ(wide.facets, plain.facets);
  EXPECT_EQ(wide.vertices, plain.vertices);
}

TEST(ConvexSum, operands_that_are_not_convex_solids_are_told) {
  EXPECT_EQ(ConvexSum::create(Mesh(), cube(1)).error().code, Code::no_area);
  EXPECT_TRUE(ConvexSum::create(cube(0x1p250), cube(1)).ok());
  const Result<ConvexSum> huge = ConvexSum::create(cube(0x1p251), cube(1));
  ASSERT_FALSE(huge);
  EXPECT_EQ(huge.error().code, Code::unsupported_operand);
  EXPECT_TRUE(huge.error().evidence.vertex && huge.error().evidence.z);
  // A cube with a dent.
  MeshData dent = cube(2).data();
  dent.vertices.push_back({0, 0, 0});
  const auto apex = static_cast<std::uint32_t>(dent.vertices.size() - 1);
  const Face top = dent.faces.back();
  dent.faces.pop_back();
  for (std::size_t i = 0; i < top.size(); ++i) dent.faces.push_back({top[i], top[(i + 1) % top.size()], apex});
  const Result<Mesh> mesh = Mesh::create(dent);
  ASSERT_TRUE(mesh) << mesh.error().to_string();
  const Result<SolidSum> sum = convex_sum(cube(1), *mesh);
  ASSERT_FALSE(sum);
  EXPECT_EQ(sum.error().code, Code::not_convex);
  EXPECT_TRUE(sum.error().evidence.vertex && sum.error().evidence.other_vertex);
}

}  // namespace
}  // namespace dymsum::test
