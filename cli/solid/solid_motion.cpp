#include "solid/solid_motion.h"

#include <iostream>
#include <optional>
#include <sstream>

#include "outputs.h"
#include "progress_bar.h"
#include "solid/moving_solids.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

std::uint64_t checked(const MotionWork& w) { return w.vertex_checks + w.crossing_checks + w.arc_checks; }

Json sizes_json(const ConvexSum& sum, const MotionWork& work) {
  const ConvexSum::FacetCount facets = sum.facet_count();
  return {{"faces", facets.all},
          {"volume_exact", sum.volume_exact().to_string()},
          {"changed", facets.changed},
          {"checked", checked(work)}};
}

/// All rounds: the times of every frame; of the last round its work and frames.
struct Rounds {
  std::optional<ConvexSum> sum;  ///< at the last frame
  std::vector<double> ms;
  std::uint64_t changed = 0, checked = 0;
  Json frames = Json::array();
};

Rounds run(const SolidMotion& motion, const ReportOptions& report, const Progress& progress) {
  Rounds rounds;
  const std::vector<SolidFrame>& frames = motion.frames;
  for (std::size_t round = 0; round < report.repeat; ++round) {
    rounds.sum = require(ConvexSum::create(motion.inputs[0].mesh, motion.inputs[1].mesh));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!progress("frames", double(i) / double(frames.size()))) throw_if_interrupted();
      const auto [work, timing] = timed(1, [&] { return rounds.sum->set(frames[i].p, frames[i].q); });
      rounds.ms.push_back(timing.median_ms);
      if (round + 1 < report.repeat) continue;
      rounds.changed += rounds.sum->facet_count().changed;
      rounds.checked += checked(work);
      if (report.json)
        rounds.frames.push_back(frame_json(frames[i].name, sizes_json(*rounds.sum, work), timing.median_ms));
    }
  }
  return rounds;
}

double static_ms(const ConvexSum& sum) {
  ConvexSum fresh = sum;
  return timed(9, [&] { return fresh.rebuild(); }).second.median_ms;
}

void write_outputs(const SolidMotion& motion, const Rounds& rounds) {
  std::vector<std::string> texts;
  ConvexSum shown = *rounds.sum;
  if (motion.shown) shown.set(motion.frames[*motion.shown].p, motion.frames[*motion.shown].q);
  const SolidOutput how{"off", motion.inputs[0].hull.has_value(), false, 0, shown.changed_facets()};
  const SpatialSum sum = shown.sum();
  for (const std::string& file : motion.files) texts.push_back(solid_output(sum, file, how));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(motion.files[i], texts[i]);
}

MotionReport report_of(const SolidMotion& motion, std::size_t repeats, Rounds&& rounds) {
  MotionReport report;
  report.verb = motion.verb;
  for (const SolidInput& input : motion.inputs) report.files.push_back(input.file);
  report.inputs = solid_inputs_json(motion.inputs);
  report.tier = rounds.sum->tier_bits();
  report.repeats = repeats;
  report.frame_count = motion.frames.size();
  report.ms = std::move(rounds.ms);
  report.static_ms = static_ms(*rounds.sum);
  report.requested = motion.requested;
  report.note = motion.note;
  report.frames = std::move(rounds.frames);
  report.work = {{"changed", rounds.changed}, {"checked", rounds.checked}};
  const std::size_t facets = rounds.sum->facet_count().all;
  const auto per_frame = [&](std::uint64_t n) { return double(n) / double(motion.frames.size()); };
  std::ostringstream text;
  text << "a frame checks " << per_frame(rounds.checked) << " features and changes " << per_frame(rounds.changed)
       << " of " << counted(facets, "facet");
  report.work_text = text.str();
  report.lines = {"at " + motion.frames.back().name.pose + ": " + counted(facets, "facet")};
  return report;
}

}  // namespace

SolidFrame turned_frame(const Rotation& rotation, const Point3& axis, const std::string& pose) {
  const auto& q = rotation.quaternion();
  const bool clockwise = double(q[1]) * axis.x + double(q[2]) * axis.y + double(q[3]) * axis.z < 0;
  SolidFrame frame;
  frame.p.rotation = rotation;
  frame.name = {pose, {{"theta", clockwise && q[0] != 0 ? -rotation.angle() : rotation.angle()}, {"quaternion", q}}};
  return frame;
}

ExitCode run_solid_motion(const SolidMotion& motion, const ReportOptions& report) {
  if (motion.shown && *motion.shown >= motion.frames.size())
    throw Stop(kUsage, "--frame is beyond the last one, " + std::to_string(motion.frames.size() - 1));
  for (const SolidInput& input : motion.inputs)
    if (convexity_error(input.mesh)) return run_moving_solids(motion, report);
  std::ostream& out = report_stream(motion.files, report.json);
  check_solid_outputs(motion.files, {}, ".html (the viewer), and a frame as ");
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  Rounds rounds = run(motion, report, bar->callback());
  bar.reset();
  throw_if_interrupted();
  write_outputs(motion, rounds);
  MotionReport made = report_of(motion, report.repeat, std::move(rounds));
  print_solid_motion(out, motion, made, report.json);
  return kDone;
}

void print_solid_motion(std::ostream& out, const SolidMotion& motion, MotionReport& report, bool as_json) {
  if (as_json) {
    Json json = motion_json(report);
    if (motion.has_events) {
      Json& list = json["events"] = Json::array();
      for (const MotionEvent& event : motion.events) list.push_back(event.json);
    }
    return print_report(json);
  }
  if (motion.has_events)
    for (const MotionEvent& event : motion.events) report.lines.push_back(event.line);
  print_motion(out, report);
}

}  // namespace dymsum::cli
