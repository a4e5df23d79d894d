#include "spatial/events/scale_values.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <span>

#include "exact/rational_order.h"
#include "spatial/events/exact_judge.h"

namespace dymsum::spatial {

namespace {

struct JudgedScale {
  ExactMeeting at;
  exact::BigRational s;
  double near, radius;
  JudgedPoint judged;
};
using Verdict = JudgedPoint::Verdict;

bool is_before(const JudgedScale& a, const JudgedScale& b) {
  if (a.near + a.radius < b.near - b.radius) return true;
  if (b.near + b.radius < a.near - a.radius) return false;
  return exact::compare(a.s, b.s) < 0;
}

/// The first of every scale, and the end.
std::vector<std::size_t> first_of_each(const std::vector<JudgedScale>& judged) {
  std::vector<std::size_t> first;
  for (std::size_t k = 0; k < judged.size(); ++k)
    if (k == 0 || judged[k].s != judged[k - 1].s) first.push_back(k);
  first.push_back(judged.size());
  return first;
}

/// Decides what doubles left unknown at one scale, as far as the points there tell.
void judge_exactly(const MovingFacets& all, std::span<JudgedScale> points) {
  std::optional<ExactJudge> judge;
  for (JudgedScale& point : points) {
    if (point.judged.verdict != Verdict::unknown) continue;
    if (!judge && !ExactJudge::has_room(all, point.s)) return;
    if (!judge) judge.emplace(all, point.s);
    point.judged.verdict = judge->verdict(point.at, point.judged);
  }
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
    for (MeetingEvent& event : points) {
      ask();
      JudgedPoint judged = judge(all, search, overlap, event);
      exact::BigRational s = event.at.scale();
      parts[k].push_back({std::move(event.at), std::move(s), event.near.s, event.near.s_radius, std::move(judged)});
    }
    const std::lock_guard lock(counting);
    work.candidates += search.candidates(), work.exact += search.exact(), work.points += points.size();
  });
  std::vector<JudgedScale> judged;
  for (std::vector<JudgedScale>& part : parts)
    judged.insert(judged.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  watch.sort(judged, is_before);
  const std::vector<std::size_t> first = first_of_each(judged);
  watch.run(first.size() - 1, [&](std::size_t k) {
    watch.ask_within_part(static_cast<double>(k) / static_cast<double>(first.size()));
    judge_exactly(all, std::span(judged).subspan(first[k], first[k + 1] - first[k]));
  });
  std::vector<ScaleOfInterest> values;
  for (const JudgedScale& j : judged) {
    if (j.judged.verdict == Verdict::covered) continue;
    if (values.empty() || values.back().s != j.s) values.push_back({j.s, j.judged.kind, false, false, false});
    ScaleOfInterest& value = values.back();
    value.kind = std::max(value.kind, j.judged.kind);
    (j.judged.verdict == Verdict::changes ? value.changes : value.unknown) = true;
    if (j.judged.verdict == Verdict::unknown) value.unknown_topology = true;
  }
  work.values += values.size();
  return values;
}

}  // namespace dymsum::spatial
