#include "spatial/scaling/scale_values.h"

#include <algorithm>
#include <mutex>

#include "exact/rational_order.h"

namespace dymsum::spatial {

namespace {

struct JudgedScale {
  exact::BigRational s;
  double near, radius;
  JudgedPoint judged;
};

bool is_before(const JudgedScale& a, const JudgedScale& b) {
  if (a.near + a.radius < b.near - b.radius) return true;
  if (b.near + b.radius < a.near - a.radius) return false;
  return exact::compare(a.s, b.s) < 0;
}

}  // namespace

std::vector<ScaleOfInterest> scales_of_interest(const MovingFacets& all, const ScaledOverlap& overlap, double low,
                                                double high, SolidEventWork& work, StageWatch& watch) {
  const std::vector<double> ends = window_ends(all, low, high);
  std::vector<std::vector<JudgedScale>> parts(ends.size() - 1);
  std::mutex counting;
  watch.run(parts.size(), [&](std::size_t k) {
    const auto ask = [&] { watch.ask_within_part(static_cast<double>(k) / static_cast<double>(parts.size())); };
    EventSearch search(all, overlap, ends[k], ends[k + 1]);
    std::vector<MeetingEvent> points = search.run(ask);
    for (const MeetingEvent& event : points) {
      ask();
      parts[k].push_back({event.at.scale(), event.near.s, event.near.s_radius, judge(all, search, overlap, event)});
    }
    const std::lock_guard lock(counting);
    work.candidates += search.candidates(), work.exact += search.exact(), work.points += points.size();
  });
  std::vector<JudgedScale> judged;
  for (std::vector<JudgedScale>& part : parts)
    judged.insert(judged.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  watch.sort(judged, is_before);
  std::vector<ScaleOfInterest> values;
  for (const JudgedScale& j : judged) {
    if (values.empty() || values.back().s != j.s) values.push_back({j.s, j.judged.kind, false, false, false});
    ScaleOfInterest& value = values.back();
    value.kind = std::max(value.kind, j.judged.kind);
    (j.judged.verdict == JudgedPoint::Verdict::changes ? value.changes : value.unknown) = true;
    if (j.judged.verdict == JudgedPoint::Verdict::unknown) value.unknown_topology = true;
  }
  work.values += values.size();
  return values;
}

}  // namespace dymsum::spatial
