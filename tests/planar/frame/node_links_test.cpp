// Links in the nodes of windows of parallel shapes, against the sector rule said in other words: a ray that arrives is
// joined to the next direction counter-clockwise, if the rays there leave.
#include "planar/frame/piece_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using Ray = PersistentNode::Ray;

/// The rays of a node that are there when just the touches in `here` are.
std::vector<std::uint32_t> rays_here(const Window& w, const PersistentNode& n, const std::set<std::uint32_t>& here) {
  std::vector<std::uint32_t> rays;
  bool touches = n.hands_on;
  for (std::uint32_t r = n.first_ray; r < n.last_ray; ++r) {
    const bool touch = w.rays[r].touch != kNone;
    if (touch && !here.contains(w.rays[r].touch)) continue;
    touches |= touch;
    rays.push_back(r);
  }
  return touches ? rays : std::vector<std::uint32_t>{};
}

void check(const Window& w, const NodeLinks& links, std::uint32_t node, const std::set<std::uint32_t>& here,
           std::uint64_t& joined) {
  const PersistentNode& n = w.nodes[node];
  const std::vector<std::uint32_t> rays = rays_here(w, n, here);
  ASSERT_EQ(links.active(node), !rays.empty());
  for (std::uint32_t r = n.first_ray; r < n.last_ray; ++r) {
    const auto at = std::find(rays.begin(), rays.end(), r);
    std::uint32_t leaving = kNone;
    if (at != rays.end() && !w.rays[r].out) {
      std::size_t k = static_cast<std::size_t>(at - rays.begin());
      for (std::size_t steps = 0; steps < rays.size() && w.rays[rays[k]].group == w.rays[r].group; ++steps)
        k = k + 1 == rays.size() ? 0 : k + 1;
      if (w.rays[rays[k]].out) leaving = rays[k];
    }
    ASSERT_EQ(links.leaving(r), leaving);
    if (leaving == kNone) continue;
    ++joined;
    ASSERT_TRUE(links.entered(leaving));
  }
}

TEST(NodeLinks, follow_the_sector_rule_while_touches_come_and_go) {
  std::mt19937 random(31);
  std::uint64_t joined = 0, relinked = 0;
  for (int round = 0; round < 40; ++round) {
    const Region p = scaling_tests::skylines(random, 3 + round % 7, false),
                 q = scaling_tests::skylines(random, 3 + round % 5, round % 2 == 1);
    ScalingState state(pair_of_regions(p, q, PairOptions{.moved = 0}).value(), {});
    const auto window = state.windows.between(exact::BigRational(21, 20), exact::BigRational(23, 20));
    NodeLinks links(*window);
    std::set<std::uint32_t> here;
    for (int frame = 0; frame < 8; ++frame) {
      links.begin(frame == 0);
      for (std::uint32_t t = 0; t < window->touches.size(); ++t) {
        if (window->nodes[window->touches[t].node].covered) continue;
        const bool now = random() % 3 != 0;
        links.set_touch(t, now);
        if (now) here.insert(t);
        else here.erase(t);
      }
      std::vector<std::uint32_t> pieces;
      links.relink([&](std::uint32_t piece) { pieces.push_back(piece); });
      EXPECT_TRUE(std::is_sorted(links.relinked().begin(), links.relinked().end()));
      EXPECT_TRUE(pieces.empty() || !links.relinked().empty());
      relinked += links.relinked().size();
      for (std::uint32_t n = 0; n < window->nodes.size(); ++n)
        if (!window->nodes[n].covered) check(*window, links, n, here, joined);
    }
  }
  EXPECT_GT(relinked, 100u);
  EXPECT_GT(joined, 100u);
}

// Nothing that came or went: nothing is looked at.
TEST(NodeLinks, a_frame_without_changes_relinks_nothing) {
  std::mt19937 random(32);
  const Region p = scaling_tests::skylines(random, 6, false), q = scaling_tests::skylines(random, 5, false);
  ScalingState state(pair_of_regions(p, q, PairOptions{.moved = 0}).value(), {});
  const auto window = state.windows.between(exact::BigRational(21, 20), exact::BigRational(23, 20));
  NodeLinks links(*window);
  for (int frame = 0; frame < 3; ++frame) {
    links.begin(frame == 0);
    for (std::uint32_t t = 0; t < window->touches.size(); ++t) links.set_touch(t, true);
    links.relink([](std::uint32_t) {});
    if (frame > 0) {
      EXPECT_TRUE(links.relinked().empty());
    }
  }
}

}  // namespace
}  // namespace dymsum::planar
