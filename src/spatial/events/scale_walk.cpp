#include "spatial/events/scale_walk.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "planar/operand/scale_value.h"
#include "spatial/events/plane_names.h"
#include "spatial/motion/beside_origin.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

using exact::BigRational;

std::optional<Error> scaling_refusal(const Mesh& p, const Mesh& q, int threads) {
  if (threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(threads), {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an operand of a scaling sum of solids has parts without volume", {}};
  return std::nullopt;
}

namespace {

/// How far the window reaches beyond both ends, so that there is a scale before the first event and one after the last.
constexpr double kBeside = 0x1p-12;

struct JudgedScale {
  ExactMeeting at;
  BigRational s;
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

/// Decides what doubles left unknown at one scale, as far as the points there decide.
void judge_exactly(const MovingFacets& all, std::span<JudgedScale> points) {
  std::optional<ExactJudge> judge;
  for (JudgedScale& point : points) {
    if (point.judged.verdict != Verdict::unknown) continue;
    if (!judge && !ExactJudge::has_room(all, point.s)) return;
    if (!judge) judge.emplace(all, point.s);
    point.judged.verdict = judge->verdict(point.at, point.judged);
  }
}

/// All points in a range of scales, by scales and with what they tell.
std::vector<JudgedScale> judged_points(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high,
                                       SolidEventWork& work, StageWatch& watch) {
  const std::vector<double> ends = window_ends(all, low, high);
  std::vector<std::vector<JudgedScale>> parts(ends.size() - 1);
  std::mutex counting;
  watch.run(parts.size(), [&](std::size_t k) {
    const auto query = [&] { watch.query_within_part(static_cast<double>(k) / static_cast<double>(parts.size())); };
    Meetings found = find_meetings(all, overlap, ends[k], ends[k + 1], query);
    for (MeetingEvent& event : found.points) {
      query();
      JudgedPoint judged = judge(all, found.facets, overlap, event);
      BigRational s = event.at.scale();
      parts[k].push_back({std::move(event.at), std::move(s), event.near.s, event.near.s_radius, std::move(judged)});
    }
    const std::lock_guard lock(counting);
    work.candidates += found.candidates, work.exact += found.exact, work.points += found.points.size();
  });
  std::vector<JudgedScale> judged;
  for (std::vector<JudgedScale>& part : parts)
    judged.insert(judged.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  watch.sort(judged, is_before);
  const std::vector<std::size_t> first = first_of_each(judged);
  watch.run(first.size() - 1, [&](std::size_t k) {
    watch.query_within_part(static_cast<double>(k) / static_cast<double>(first.size()));
    judge_exactly(all, std::span(judged).subspan(first[k], first[k + 1] - first[k]));
  });
  return judged;
}

/// A scale at which a sum may change, with what is known of it.
struct ScaleOfInterest {
  BigRational s;
  EventKind kind = EventKind::vertex_on_facet;
  bool changes = false;           ///< provably
  bool unknown = false;           ///< sums have to be compared, unless it provably changes
  bool unknown_topology = false;  ///< in any case

  bool has_to_be_compared() const { return unknown_topology || (unknown && !changes); }
};

/// All of them from `low` to `high` in order, and perhaps some just beside. Exact. Throws Cancelled.
std::vector<ScaleOfInterest> scales_of_interest(const MovingFacets& all, const ScaledOverlap& overlap, double low,
                                                double high, SolidEventWork& work, StageWatch& watch) {
  std::vector<ScaleOfInterest> values;
  for (const JudgedScale& j : judged_points(all, overlap, low, high, work, watch)) {
    if (j.judged.verdict == Verdict::covered) continue;
    if (values.empty() || values.back().s != j.s) values.push_back({j.s, j.judged.kind});
    ScaleOfInterest& value = values.back();
    value.kind = std::max(value.kind, j.judged.kind);
    (j.judged.verdict == Verdict::changes ? value.changes : value.unknown) = true;
    if (j.judged.verdict == Verdict::unknown) value.unknown_topology = true;
  }
  work.values += values.size();
  return values;
}

}  // namespace

ScaleWalk::ScaleWalk(const Mesh& p, const Mesh& q, const SolidScaleOptions& options)
    : options_(options), given_(solid_pair(p, q), options.moving == MovingOperand::p ? 0 : 1) {
  if (given_.pair().p.vertices.empty() || given_.pair().q.vertices.empty()) return;
  stages_ = stage_options({});
  stages_.semantics = options_.semantics, stages_.tight = options_.tight, stages_.threads = options_.threads;
  SpatialStats stats;
  StageWatch watch(stages_, stats);
  watch.begin("convolution");
  const std::optional<Mesh> near_p = beside_origin(p), near_q = beside_origin(q);
  facets_.emplace(
      near_p || near_q ? ScalingPair(solid_pair(near_p.value_or(p), near_q.value_or(q)), given_.moving()) : given_,
      watch);
  overlap_.emplace(*facets_);
}

SpatialSum ScaleWalk::sum_of(const ScalingPair& of, const Scale& s, const Progress& progress, int threads,
                             CornerContacts* corners) const {
  if (!facets_) return {};
  SpatialOptions stages = stages_;
  stages.progress = progress, stages.threads = threads;
  return sum_of_facets(of.pair(), posed_space(of.pair(), of.poses(s)), facets_->convolution(), {}, stages, corners);
}

SumShape ScaleWalk::shape_of_sum(const ScalingPair& of, const Scale& s, const Progress& progress) const {
  if (!facets_) return {};
  return shape_of(sum_of(of, s, progress, 1), [&](const SolidContact& c) { return plane_name(of, c); });
}

ScaleWalk::Shapes ScaleWalk::shapes_at(const std::vector<BigRational>& scales, StageWatch& watch) const {
  std::vector<SumShape> found(scales.size());
  watch.run(scales.size(), [&](std::size_t k) {
    found[k] = shape_of_sum(*facets_, computed_scale(scales[k]), [&](std::string_view, double) {
      watch.query_within_part(static_cast<double>(k) / static_cast<double>(scales.size()));
      return true;
    });
  });
  Shapes shapes;
  for (std::size_t k = 0; k < scales.size(); ++k) shapes.emplace(scales[k], std::move(found[k]));
  return shapes;
}

std::vector<ScaleEvent> ScaleWalk::events(const BigRational& a, const BigRational& b, ListedScales listed,
                                          const Progress& progress, SolidEventWork& work) const {
  if (!facets_) return {};
  SpatialStats stats;
  SpatialOptions queried = stages_;
  queried.progress = progress;
  StageWatch watch(queried, stats);
  watch.begin("events");
  const double low = exact::round_to_double(a) * (1 - kBeside), high = exact::round_to_double(b) * (1 + kBeside);
  const std::vector<ScaleOfInterest> values = scales_of_interest(*facets_, *overlap_, low, high, work, watch);
  // One scale between each two of them, and one beyond both ends.
  std::vector<BigRational> between;
  for (std::size_t k = 0; k <= values.size(); ++k) {
    const BigRational before = k == 0 ? exact::exact_value(low) : values[k - 1].s,
                      after = k == values.size() ? exact::exact_value(high) : values[k].s;
    between.push_back(before < after ? planar::simple_between(before, after) : before);
  }
  watch.begin("sums");
  std::vector<BigRational> wanted;
  const auto is_queried = [&](const ScaleOfInterest& v) { return v.s >= a && v.s <= b; };
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k].has_to_be_compared() && is_queried(values[k]))
      for (const BigRational& s : {between[k], values[k].s, between[k + 1]})
        if (wanted.empty() || wanted.back() < s) wanted.push_back(s);
  const Shapes shapes = shapes_at(wanted, watch);
  work.sums += wanted.size();
  std::vector<ScaleEvent> events;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ScaleOfInterest& v = values[k];
    if (!is_queried(v)) continue;
    ShapeChange change{v.changes, false};
    if (v.has_to_be_compared()) {
      change = change_of(shapes.at(between[k]), shapes.at(v.s), shapes.at(between[k + 1]));
      change.visible = change.visible || v.changes;
    }
    if (change.visible || listed == ListedScales::all)
      events.push_back({exact::to_rational(v.s), exact::round_to_double(v.s), v.kind, change.visible, change.topology});
  }
  watch.begin("");
  return events;
}

/// Ends of ranges in which facets move by about their own size.
std::vector<BigRational> ScaleWalk::steps(const BigRational& from, const BigRational& to) const {
  if (!facets_) return {from, to};
  std::vector<BigRational> ends{from};
  const std::vector<double> windows = window_ends(*facets_, exact::round_to_double(from), exact::round_to_double(to));
  for (const double end : windows)
    if (const BigRational e = exact::exact_value(end); e > ends.back() && e < to) ends.push_back(e);
  ends.push_back(to);
  return ends;
}

}  // namespace dymsum::spatial
