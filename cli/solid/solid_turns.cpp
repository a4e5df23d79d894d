#include "solid/solid_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

#include "dymsum/solid_rotation_events.h"
#include "numbers.h"
#include "options.h"
#include "pictures/svg_paths.h"
#include "progress_bar.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

TurnAxis read_axis(const std::string& text) {
  const Point3 axis = parse_point(text, "--axis");
  TurnAxis whole{};
  const double of[3] = {axis.x, axis.y, axis.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (of[k] != std::nearbyint(of[k]) || std::abs(of[k]) > 32768)
      throw Stop(kUsage, "--axis wants whole numbers up to 32768 with --events, not '" + text + "'");
    whole[k] = static_cast<std::int32_t>(of[k]);
  }
  return whole;
}

struct RotationRange {
  AxisTurn from, to;
  AxisTurn opposite;        ///< of `from`
  bool whole_turn = false;  ///< after `from`, round to it
};

/// FROM:TO, angles as of --angle.
RotationRange read_range(const std::string& text, const TurnAxis& axis) {
  const std::size_t colon = text.find(':');
  std::array<AxisTurn, 2> ends;
  std::array<Angle, 2> angles;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string part = k == 0 ? text.substr(0, colon) : text.substr(std::min(colon, text.size() - 1) + 1);
    const std::optional<Angle> angle = colon == std::string::npos ? std::nullopt : angle_in(part);
    if (!angle) throw Stop(kUsage, "--range wants FROM:TO, such as 0:0.5 or 30deg:45deg, not '" + text + "'");
    ends[k] = require_option(AxisTurn::nearest(axis, angle->radians()), "--axis");
    angles[k] = *angle;
  }
  const double circle = angles[0].degrees ? 360 : 2 * std::numbers::pi;
  if (angles[0].degrees != angles[1].degrees) throw Stop(kUsage, "--range wants both ends in the same unit: " + text);
  const double way = (angles[1].exact - angles[0].exact).to_double();
  if (std::abs(way) > circle) throw Stop(kUsage, "--range wants ends that are at most a turn apart: " + text);
  if (-way == circle) throw Stop(kUsage, "--range goes counter-clockwise: a whole turn ends at FROM + 360deg: " + text);
  const AxisTurn opposite = require_option(AxisTurn::nearest(axis, angles[0].radians() + std::numbers::pi), "--axis");
  return {ends[0], ends[1], opposite, way == circle};
}

Json turn_json(const AxisTurn& turn) { return turn.is_half_turn() ? "inf" : turn.t().to_string(); }

Json rotation_event_json(const SolidRotationEvent& event) {
  Json contacts = Json::array();
  for (const SolidRotationContact& c : event.contacts) {
    Json features = Json::array();
    for (const SolidContact& f : c.features) features.push_back({{"p", feature_json(f.p)}, {"q", feature_json(f.q)}});
    contacts.push_back({{"kind", name(c.kind)}, {"at", {c.at.x, c.at.y, c.at.z}}, {"features", features}});
  }
  const AlgebraicTurn& at = event.parameter;
  return {{"theta", event.approx},       {"t", at.exact ? turn_json(*at.exact) : Json(nullptr)},
          {"polynomial", at.polynomial}, {"t_low", at.t_low},
          {"t_high", at.t_high},         {"opposite", at.opposite},
          {"visible", event.visible},    {"topology", event.topology},
          {"contacts", contacts}};
}

std::string rotation_event_line(const SolidRotationEvent& event) {
  std::ostringstream out;
  const AlgebraicTurn& at = event.parameter;
  std::map<EventKind, std::size_t> kinds;
  for (const SolidRotationContact& c : event.contacts) ++kinds[c.kind];
  out << "event " << number(event.approx * 180 / std::acos(-1.0)) << " degrees";
  if (at.exact) out << ", t = " << (at.exact->is_half_turn() ? std::string("inf") : shown(at.exact->t()));
  else out << ", t of degree " << at.polynomial.size() - 1;
  out << ":";
  for (const auto& [kind, count] : kinds) out << " " << count << " " << name(kind);
  out << (event.topology ? "  topology changes" : event.visible ? "" : "  at this angle alone");
  return out.str();
}

std::optional<SolidRotationEvent> find_next(const SolidRotationEvents& sum, const SolidTurns& turns,
                                            const RotationRange& range, const Progress& progress) {
  const auto next = [&](const AxisTurn& from, const AxisTurn& to) {
    return require(turns.next_topology ? sum.next_topology_change(from, to, progress)
                                       : sum.next_event(from, to, progress));
  };
  if (!range.whole_turn) return next(range.from, range.to);
  const std::optional<SolidRotationEvent> found = next(range.from, range.opposite);
  return found ? found : next(range.opposite, range.from);
}

std::vector<SolidRotationEvent> find_events(const SolidRotationEvents& sum, const SolidTurns& turns,
                                            const Progress& progress) {
  const RotationRange range = read_range(turns.range.empty() ? "0deg:360deg" : turns.range, sum.axis());
  if (turns.next || turns.next_topology) {
    const std::optional<SolidRotationEvent> found = find_next(sum, turns, range, progress);
    return found ? std::vector<SolidRotationEvent>{*found} : std::vector<SolidRotationEvent>{};
  }
  return require(range.whole_turn ? sum.events_of_turn(progress) : sum.events(range.from, range.to, progress));
}

/// An event of the rotation from zero to `angle`.
MotionEvent motion_event(const SolidRotationEvent& event, double angle) {
  const double whole = 2 * std::numbers::pi;
  double at = event.approx;
  if (angle >= 0 && at < 0) at += whole;
  if (angle < 0 && at > 0) at -= whole;
  return {at, rotation_event_line(event), rotation_event_json(event)};
}

}  // namespace

std::vector<MotionEvent> rotation_events(const std::vector<SolidInput>& inputs, const std::string& axis_text,
                                         const Angle& angle) {
  const TurnAxis axis = read_axis(axis_text);
  const double radians = angle.radians(), whole = angle.degrees ? 360 : 2 * std::numbers::pi;
  const double way = angle.exact.to_double();
  if (std::abs(way) > whole) throw Stop(kUsage, "--events wants a turn of at most 360 degrees");
  const InterruptGuard guard;
  ProgressBar bar;
  const SolidRotationEvents sum = require(SolidRotationEvents::create(inputs[0].mesh, inputs[1].mesh, axis));
  const AxisTurn zero = require_option(AxisTurn::nearest(axis, 0), "--axis"),
                 end = require_option(AxisTurn::nearest(axis, radians), "--angle");
  const Result<std::vector<SolidRotationEvent>> found = std::abs(way) == whole ? sum.events_of_turn(bar.callback())
                                                        : way > 0              ? sum.events(zero, end, bar.callback())
                                                                               : sum.events(end, zero, bar.callback());
  throw_if_interrupted();
  std::vector<MotionEvent> events;
  for (const SolidRotationEvent& event : require(found)) events.push_back(motion_event(event, way));
  std::stable_sort(events.begin(), events.end(),
                   [&](const MotionEvent& a, const MotionEvent& b) { return way < 0 ? b.at < a.at : a.at < b.at; });
  return events;
}

ExitCode run_solid_turns(const SolidTurns& turns, const ReportOptions& report) {
  const TurnAxis axis = read_axis(turns.axis);
  if (turns.next && turns.next_topology) throw Stop(kUsage, "--next excludes --next-topology");
  if (!turns.range.empty()) read_range(turns.range, axis);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  const SolidRotationEvents sum =
      require(SolidRotationEvents::create(turns.inputs[0].mesh, turns.inputs[1].mesh, axis));
  const auto [events, timing] = timed(report.repeat, [&] { return find_events(sum, turns, progress); });
  bar.reset();
  if (report.json) {
    Json list = Json::array();
    for (const SolidRotationEvent& e : events) list.push_back(rotation_event_json(e));
    Json json = report_head("rotate", solid_inputs_json(turns.inputs), 0, timing);
    json["axis"] = {axis[0], axis[1], axis[2]};
    json["range"] = turns.range.empty() ? Json(nullptr) : Json(turns.range);
    json["events"] = list;
    print_report(json);
  } else {
    for (const SolidRotationEvent& e : events) std::cout << rotation_event_line(e) << "\n";
    std::cout << counted(events.size(), "event") << ", " << sum.work().windows << " windows, " << sum.work().candidates
              << " polynomials, " << counted(sum.work().sums, "sum") << "\n";
    print_times(std::cout, timing);
  }
  return events.empty() && (turns.next || turns.next_topology) ? kNo : kDone;
}

}  // namespace dymsum::cli
