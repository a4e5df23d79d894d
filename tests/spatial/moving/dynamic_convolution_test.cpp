// The facets of a convolution in motion are those of one made from scratch, after any moves.
#include "spatial/moving/dynamic_convolution.h"

#include <gtest/gtest.h>

#include <tuple>

#include "spatial/convex/setting.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum::spatial {
namespace {

using moving_cases::Moves;

auto record(const SumFacet& f) { return std::tuple(f.kind, f.corners, f.p, f.q, f.corner); }

/// All facets, in order.
bool same_as_static(const SolidPair& pair, const DynamicConvolution& moving, const PosePair& poses) {
  SpatialOptions options;
  options.threads = 1;
  SpatialStats stats;
  StageWatch watch(options, stats);
  const PosedSpace posed = posed_space(pair, poses);
  const ReducedConvolution fresh = reduced_convolution(*posed.space, pair.p, pair.q, watch);
  const std::vector<std::uint32_t> slots = moving.in_order();
  if (slots.size() != fresh.facets.size() || moving.slots().facets() != slots.size()) return false;
  for (std::size_t k = 0; k < slots.size(); ++k)
    if (record(moving.slots()[slots[k]]) != record(fresh.facets[k]) || !moving.slots().exists(slots[k])) return false;
  return true;
}

const ConvolutionWork& move(const SolidPair& pair, DynamicConvolution& moving, const PosePair& poses) {
  SpaceOnDemand exact(pair, poses);
  return moving.set(poses, exact);
}

TEST(DynamicConvolution, IsTheStaticOneAfterMovesOfAllKinds) {
  const std::vector<moving_cases::NamedPair> pairs = moving_cases::small_pairs();
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 17), queried = test::setting("DYMSUM_FUZZ_MOVES", 1300);
  const std::size_t each = queried / pairs.size();
  std::size_t updated = 0, exact = 0;
  for (const auto& [name, p, q] : pairs) {
    const SolidPair pair = solid_pair(p, q);
    DynamicConvolution moving(pair);
    Moves moves(seed);
    PosePair poses;
    for (std::size_t k = 0; k < each; ++k) {
      poses = moves.next(poses);
      const ConvolutionWork& work = move(pair, moving, poses);
      updated += !work.rebuilt, exact += work.exact_checks;
      ASSERT_TRUE(same_as_static(pair, moving, poses)) << name << ", move " << k;
    }
  }
  EXPECT_GT(updated, queried / 4);
  EXPECT_GT(exact, queried);
}

/// A whole turn in steps about a tilted axis, of one operand.
std::vector<PosePair> turn(int steps) {
  std::vector<PosePair> poses;
  for (int k = 0; k <= steps; ++k)
    poses.push_back({{*Rotation::about({1, 2, 3}, 2 * std::numbers::pi * k / steps), {}}, {}});
  return poses;
}

TEST(DynamicConvolution, SmallMovesLookAtFewNormals) {
  const SolidPair pair = solid_pair(moving_cases::mesh_of(moving_cases::torus(2, 0.6, 20, 12)),
                                    moving_cases::mesh_of(moving_cases::torus(1.3, 0.35, 18, 10)));
  DynamicConvolution moving(pair);
  std::uint64_t checked = 0, changed = 0;
  const std::vector<PosePair> poses = turn(5000);
  for (std::size_t k = 0; k < 200; ++k) {
    const ConvolutionWork& work = move(pair, moving, poses[k]);
    EXPECT_EQ(work.rebuilt, k == 0);
    if (k > 0) checked += work.normals_checked, changed += work.added + work.removed;
    if (k % 20 == 0) {
      ASSERT_TRUE(same_as_static(pair, moving, poses[k])) << k;
    }
  }
  const std::uint64_t normals = pair.p.triangles.size() + pair.q.triangles.size();
  EXPECT_LT(checked, 200 * normals / 5);
  EXPECT_GT(changed, 100u);
}

TEST(DynamicConvolution, ThereAndBackIsTheSame) {
  const SolidPair pair =
      solid_pair(moving_cases::mesh_of(moving_cases::torus(3, 1, 6, 4)), moving_cases::gear(5, 4, 2));
  DynamicConvolution moving(pair);
  const std::vector<PosePair> poses = turn(90);
  std::vector<std::vector<SumFacet>> there;
  const auto facets = [&] {
    std::vector<SumFacet> all;
    for (const std::uint32_t slot : moving.in_order()) all.push_back(moving.slots()[slot]);
    return all;
  };
  for (const PosePair& pose : poses) move(pair, moving, pose), there.push_back(facets());
  for (std::size_t k = poses.size(); k-- > 0;) {
    move(pair, moving, poses[k]);
    const std::vector<SumFacet> back = facets();
    ASSERT_EQ(back.size(), there[k].size());
    for (std::size_t f = 0; f < back.size(); ++f) ASSERT_EQ(record(back[f]), record(there[k][f]));
  }
}

TEST(DynamicConvolution, ASkippedCertificateIsNoticed) {
  const SolidPair pair =
      solid_pair(moving_cases::mesh_of(moving_cases::bumpy(2, 1)), moving_cases::mesh_of(moving_cases::bumpy(2, 2)));
  for (const SkippedCertificate skipped : {SkippedCertificate::births, SkippedCertificate::crossings}) {
    DynamicConvolution moving(pair, skipped);
    bool wrong = false;
    for (const PosePair& pose : turn(300)) {
      move(pair, moving, pose);
      wrong = wrong || !same_as_static(pair, moving, pose);
    }
    EXPECT_TRUE(wrong);
  }
}

}  // namespace
}  // namespace dymsum::spatial
