// A sum in motion is the one made from scratch at its poses: canonical form and tight features.
#include "dymsum/moving_solid_sum.h"

#include <gtest/gtest.h>

#include "dymsum/convex_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/convex/setting.h"
#include "spatial/moving/moving_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using moving_cases::Moves;
using spatial::PosePair;

SpatialSum fresh(const Mesh& p, const Mesh& q, const PosePair& poses) {
  MovingSolidOptions options;
  return posed_sum(p, q, poses.p, poses.q, options).value();
}

/// What touches on faces, along edges and at vertices, tight ones included.
bool same_features(const SpatialSum& a, const SpatialSum& b) {
  const auto of_faces = [](const SpatialFace& f, const SpatialFace& g) { return f.p == g.p && f.q == g.q; };
  const auto of_edges = [](const SpatialEdge& e, const SpatialEdge& f) { return e.contact == f.contact; };
  const std::vector<SpatialEdge> a_edges = a.edges(), b_edges = b.edges();
  return std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), of_faces) &&
         std::equal(a_edges.begin(), a_edges.end(), b_edges.begin(), b_edges.end(), of_edges) &&
         a.vertex_contacts == b.vertex_contacts && a.tight_face_contacts == b.tight_face_contacts &&
         a.tight_segment_contacts == b.tight_segment_contacts && a.tight_point_contacts == b.tight_point_contacts;
}

TEST(MovingSolidSum, IsAFreshSumAfterMovesOfAllKinds) {
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 31), queried = test::setting("DYMSUM_FUZZ_MOVES", 130);
  std::size_t updated = 0;
  const auto pairs = moving_cases::small_pairs();
  for (const auto& [name, p, q] : pairs) {
    MovingSolidSum moving = MovingSolidSum::create(p, q).value();
    Moves moves(seed);
    PosePair poses;
    for (std::size_t k = 0; k < queried / pairs.size(); ++k) {
      poses = moves.next(poses);
      const Result<SolidFrameWork> work = moving.set(poses.p, poses.q);
      ASSERT_TRUE(work.ok()) << work.error().to_string();
      const SpatialSum sum = fresh(p, q, poses);
      ASSERT_TRUE(moving.sum() == sum) << name << ", move " << k;
      const bool convex = !convexity_error(p) && !convexity_error(q);  // then faces are named as ConvexSum does
      ASSERT_TRUE(convex || same_features(moving.sum(), sum)) << name << ", move " << k;
      updated += !work->rebuilt;
    }
  }
  EXPECT_GT(updated, queried / 4);
}

TEST(MovingSolidSum, OfCoordinatesOfEveryKindIsAFreshSum) {
  std::mt19937_64 random(7312);
  const auto pairs = moving_cases::small_pairs();
  std::size_t updated = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const std::size_t chosen : {1U, 4U, 6U, 9U}) {
      const auto& [name, one, other] = pairs[chosen];
      const Result<Mesh> p = Mesh::create(of_kind(triangulated(one).mesh.data(), kind, random)),
                         q = Mesh::create(of_kind(triangulated(other).mesh.data(), kind, random));
      if (!p.ok() || !q.ok()) continue;
      MovingSolidSum moving = MovingSolidSum::create(*p, *q).value();
      Moves moves(7);
      PosePair poses;
      for (int k = 0; k < 4; ++k) {
        poses = moves.next(poses);
        const Result<SolidFrameWork> work = moving.set(poses.p, poses.q);
        ASSERT_TRUE(work.ok()) << work.error().to_string();
        ASSERT_TRUE(moving.sum() == fresh(*p, *q, poses)) << name_of(kind) << ", " << name << ", move " << k;
        updated += !work->rebuilt;
      }
    }
  EXPECT_GT(updated, 10u);
}

TEST(PosedSums, AreFreshSumsOnceEachWhateverTheThreads) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    Moves moves(5);
    std::vector<SolidPose> of_p, of_q;
    PosePair poses;
    for (int k = 0; k < 12; ++k) poses = moves.next(poses), of_p.push_back(poses.p), of_q.push_back(poses.q);
    for (const int threads : {1, 3}) {
      MovingSolidOptions options;
      options.threads = threads;
      std::vector<int> visits(of_p.size());
      const auto visit = [&](std::size_t k, const SpatialSum& sum) {
        ++visits[k];
        EXPECT_TRUE(sum == fresh(p, q, {of_p[k], of_q[k]})) << name << ", pose " << k;
      };
      const Result<std::vector<SolidFrameWork>> works = posed_sums(p, q, of_p, of_q, visit, options);
      ASSERT_TRUE(works.ok()) << works.error().to_string();
      EXPECT_EQ(works->size(), of_p.size());
      EXPECT_EQ(visits, std::vector<int>(of_p.size(), 1));
    }
  }
}

/// Poses a hundredth of a degree apart, shuffled: in the order of the batch they are short moves.
TEST(PosedSums, PosesThatLieNearAreUpdatedInWhateverOrderTheyCome) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(1, 6)), q = moving_cases::mesh_of(moving_cases::bumpy(2, 6));
  std::vector<SolidPose> poses;
  for (int k = 0; k < 30; ++k) poses.push_back({*Rotation::about({1, 2, 3}, 1 + 2e-4 * (k * 7 % 30)), {}});
  std::size_t rebuilt = 0;
  const auto visit = [&](std::size_t k, const SpatialSum& sum) { EXPECT_TRUE(sum == fresh(p, q, {poses[k], {}})); };
  const std::vector<SolidFrameWork> works = posed_sums(p, q, poses, {}, visit).value();
  for (const SolidFrameWork& work : works) rebuilt += work.rebuilt;
  EXPECT_LT(rebuilt, poses.size() / 4);
}

TEST(PosedSums, StopAtTheFirstFailure) {
  const Mesh p = moving_cases::mesh_of(ell());
  const std::vector<SolidPose> poses(40), few(3);
  const auto nothing = [](std::size_t, const SpatialSum&) {};
  EXPECT_EQ(posed_sums(p, p, poses, few, nothing).error().code, ErrorCode::out_of_range);
  EXPECT_TRUE(posed_sums(p, p, {}, {}, nothing)->empty());
  MovingSolidOptions options;
  options.threads = 2;
  int visits = 0;
  const auto thrown = [&](std::size_t, const SpatialSum&) {
    if (++visits == 5) throw std::domain_error("enough");
  };
  EXPECT_THROW((void)posed_sums(p, p, poses, {}, thrown, options), std::domain_error);
  EXPECT_EQ(visits, 5);
  visits = 0;
  options.progress = [&](std::string_view, double) { return visits < 7; };
  const auto counted = [&](std::size_t, const SpatialSum&) { ++visits; };
  EXPECT_EQ(posed_sums(p, p, poses, {}, counted, options).error().code, ErrorCode::cancelled);
  EXPECT_EQ(visits, 7);
}

TEST(MovingSolidSum, AFittingPegStaysTightAtQuarterTurns) {
  const Mesh block = moving_cases::mesh_of(tunnel()), peg = moving_cases::mesh_of(box(1));
  MovingSolidSum moving = MovingSolidSum::create(block, peg).value();
  Rotation turn;
  for (int k = 0; k < 6; ++k) {
    turn = *Rotation::of(1, k % 3 == 0, k % 3 == 1, k % 3 == 2) * turn;
    const SolidPose beside{moving_cases::Moves(1).turned(turn, 1e-6), {}};
    ASSERT_TRUE(moving.set({turn, {}}).ok());
    EXPECT_EQ(moving.sum().tight_faces.size() + moving.sum().tight_segments.size(), 1u);
    ASSERT_TRUE(moving.sum() == fresh(block, peg, {{turn, {}}, {}}));
    ASSERT_TRUE(moving.set(beside).ok());
    EXPECT_EQ(moving.sum().tight_segments.size(), 0u);
    ASSERT_TRUE(moving.sum() == fresh(block, peg, {beside, {}}));
  }
}

/// Turned coordinates are integers over the norm of the quaternion, so that P and Q times that norm are meshes.
TEST(MovingSolidSum, IsTheSumOfTurnedMeshes) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(1, 4)), q = moving_cases::mesh_of(ell());
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  for (const auto& [w, x, y, z] : {std::array<int, 4>{5, 1, 0, 2}, {5, 1, 1, 2}, {1, 1, 0, 0}, {2, -1, 3, 1}}) {
    const Rotation turn = *Rotation::of(w, x, y, z);
    ASSERT_TRUE(moving.set({turn, {}}).ok());
    MeshData turned = p.data(), scaled = q.data();
    const auto n = turn.matrix();
    const auto row = [&](std::size_t r, const Point3& v) {
      return double(n[3 * r]) * v.x + double(n[3 * r + 1]) * v.y + double(n[3 * r + 2]) * v.z;
    };
    const double norm = static_cast<double>(turn.norm());
    for (Point3& v : turned.vertices) v = {row(0, v), row(1, v), row(2, v)};
    for (Point3& v : scaled.vertices) v = {norm * v.x, norm * v.y, norm * v.z};
    const SpatialSum expected = minkowski_sum(Mesh::create(turned).value(), Mesh::create(scaled).value()).value();
    const SpatialSum& sum = moving.sum();
    ASSERT_EQ(sum.faces, expected.faces);
    ASSERT_EQ(sum.vertices.size(), expected.vertices.size());
    for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
      const RationalPoint3 a = sum.exact(v), b = expected.exact(v);
      const auto same = [&](const Rational& s, const Rational& t) {
        return exact::exact_value(s) * exact::BigRational(turn.norm()) == exact::exact_value(t);
      };
      ASSERT_TRUE(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z));
    }
  }
}

TEST(MovingSolidSum, ConvexOperandsHaveTheSumsOfTheGeneralStages) {
  const Mesh p = solids::dipyramid(7, 2, 3, solids::kDemoSnap), q = solids::box(0, 0, 0, 2, 1, 1);
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  ConvexSum convex = ConvexSum::create(p, q).value();
  Moves moves(8);
  PosePair poses;
  for (int k = 0; k < 25; ++k) {
    poses = moves.next(poses);
    ASSERT_TRUE(moving.set(poses.p, poses.q).ok());
    convex.set(poses.p, poses.q);
    ASSERT_TRUE(moving.sum() == convex.sum());
    ASSERT_TRUE(moving.sum() == fresh(p, q, poses)) << k;
  }
}

/// Upright prisms that turn about the upright axis: the planar sum that turns, over both heights.
TEST(MovingSolidSum, PrismsHaveTheSumsOfPlanarFrames) {
  const Region base_p = shapes::letter_l(3, 2, 1), base_q = shapes::letter_l(2, 5, 1);
  const auto upright = [](const Region& base, double height) {
    return solids::prism(base.parts()[0].outer, height, solids::kDemoSnap);
  };
  MovingSolidSum solid = MovingSolidSum::create(upright(base_p, 2), upright(base_q, 3)).value();
  RotatingSum planar = RotatingSum::create(base_p, base_q).value();
  for (int k = 0; k < 12; ++k) {
    ASSERT_TRUE(planar.set(*Orientation::of(k, 40)).ok());
    ASSERT_TRUE(solid.set({*Rotation::of(40, 0, 0, k), {}}).ok());
    EXPECT_EQ(solid.sum().volume_exact(), planar.sum().area_exact() * Rational(5));
    EXPECT_EQ(solid.sum().vertices.size(), 2 * planar.sum().vertex_count());
    EXPECT_EQ(solid.sum().faces.size(), 2 + planar.sum().vertex_count());
  }
}

TEST(MovingSolidSum, ScalingAlikeAlongAllAxesLooksAtNothing) {
  const Mesh p = moving_cases::mesh_of(tunnel()), q = moving_cases::mesh_of(ell());
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  for (int k = 1; k < 4; ++k) {
    SolidPose pose;
    for (Scale& s : pose.scale) s = *Scale::parse(std::to_string(100 + k) + "/100");
    const SolidFrameWork work = moving.set(pose).value();
    EXPECT_FALSE(work.rebuilt);
    EXPECT_EQ(work.normals_checked + work.pairs_checked + work.facets_added + work.facets_removed, 0u);
    ASSERT_TRUE(moving.sum() == fresh(p, q, {pose, {}}));
  }
}

TEST(MovingSolidSum, MassesOfTiesAreMadeFromScratch) {
  const Mesh p = moving_cases::gear(6, 4, 2), q = moving_cases::gear(5, 3, 1);
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  std::size_t rebuilt = 0;
  for (int k = 1; k < 6; ++k) {
    SolidPose pose;
    pose.scale[2] = *Scale::parse(std::to_string(100 + k) + "/100");
    rebuilt += moving.set(pose)->rebuilt;
    ASSERT_TRUE(moving.sum() == fresh(p, q, {pose, {}}));
  }
  EXPECT_EQ(rebuilt, 4u) << "all but the one that found it out";
}

TEST(MovingSolidSum, ThereAndBackIsTheSame) {
  const Mesh p = moving_cases::mesh_of(moving_cases::torus(3, 1, 6, 4)), q = moving_cases::mesh_of(ell());
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  std::vector<SpatialSum> there;
  const auto pose = [](int k) { return SolidPose{*Rotation::about({1, 1, 2}, 0.01 * k), {}}; };
  for (int k = 0; k < 12; ++k) {
    ASSERT_TRUE(moving.set(pose(k)).ok());
    EXPECT_FALSE(moving.work().rebuilt);
    there.push_back(moving.sum());
  }
  for (int k = 12; k-- > 0;) {
    ASSERT_TRUE(moving.set(pose(k)).ok());
    ASSERT_TRUE(moving.sum() == there[k]);
  }
}

// Faces that several pairs of coplanar features tile are named by the sum alone, not by how it was found.
TEST(MovingSolidSum, GrowingAlikeChangesNoFace) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    MovingSolidSum moving = MovingSolidSum::create(p, p).value();
    for (const char* s : {"1.01", "1.02", "1.03", "1.03"}) {
      const Scale scale = *Scale::parse(s);
      const SolidPose pose{{}, {scale, scale, scale}};
      ASSERT_TRUE(moving.set(pose, pose).ok());
      const SolidFrameChanges changes = moving.changes();
      EXPECT_TRUE(changes.appeared.empty() && changes.disappeared.empty() && changes.changed.empty()) << name << s;
    }
  }
}

TEST(MovingSolidSum, AtTheIdentityFeaturesAreThoseOfASumAtRest) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    const SpatialSum still = minkowski_sum(p, q).value();
    if (!convexity_error(p) && !convexity_error(q)) continue;  // a ConvexSum
    EXPECT_TRUE(same_features(still, posed_sum(p, q, {}, {}, {}).value())) << name;
    EXPECT_TRUE(same_features(still, MovingSolidSum::create(p, q).value().sum())) << name;
  }
}

TEST(MovingSolidSum, ChangesTellWhichFacesCameAndWent) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(2, 1)), q = moving_cases::mesh_of(ell());
  MovingSolidSum moving = MovingSolidSum::create(p, q).value();
  EXPECT_TRUE(moving.changes().appeared.empty());
  const auto faces = [&] {
    std::set<SolidContact> all;
    for (const SpatialFace& face : moving.sum().faces) all.insert({face.p, face.q});
    return all;
  };
  std::set<SolidContact> now = faces();
  for (int k = 1; k < 8; ++k) {
    ASSERT_TRUE(moving.set({*Rotation::about({3, 1, 2}, 0.05 * k), {}}).ok());
    const SolidFrameChanges changes = moving.changes();
    const std::set<SolidContact> then = faces();
    for (const SolidContact& c : changes.appeared) EXPECT_TRUE(now.insert(c).second);
    for (const SolidContact& c : changes.disappeared) EXPECT_EQ(now.erase(c), 1u);
    EXPECT_EQ(now, then);
    for (const SolidContact& c : changes.changed) EXPECT_TRUE(then.contains(c));
  }
  ASSERT_TRUE(moving.set(moving.p_pose()).ok());
  const SolidFrameChanges still = moving.changes();
  EXPECT_TRUE(still.appeared.empty() && still.disappeared.empty() && still.changed.empty());
}

TEST(MovingSolidSum, RefusesWhatItCannotHold) {
  const Mesh cube = moving_cases::mesh_of(box(1)), bent = moving_cases::mesh_of(ell());
  MovingSolidOptions options;
  options.threads = -1;
  EXPECT_EQ(MovingSolidSum::create(bent, cube, options).error().code, ErrorCode::out_of_range);
  const Mesh wire = Mesh::with_thin_parts({{{0, 0, 0}, {1, 0, 0}}, {{0, 1}}}).value();
  EXPECT_EQ(MovingSolidSum::create(wire, wire).error().code, ErrorCode::unsupported_operand);
  MovingSolidSum moving = MovingSolidSum::create(bent, cube).value();
  const SpatialSum before = moving.sum();
  SolidPose fine;
  for (std::size_t axis = 0; axis < 3; ++axis)  // of 12,000 bits over their common denominator
    fine.scale[axis] =
        *Scale::parse("1" + std::string(1200, '0') + "2/1" + std::string(1200, '0') + std::array{"1", "3", "7"}[axis]);
  EXPECT_EQ(moving.set(fine).error().code, ErrorCode::unsupported_operand);
  EXPECT_TRUE(moving.sum() == before);
  EXPECT_TRUE(moving.p_pose() == SolidPose{});
  options.threads = 1;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(MovingSolidSum::create(bent, cube, options).error().code, ErrorCode::cancelled);
  options.progress = {};
  MovingSolidSum with_wire = MovingSolidSum::create(bent, wire, options).value();
  ASSERT_TRUE(with_wire.set({*Rotation::of(3, 0, 0, 1), {}}).ok());
  EXPECT_TRUE(with_wire.work().rebuilt);
}

}  // namespace
}  // namespace dymsum
