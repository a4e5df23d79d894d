// The events of a window against all triples of its segments, exactly.
#include "cspace/events/rotation_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cspace/obstacle/event_windows.h"
#include "oracles/random.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using Name = std::array<std::uint32_t, 3>;
Name name_of(const WalkSegment& s) { return {s.side, s.edge, s.vertex}; }

/// A square whose lower side is bent to and fro into short edges that hardly differ in direction.
Region bent_square(oracles::Random& random, double step) {
  RegionData data;
  data.parts.emplace_back();
  Ring& ring = data.parts[0].outer;
  const double at = 0.3 * random.signed_unit();
  ring = {{-1, 1}, {-1, 0.25}};
  for (int k = -2; k <= 2; ++k) {
    const double x = step * (k + 0.3 * random.signed_unit());
    ring.push_back({at + x, step * step * random.signed_unit()});
  }
  ring.push_back({1, 0.25});
  ring.push_back({1, 1});
  return Region::create(std::move(data)).value();
}

/// Whether all three exist at the root, and each is crossed by both others between its ends.
bool cross_there(const TurningForms& forms, const RotationCatalog& catalog, const std::array<WalkSegment, 3>& s,
                 const exact::AlgebraicRoot& t, int chart, double theta) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (catalog.exists(s[i], theta) != RotationCatalog::Existence::yes) return false;
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      const auto side = [&](Pair v) { return exact::sign_at(t, forms.exact_side(s[i], v, chart)); };
      if (side(TurningForms::start(s[j])) * side(forms.end(s[j])) >= 0) return false;
    }
  }
  return true;
}

// Crossings of short edges with lines that are nearly parallel to them are known to a part of their length only.
TEST(RotationEvents, short_edges_meet_where_hardly_anything_turns) {
  oracles::Random random(5);
  std::size_t expected = 0, missed = 0;
  for (int k = 0; k < 24; ++k) {
    const double step = k % 2 == 0 ? 0x1p-17 : 0x1p-15;
    const auto base = pair_of_regions(bent_square(random, step), bent_square(random, 0.7 * step),
                                      PairOptions{.moved = 1, .reflect_q = true})
                          .value();
    const TurningForms forms(*base);
    const RotationCatalog catalog(forms);
    const EventWindows windows(forms, catalog, true);
    for (int w = 0; w < windows.count(); ++w)
      for (const PreparedWindow& p : windows.prepare(w, EventWindows::Halved::where_crowded)) {
        if (p.range.theta(p.range.t_high) < 3.1 || p.range.theta(p.range.t_low) > 3.2) continue;
        std::set<std::array<Name, 3>> found;
        for (const RotationEvent& e : p.found.events) {
          if (e.kind != RotationEvent::Kind::three_segments) continue;
          std::array<Name, 3> names{name_of(e.a), name_of(e.b), name_of(e.c)};
          std::sort(names.begin(), names.end());
          found.insert(names);
        }
        std::vector<WalkSegment> short_ones;  // and what is hardly turned against them
        catalog.for_each(p.range.theta(p.range.t_low), p.range.theta(p.range.t_high), [&](const WalkSegment& s) {
          if (forms.length1(s) < 8 * step) short_ones.push_back(s);
        });
        for (std::size_t i = 0; i < short_ones.size(); ++i)
          for (std::size_t j = i + 1; j < short_ones.size(); ++j)
            for (std::size_t l = j + 1; l < short_ones.size(); ++l) {
              const std::array<WalkSegment, 3> s{short_ones[i], short_ones[j], short_ones[l]};
              const exact::Polynomial f = forms.exact_concurrency(s[0], s[1], s[2], p.range.chart);
              if (f.is_zero()) continue;
              for (const exact::AlgebraicRoot& t : exact::roots_in(f, p.range.t_low, p.range.t_high)) {
                if (!cross_there(forms, catalog, s, t, p.range.chart, p.range.theta(t.low()))) continue;
                std::array<Name, 3> names{name_of(s[0]), name_of(s[1]), name_of(s[2])};
                std::sort(names.begin(), names.end());
                ++expected;
                missed += !found.contains(names);
              }
            }
      }
  }
  EXPECT_GT(expected, 20u);
  EXPECT_EQ(missed, 0u);
}

}  // namespace
}  // namespace dymsum::planar
