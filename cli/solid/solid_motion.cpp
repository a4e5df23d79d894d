#include "solid/solid_motion.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>

#include "outputs.h"
#include "pictures/frame_pictures.h"
#include "pictures/solid_page.h"
#include "progress_bar.h"
#include "solid/moving_solids.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

/// Pictures show every frame, of a long or large motion evenly chosen ones.
constexpr std::size_t kMostFramePictures = 240, kMostPicturedFacets = 150000;

void check_outputs(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!is_page(file)) check_solid_outputs({file}, {}, ".html, and the last frame as ");
}

std::uint64_t checked(const MotionWork& w) { return w.vertex_checks + w.crossing_checks + w.arc_checks; }

Json sizes_json(const ConvexSum& sum, const MotionWork& work) {
  const ConvexSum::FacetCount facets = sum.facet_count();
  return {{"faces", facets.all},
          {"volume_exact", sum.volume_exact().to_string()},
          {"changed", facets.changed},
          {"checked", checked(work)}};
}

/// All rounds: the times of every frame; of the last round its work, frames and pictures.
struct Rounds {
  std::optional<ConvexSum> sum;  ///< at the last frame
  std::vector<double> ms;
  std::uint64_t changed = 0, checked = 0;
  Json frames = Json::array();
  std::vector<SolidPicture> pictures;
  std::size_t every = 1;  ///< so-manieth frame that is pictured
};

Rounds run(const SolidMotion& motion, const ReportOptions& report, const Progress& progress) {
  Rounds rounds;
  const std::vector<SolidFrame>& frames = motion.frames;
  const bool pictures = std::any_of(motion.files.begin(), motion.files.end(), is_page);
  for (std::size_t round = 0; round < report.repeat; ++round) {
    rounds.sum = require(ConvexSum::create(motion.inputs[0].mesh, motion.inputs[1].mesh));
    const std::size_t facets = rounds.sum->facet_count().all;
    const std::size_t most = std::clamp<std::size_t>(kMostPicturedFacets / facets, 1, kMostFramePictures);
    rounds.every = (frames.size() + most - 1) / most;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!progress("frames", double(i) / double(frames.size()))) throw_if_interrupted();
      const auto [work, timing] = timed(1, [&] { return rounds.sum->set(frames[i].p, frames[i].q); });
      rounds.ms.push_back(timing.median_ms);
      if (round + 1 < report.repeat) continue;
      rounds.changed += rounds.sum->facet_count().changed;
      rounds.checked += checked(work);
      if (report.json)
        rounds.frames.push_back(frame_json(frames[i].name, sizes_json(*rounds.sum, work), timing.median_ms));
      if (pictures && i % rounds.every == 0) rounds.pictures.push_back({frames[i].name.pose, rounds.sum->sum()});
    }
  }
  return rounds;
}

double static_ms(const ConvexSum& sum) {
  ConvexSum fresh = sum;
  return timed(9, [&] { return fresh.rebuild(); }).second.median_ms;
}

void write_outputs(const SolidMotion& motion, const Rounds& rounds) {
  const std::vector<SolidInput>& inputs = motion.inputs;
  const std::string title = motion.verb + " of " + inputs[0].file + " and " + inputs[1].file;
  std::vector<std::string> texts;
  ConvexSum shown = *rounds.sum;
  if (motion.shown) shown.set(motion.frames[*motion.shown].p, motion.frames[*motion.shown].q);
  for (const std::string& file : motion.files)
    texts.push_back(is_page(file) ? solid_page(rounds.pictures, event_ticks(motion, rounds.every), title)
                                  : solid_output(shown.sum(), file, {"off", inputs[0].hull.has_value(), false}));
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
  report.asked = motion.asked;
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
  check_outputs(motion.files);
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

std::vector<SliderTick> event_ticks(const SolidMotion& motion, std::size_t every) {
  std::vector<double> frames;
  for (std::size_t i = 0; i < motion.frames.size(); i += every) frames.push_back(motion.frames[i].at);
  std::vector<SliderTick> ticks;
  for (const MotionEvent& event : motion.events) {
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
      const double a = frames[k], b = frames[k + 1];
      if (a == b || event.at < std::min(a, b) || event.at > std::max(a, b)) continue;
      const double share = (static_cast<double>(k) + (event.at - a) / (b - a)) / double(frames.size() - 1);
      ticks.push_back({share, event.label, event.topology});
      break;
    }
  }
  return ticks;
}

}  // namespace dymsum::cli
