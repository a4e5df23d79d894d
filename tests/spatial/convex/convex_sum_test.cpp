// The sum of convex solids against the hull of all sums of vertices, the brute force and the laws.
#include "dymsum/convex_sum.h"

#include "dymsum/convex_memory.h"
#include "exact/big.h"
#include "spatial/convex/convex_cases.h"

namespace dymsum::test {
namespace {

TEST(ConvexSum, of_two_cubes_is_a_cube) {
  const SpatialSum sum = *convex_sum(cube(1), cube(2));
  EXPECT_EQ(whole_mesh(sum), cube(3));
  EXPECT_EQ(sum.faces.size(), 6u);
  EXPECT_EQ(sum.volume_exact().to_string(), "216/1");
  for (const SpatialFace& f : sum.faces) {
    EXPECT_EQ(f.p.kind, SolidFeature::Kind::face);
    EXPECT_EQ(f.q.kind, SolidFeature::Kind::face);
  }
}

TEST(ConvexSum, grid_polytopes_equal_the_hull_of_sums) {
  std::mt19937_64 random(11);
  for (int k = 0; k < 150; ++k) {
    const Mesh p = random_grid_polytope(random, 4 + k % 9, 3), q = random_grid_polytope(random, 4 + k % 7, 3);
    const SpatialSum sum = *convex_sum(p, q);
    EXPECT_EQ(whole_mesh(sum).canonical().data(), hull_of_sums(p, q).canonical().data()) << "case " << k;
    expect_closed(sum);
    EXPECT_TRUE(identical(sum, *convex_sum(p, q, {}, {}, ConvexEngine::brute))) << "case " << k;
    EXPECT_TRUE(identical(sum, *minkowski_sum(p, q))) << "case " << k;
  }
}

TEST(ConvexSum, rotated_grid_polytopes_equal_the_hull_of_sums) {
  // Multiples of the norms keep rotated coordinates whole.
  const std::vector<Rotation> turns{*Rotation::of(2, 1, 0, 0), *Rotation::of(2, 0, 0, -1), *Rotation::of(1, 1, 1, 1),
                                    *Rotation::of(1, 0, 1, 0), *Rotation::of(0, 2, 1, 0),  *Rotation::of(1, 2, 2, 0)};
  std::mt19937_64 random(12);
  for (int k = 0; k < 120; ++k) {
    const Mesh p = random_grid_polytope(random, 4 + k % 9, 3, 45), q = random_grid_polytope(random, 4 + k % 7, 3, 45);
    const Rotation &a = turns[k % turns.size()], &b = turns[(k / 6) % turns.size()];
    const SpatialSum sum = *convex_sum(p, q, {a, {}}, {b, {}});
    EXPECT_EQ(whole_mesh(sum).canonical().data(), hull_of_sums(turned(p, a), turned(q, b)).canonical().data())
        << "case " << k;
    EXPECT_TRUE(identical(sum, *convex_sum(p, q, {a, {}}, {b, {}}, ConvexEngine::brute))) << "case " << k;
  }
}

TEST(ConvexSum, solid_with_itself_and_with_its_reflection) {
  for (const solids::NamedMesh& m : solids::thesis_models()) {
    const SpatialSum twice = *convex_sum(m.mesh, m.mesh);
    EXPECT_EQ(whole_mesh(twice), *scaled(m.mesh, 2, 2, 2)) << m.name;
    const SpatialSum difference = *convex_sum(m.mesh, negated(m.mesh));
    expect_closed(difference);
    EXPECT_EQ(whole_mesh(difference).canonical().data(), negated(whole_mesh(difference)).canonical().data()) << m.name;
  }
}

TEST(ConvexSum, measures_of_random_sums_agree) {
  std::mt19937_64 random(13);
  for (int k = 0; k < 20; ++k) {
    const Mesh p = random_round_polytope(random, 10 + 3 * k), q = random_round_polytope(random, 40);
    ConvexSum moving = *ConvexSum::create(p, q);
    SolidPose a{random_rotation(random), {random_scale(random), random_scale(random), random_scale(random)}},
        b{random_rotation(random), {}};
    moving.set(a, b);
    const SpatialSum sum = moving.sum();
    expect_closed(sum);
    EXPECT_EQ(sum.volume_exact(), moving.volume_exact()) << "facets and mixed volumes";
    EXPECT_NEAR(moving.volume() / sum.volume(), 1, 1e-11);
    EXPECT_EQ(sum.faces.size(), moving.face_vertex_count() + moving.edge_edge_count()) << "in general position";
    EXPECT_TRUE(identical(sum, *convex_sum(p, q, a, b, ConvexEngine::brute)));
    // Commutes: the same facets with roles exchanged.
    const SpatialSum other = *convex_sum(q, p, b, a);
    EXPECT_EQ(other.faces.size(), sum.faces.size());
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

// Extreme vertices of both operands may add up to a position inside an edge or a facet.
TEST(ConvexSum, support_is_a_vertex_of_the_sum_whatever_the_direction) {
  std::mt19937_64 random(16);
  const std::vector<Mesh> solids{
      cube(1), solids::rod(4, 3, 0.5, 2, solids::kDemoSnap), solids::cylinder(6, 1, 1, solids::kDemoSnap),
      solids::tessellated_cube(2, 2, solids::kDemoSnap), random_grid_polytope(random, 12, 3)};
  for (const Mesh& p : solids)
    for (const Mesh& q : {negated(p), p, solids::box(0, 0, 0, 1, 2, 3)})
      for (const Rotation& turn : {Rotation(), *Rotation::of(1, 1, 0, 0), *Rotation::of(3, 1, 0, 2)}) {
        ConvexSum moving = *ConvexSum::create(p, q);
        moving.set({turn, {}}, {turn, {}});
        const SpatialSum sum = moving.sum();
        std::vector<RationalPoint3> exact;
        for (std::size_t v = 0; v < sum.vertices.size(); ++v) exact.push_back(sum.exact(v));
        for (const Point3 d :
             {Point3{1, 0, 0}, Point3{0, 0, 0}, Point3{0, -5, 2}, Point3{-1, 1, 0}, Point3{0, 0, -1}}) {
          const auto rank = [&](const RationalPoint3& x) {
            const Rational height = *Rational::of(d.x) * x.x + *Rational::of(d.y) * x.y + *Rational::of(d.z) * x.z;
            return std::array{height, x.x, x.y, x.z};
          };
          std::size_t last = 0;
          for (std::size_t v = 1; v < exact.size(); ++v)
            if (rank(exact[last]) < rank(exact[v])) last = v;
          const ConvexSum::Support s = moving.support(d);
          EXPECT_EQ(s.vertex, vertex_pairs(sum)[last]);
          EXPECT_EQ(s.at, sum.vertices[last]);
          EXPECT_EQ(moving.exact(s.vertex), exact[last]);
        }
      }
}

TEST(ConvexSum, within_a_budget_holds_no_more) {
  std::mt19937_64 random(17);
  const Mesh p = random_round_polytope(random, 60), q = random_round_polytope(random, 80);
  const std::size_t whole = ConvexSum::create(p, q)->bytes();
  std::size_t made = 0, refused = 0;
  for (std::size_t memory = whole / 2; memory < whole + whole / 2; memory += whole / 500) {
    const Result<ConvexSum> sum = convex_sum_within(p, q, memory);
    ++(sum.ok() ? made : refused);
    if (sum.ok()) {
      EXPECT_LE(sum->bytes(), memory);
    } else {
      EXPECT_EQ(sum.error().code, ErrorCode::out_of_memory);
      EXPECT_NE(sum.error().message.find(std::to_string(memory) + " bytes"), std::string::npos) << sum.error().message;
    }
  }
  EXPECT_GT(made, 10u);
  EXPECT_GT(refused, 10u);
}

TEST(ConvexSum, huge_small_and_wide_coordinates_are_exact) {
  std::mt19937_64 random(15);
  const Mesh p = random_grid_polytope(random, 10, 3), q = random_grid_polytope(random, 8, 3);
  const SpatialSum plain = *convex_sum(p, q);
  for (const double unit : {0x1p200, 0x1p-200}) {
    const SpatialSum large = *convex_sum(*scaled(p, unit, unit, unit), *scaled(q, unit, unit, unit));
    EXPECT_EQ(structure(large), structure(plain));
  }
  // A translation by 2^40 and by 2^-60 needs 100 bits and changes nothing but positions.
  MeshData far = p.data();
  for (Point3& v : far.vertices) v = {v.x + 0x1p40, v.y, v.z + 1};
  far.vertices[0].y += 0;  // stays on the grid
  EXPECT_EQ(structure(*convex_sum(*Mesh::create(far), q)), structure(plain));
  const Mesh thin = *scaled(p, 1, 0x1p-90, 0x1p60);
  const SpatialSum wide = *convex_sum(thin, *scaled(q, 1, 0x1p-90, 0x1p60));
  EXPECT_EQ(structure(wide), structure(plain));
}

/// How far a double is from a number, relative to it.
double relative_error(double value, const Rational& truth) {
  const exact::BigRational t = exact::exact_value(truth);
  return exact::round_to_double(abs(exact::BigRational((exact::exact_value(value) - t) / t)));
}

TEST(ConvexSum, volumes_keep_their_promise_far_away_and_of_thin_solids) {
  std::mt19937_64 random(16);
  const auto expect_near = [&](const Mesh& p, const Mesh& q, const std::string& what) {
    ConvexSum sum = *ConvexSum::create(p, q);
    for (const bool turned : {false, true}) {
      if (turned) sum.set(random_rotation(random));
      EXPECT_LE(relative_error(sum.volume(), sum.volume_exact()), 1e-12) << what << (turned ? ", turned" : "");
    }
  };
  const Mesh far = free_box({0x1p50, 0x1p50, 0x1p50}, {0x1p50 + 1, 0x1p50 + 1, 0x1p50 + 1});
  expect_near(far, cube(1), "unit cube at 2^50");
  expect_near(far, negated(far), "twice");
  expect_near(*translated(solids::ellipsoid(24, 21, 0.5, 0.75, 1, solids::kDemoSnap), 0x1p30, 0, -0x1p30),
              solids::cone(40, 1, 2, solids::kDemoSnap), "ellipsoid at 2^30");
  for (const double thin : {0x1p-20, 0x1p-40, 0x1p-70}) {
    const Mesh plate = *scaled(solids::geodesic_sphere(3, 1, solids::kDemoSnap), 1, 1, thin),
               needle = *scaled(cube(1), 1, thin, thin);
    expect_near(plate, plate, "plates");
    expect_near(plate, needle, "plate and needle");
    expect_near(needle, needle, "needles");
  }
  for (const double unit : {0x1p-300, 0x1p300})
    expect_near(*scaled(cube(1), unit, unit, unit), *scaled(solids::cone(9, 1, 1, solids::kDemoSnap), unit, unit, unit),
                "sizes");
}

TEST(ConvexSum, measures_far_away_are_those_at_the_origin) {
  const Mesh far = free_box({0x1p50, 0x1p50, 0x1p50}, {0x1p50 + 1, 0x1p50 + 1, 0x1p50 + 1});
  const SpatialSum sum = *convex_sum(far, solids::dipyramid(4, 0.25, 0.5, solids::kDemoSnap)),
                   near =
                       *convex_sum(solids::box(0, 0, 0, 1, 1, 1), solids::dipyramid(4, 0.25, 0.5, solids::kDemoSnap));
  EXPECT_EQ(sum.volume(), near.volume());
  EXPECT_EQ(sum.area(), near.area()) << "from exact positions, although rounded ones collapse";
  const Mesh tiny = *scaled(cube(1), 0x1p-500, 0x1p-500, 0x1p-500);
  EXPECT_EQ(convex_sum(tiny, tiny)->area(), 6 * 0x1p-996);
}

TEST(ConvexSum, facets_are_counted_as_they_are) {
  const auto count = [](const Mesh& p, const Mesh& q) { return ConvexSum::create(p, q)->facet_count().all; };
  EXPECT_EQ(count(cube(1), cube(1)), 6u) << "30 in general position";
  EXPECT_EQ(count(cube(1), solids::box(0, 0, 0, 1, 2, 3)), 6u);
  EXPECT_EQ(count(solids::tessellated_cube(2, 3, solids::kDemoSnap), cube(1)), 6u);
  EXPECT_EQ(count(solids::cylinder(12, 1, 1, solids::kDemoSnap), solids::cylinder(12, 1, 3, solids::kDemoSnap)), 14u);
  EXPECT_EQ(count(solids::cylinder(12, 1, 1, solids::kDemoSnap), solids::cone(9, 2, 1, solids::kDemoSnap)),
            convex_sum(solids::cylinder(12, 1, 1, solids::kDemoSnap), solids::cone(9, 2, 1, solids::kDemoSnap))
                ->faces.size());
  for (const solids::NamedMesh& m : solids::thesis_models())
    EXPECT_EQ(count(m.mesh, m.mesh), m.mesh.canonical().faces().size()) << m.name;
  std::mt19937_64 random(17);
  const std::vector<Rotation> turns{Rotation(), *Rotation::of(1, 1, 1, 1), *Rotation::of(1, 0, 0, 1),
                                    *Rotation::of(2, 1, 0, 0)};
  for (int k = 0; k < 150; ++k) {
    ConvexSum sum =
        *ConvexSum::create(random_grid_polytope(random, 4 + k % 9, 2), random_grid_polytope(random, 4 + k % 7, 2));
    for (const Rotation& turn : {turns[k % turns.size()], Rotation(), turns[(k / 2) % turns.size()]}) {
      sum.set(turn);
      const SpatialSum whole = sum.sum();
      const ConvexSum::FacetCount facets = sum.facet_count();
      EXPECT_EQ(facets.all, whole.faces.size()) << "case " << k;
      EXPECT_EQ(facets.changed, sum.changed_facets().size()) << "case " << k;
    }
  }
}

TEST(ConvexSum, changed_facets_are_faces_of_the_sum) {
  std::mt19937_64 random(18);
  ConvexSum sum = *ConvexSum::create(random_round_polytope(random, 30), random_grid_polytope(random, 9, 3));
  for (int k = 0; k < 20; ++k) {
    sum.set(small_rotation(random, 0.1) * sum.p_pose().rotation);
    const SpatialSum whole = sum.sum();
    const std::vector<SolidContact> changed = sum.changed_facets();
    EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
    for (const SolidContact& c : changed)
      EXPECT_EQ(std::count_if(whole.faces.begin(), whole.faces.end(),
                              [&](const SpatialFace& f) { return f.p == c.p && f.q == c.q; }),
                1);
  }
  EXPECT_THROW((void)sum.exact({100000, 0}), std::invalid_argument);
}

TEST(ConvexSum, operands_that_are_not_convex_solids_are_told) {
  EXPECT_EQ(ConvexSum::create(Mesh(), cube(1)).error().code, ErrorCode::no_area);
  // A cube with a dent.
  MeshData dent = cube(2).data();
  dent.vertices.push_back({0, 0, 0});
  const auto apex = static_cast<std::uint32_t>(dent.vertices.size() - 1);
  const Face top = dent.faces.back();
  dent.faces.pop_back();
  for (std::size_t i = 0; i < top.size(); ++i) dent.faces.push_back({top[i], top[(i + 1) % top.size()], apex});
  const Result<Mesh> mesh = Mesh::create(dent);
  ASSERT_TRUE(mesh) << mesh.error().to_string();
  const Result<SpatialSum> sum = convex_sum(cube(1), *mesh);
  ASSERT_FALSE(sum);
  EXPECT_EQ(sum.error().code, ErrorCode::not_convex);
  EXPECT_TRUE(sum.error().evidence.vertex && sum.error().evidence.other_vertex);
  const SpatialSum other = *minkowski_sum(cube(1), *mesh);
  EXPECT_FALSE(other.is_convex());
  EXPECT_EQ(ConvexSum::create(other, cube(1)).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(other.rounded_hull().error().code, ErrorCode::not_convex);
  EXPECT_EQ(other.rounded_mesh()->data(), other.rounded()->mesh) << "of triangles";
}

}  // namespace
}  // namespace dymsum::test
