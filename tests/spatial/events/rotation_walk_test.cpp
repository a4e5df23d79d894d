// No angle at which the sum of random solids changes is missing among the events, and what they say of changes is so:
// looked at by sums at single angles, which know nothing of events.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "oracles/verdict.h"
#include "spatial/events/rotating_pairs.h"

namespace dymsum {
namespace {

using turning_pairs::Pair;

/// What can be told of a sum without the code of events; its hash is compared beside it.
struct SumCounts {
  std::uint64_t hash = 0;
  std::size_t vertices = 0, edges = 0, faces = 0, shells = 0, tight = 0;
  friend bool operator==(const SumCounts&, const SumCounts&) = default;
};
std::ostream& operator<<(std::ostream& out, const SumCounts& s) {
  return out << s.vertices << " vertices, " << s.edges << " edges, " << s.faces << " faces, " << s.shells << " shells";
}

struct Tally {
  std::size_t pairs = 0, refused = 0, events = 0, visible = 0, gaps = 0, sums = 0;
};

class EventsOfPair {
 public:
  EventsOfPair(const Pair& pair, SolidRotationEvents sum, std::string name, Tally& counts)
      : axis_(pair.axis), sum_(std::move(sum)), name_(std::move(name)), counts_(counts) {
    low_ = pair.from.radians(axis_), high_ = past(pair.to.radians(axis_));
  }

  void check(const std::vector<SolidRotationEvent>& events) {
    std::optional<SumCounts> before;
    for (std::size_t k = 0; k <= events.size(); ++k) {
      const double begin = k == 0 ? low_ : past(events[k - 1].approx),
                   end = k == events.size() ? high_ : past(events[k].approx);
      const std::optional<SumCounts> first = end - begin < 1e-8 ? std::optional<SumCounts>() : gap(begin, end);
      if (k > 0 && before && first) check_visible(events[k - 1], *before, *first);
      before = first;
    }
    counts_.events += events.size();
  }

 private:
  /// Angles from the first one on; that at which the range begins may be an event's.
  double past(double angle) const { return angle < low_ - 1e-9 ? angle + 2 * std::numbers::pi : angle; }
  SumCounts at(const AxisTurn& turn) {
    const Result<SpatialSum> sum = sum_.at(turn);
    if (!sum.ok()) return {};
    ++counts_.sums;
    return {sum_.combinatorial_hash(*sum),
            sum->vertices.size(),
            sum->edges().size(),
            sum->faces.size(),
            sum->shells,
            sum->tight_faces.size() + sum->tight_segments.size() + sum->tight_points.size()};
  }
  SumCounts at(double angle) { return at(AxisTurn::nearest(axis_, angle).value()); }

  /// Just after one event, before the next one and at angles between them nothing differs.
  SumCounts gap(double begin, double end) {
    ++counts_.gaps;
    const double width = end - begin, beside = std::min(width / 3, 1e-7);
    const SumCounts first = at(begin + beside);
    const int between = std::clamp(static_cast<int>(width / 0.004), 1, 6);
    for (int k = 0; k <= between; ++k) {
      const double angle = k == between ? end - beside : begin + width * (k + 0.5) / between;
      const SumCounts here = at(angle);
      EXPECT_EQ(here, first) << name_ << ": between " << begin << " and " << angle << ", where no event is";
    }
    return first;
  }
  void check_visible(const SolidRotationEvent& event, const SumCounts& before, const SumCounts& after) {
    bool differs = !(before == after);
    if (event.parameter.exact) differs = differs || !(at(*event.parameter.exact) == after);
    EXPECT_EQ(event.visible, differs) << name_ << ": at " << event.approx << ", " << before << ", then " << after;
    if (event.topology) {
      EXPECT_TRUE(event.visible) << name_;
    }
    counts_.visible += event.visible;
  }

  const TurnAxis axis_;
  SolidRotationEvents sum_;
  std::string name_;
  Tally& counts_;
  double low_ = 0, high_ = 0;
};

void check_pair(const Pair& pair, const std::string& name, Tally& counts) {
  SolidRotationOptions options;
  options.moving = pair.moving;
  SolidRotationEvents sum = SolidRotationEvents::create(pair.p, pair.q, pair.axis, options).value();
  const Result<std::vector<SolidRotationEvent>> events = sum.events(pair.from, pair.to);
  if (!events.ok() && events.error().code == ErrorCode::unsupported_operand) {  // coordinates of too many bits
    ++counts.refused;
    return;
  }
  ASSERT_TRUE(events.ok()) << name << ": " << events.error().to_string();
  ++counts.pairs;
  EventsOfPair(pair, std::move(sum), name, counts).check(*events);
}

/// DYMSUM_FUZZ_PAIRS / 40 pairs from DYMSUM_FUZZ_SEED on. Of the first 41 two have angles at which an edge turns into
/// the plane of a facet that it shares a corner with, and one a structure at an angle alone.
TEST(TurningEvents, NoneIsMissingOfRandomPairs) {
  const std::uint64_t first = oracles::setting("DYMSUM_FUZZ_SEED", 0),
                      count = oracles::setting("DYMSUM_FUZZ_PAIRS", 1640) / 40;
  Tally counts;
  for (std::uint64_t seed = first; seed < first + count; ++seed)
    check_pair(turning_pairs::Maker(seed).pair(), "DYMSUM_FUZZ_SEED=" + std::to_string(seed), counts);
  std::cout << counts.pairs << " pairs, " << counts.refused << " refused, " << counts.events << " events, "
            << counts.visible << " visible, " << counts.gaps << " gaps, " << counts.sums << " sums" << std::endl;
  EXPECT_LE(10 * counts.refused, count);
  EXPECT_GE(counts.visible, counts.pairs);
}

}  // namespace
}  // namespace dymsum
