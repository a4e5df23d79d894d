// Windows around angles at which shapes that were turned in doubles are nearly aligned: every event that they leave out
// is at a position that the obstacle covers at the event's exact angle.
#include "cspace/events/near_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cspace/boundary/free_position.h"
#include "cspace/events/exact_position.h"
#include "cspace/obstacle/event_windows.h"
#include "cspace/obstacle/obstacle_slices.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using namespace testing_obstacles;
using SegmentName = std::array<std::uint32_t, 3>;

struct Compared {
  std::size_t found = 0, left_out = 0, checked = 0;
};

using EventName = std::pair<RotationEvent::Kind, std::array<SegmentName, 3>>;
EventName name_of_event(const RotationEvent& e) {
  std::array<SegmentName, 3> names{};
  const auto name = [](const WalkSegment& s) { return SegmentName{s.side + 1, s.edge, s.vertex}; };
  if (e.kind == RotationEvent::Kind::vertex_on_segment) {
    names = {name(e.a), SegmentName{0, e.v.p, e.v.q}, SegmentName{}};
  } else {
    names = {name(e.a), name(e.b), name(e.c)};
    std::sort(names.begin(), names.end());
  }
  return {e.kind, names};
}

bool meets_freely(const RotationEvent& e, const TurningForms& forms, const RotationCatalog& catalog, int chart) {
  const SignsAt signs(forms, {chart, *e.root});
  std::vector<WalkSegment> on{e.a};
  ExactPosition z{{false, e.v, {}, {}}, {}};
  if (e.kind == RotationEvent::Kind::three_segments) {
    on = {e.a, e.b, e.c};
    bool crossing = false;
    for (std::size_t k = 0; k < 3 && !crossing; ++k)
      if (signs.cross(on[k], on[(k + 1) % 3]) != 0) {
        z.first = {true, {}, on[k], on[(k + 1) % 3]};
        crossing = true;
      }
    if (!crossing) return false;  // along one line: overlaps tell
  }
  const std::optional<Point> near = signs.near(z);
  if (!near) return false;
  for (const WalkSegment& s : on)
    if (!exists_at(signs, catalog, s) || !signs.within(s, z, *near)) return false;
  return is_free(signs, z);
}

Compared compared_events(const Region& robot, const Region& obstacle, std::size_t every) {
  Compared c;
  const auto base = pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true}).value();
  const TurningForms forms(*base);
  const RotationCatalog catalog(forms);
  const EventWindows fast(forms, catalog, false), slow(forms, catalog, true);
  std::set<std::pair<int, EventName>> found;
  std::set<std::pair<int, double>> whole;
  for (int k = 0; k < fast.count(); ++k)
    for (const PreparedWindow& p : fast.prepare(k, EventWindows::Halved::where_crowded)) {
      for (const RotationEvent& e : p.found.events) found.insert({p.range.chart, name_of_event(e)});
      c.found += p.found.events.size();
      if (p.at_end) whole.insert({p.range.chart, p.range.t_high});
    }
  std::size_t k = 0;
  for (int w = 0; w < slow.count(); ++w)
    for (const PreparedWindow& p : slow.prepare(w, EventWindows::Halved::where_crowded))
      for (const RotationEvent& e : p.found.events) {
        if (e.kind != RotationEvent::Kind::vertex_on_segment && e.kind != RotationEvent::Kind::three_segments) continue;
        if (found.contains({p.range.chart, name_of_event(e)})) continue;
        const bool at_slice = std::any_of(whole.begin(), whole.end(), [&](const auto& end) {
          return end.first == p.range.chart && exact::compare(*e.root, end.second) == 0;
        });
        if (at_slice) continue;
        ++c.left_out;
        if (++k % every != 0) continue;
        ++c.checked;
        EXPECT_FALSE(meets_freely(e, forms, catalog, p.range.chart))
            << e.theta() << " kind " << static_cast<int>(e.kind);
      }
  return c;
}

TEST(NearEvents, what_is_left_out_is_covered) {
  const Compared same = compared_events(turned(toothed(2), 30), turned(toothed(3), 30), 3);
  EXPECT_GT(same.checked, 300U);
  EXPECT_GT(same.left_out, 2 * same.found);
  const Compared other = compared_events(toothed(2), turned(toothed(3), 30), 3);
  EXPECT_GT(other.checked, 300U);
  EXPECT_GT(other.left_out, 2 * other.found);
}

TEST(NearEvents, what_is_left_out_of_random_cells_is_covered) {
  std::size_t checked = 0;
  for_seeds(6, [&](Random& random) {
    const Region robot = random_cells(random, 3, 1), obstacle = random_cells(random, 4, 1);
    checked += compared_events(turned(robot, 30), turned(obstacle, random() % 2 == 0 ? 30 : 77), 9).checked;
  });
  EXPECT_GT(checked, 100U);
}

}  // namespace
}  // namespace dymsum::planar
