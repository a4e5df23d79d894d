#include "solid/moving_solids.h"

#include <iostream>
#include <optional>
#include <sstream>
#include <utility>

#include "dymsum/moving_solid_sum.h"
#include "outputs.h"
#include "progress_bar.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

void check_files(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (is_stage_mesh(file)) throw Stop(kUsage, file + ": stages are drawn by sum");
    check_solid_outputs({file}, {}, ".html (the viewer), and a frame as ");
  }
}

std::uint64_t checked(const SolidFrameWork& work) { return work.normals_checked + work.pairs_checked; }

/// All rounds: the times of every frame; of the last round its frames, its work, and the sum that is shown.
struct MovingRounds {
  std::vector<double> ms;
  Json frames = Json::array();
  std::uint64_t changed = 0, checked = 0, faces = 0, rebuilt = 0;
  SpatialSum shown;
};

MovingSolidSum moving_sum(const SolidMotion& motion, const MovingSolidOptions& options) {
  Result<MovingSolidSum> sum = MovingSolidSum::create(motion.inputs[0].mesh, motion.inputs[1].mesh, options);
  throw_if_interrupted();
  if (!sum) stop_with(in_solid_operand(sum.error(), motion.inputs));
  return *std::move(sum);
}

MovingRounds run_rounds(const SolidMotion& motion, const ReportOptions& report, const Progress& progress) {
  MovingRounds rounds;
  for (std::size_t round = 0; round < report.repeat; ++round) {
    MovingSolidSum sum = moving_sum(motion, {});
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
      if (!progress("frames", double(i) / double(motion.frames.size()))) throw_if_interrupted();
      const SolidFrameWork work = require(sum.set(motion.frames[i].p, motion.frames[i].q));
      rounds.ms.push_back(work.ms);
      if (round + 1 < report.repeat) continue;
      const SolidFrameChanges changes = sum.changes();
      const std::uint64_t changed = changes.appeared.size() + changes.changed.size();
      rounds.changed += changed, rounds.checked += checked(work), rounds.rebuilt += work.rebuilt;
      rounds.faces = sum.sum().faces.size();
      if (i == motion.shown.value_or(motion.frames.size() - 1)) rounds.shown = sum.sum();
      if (!report.json) continue;
      Json sizes = solid_sum_json(sum.sum(), false);
      sizes.update({{"changed", changed}, {"checked", checked(work)}});
      rounds.frames.push_back(frame_json(motion.frames[i].name, std::move(sizes), work.ms));
    }
  }
  return rounds;
}

/// The median of up to five frames from scratch, evenly chosen.
double fresh_ms(const SolidMotion& motion) {
  MovingSolidOptions options;
  options.mode = FrameMode::rebuild;
  MovingSolidSum sum = moving_sum(motion, options);
  std::vector<double> ms;
  const std::size_t every = (motion.frames.size() + 4) / 5;
  for (std::size_t i = 0; i < motion.frames.size(); i += every)
    ms.push_back(require(sum.set(motion.frames[i].p, motion.frames[i].q)).ms);
  return timing_of(ms).median_ms;
}

MotionReport report_of(const SolidMotion& motion, std::size_t repeats, MovingRounds&& rounds) {
  MotionReport report;
  report.verb = motion.verb;
  for (const SolidInput& input : motion.inputs) report.files.push_back(input.file);
  report.inputs = solid_inputs_json(motion.inputs);
  report.tier = solid_tier(rounds.shown.stats.bits);
  report.repeats = repeats;
  report.frame_count = motion.frames.size();
  report.ms = std::move(rounds.ms);
  report.static_ms = fresh_ms(motion);
  report.requested = motion.requested;
  report.note = motion.note;
  report.frames = std::move(rounds.frames);
  report.work = {{"changed", rounds.changed}, {"checked", rounds.checked}};
  const auto per_frame = [&](std::uint64_t n) { return double(n) / double(motion.frames.size()); };
  std::ostringstream text;
  text << "a frame checks " << per_frame(rounds.checked) << " features and changes " << per_frame(rounds.changed)
       << " of " << counted(rounds.faces, "face") << "; " << counted(rounds.rebuilt, "frame") << " from scratch";
  report.work_text = text.str();
  report.lines = {"at " + motion.frames.back().name.pose + ": " + counted(rounds.faces, "face")};
  return report;
}

}  // namespace

ExitCode run_moving_solids(const SolidMotion& motion, const ReportOptions& report) {
  std::ostream& out = report_stream(motion.files, report.json);
  check_files(motion.files);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  MovingRounds rounds = run_rounds(motion, report, bar->callback());
  bar.reset();
  throw_if_interrupted();
  std::vector<std::string> texts;
  for (const std::string& file : motion.files) texts.push_back(solid_output(rounds.shown, file, {}));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(motion.files[i], texts[i]);
  MotionReport made = report_of(motion, report.repeat, std::move(rounds));
  print_solid_motion(out, motion, made, report.json);
  return kDone;
}

}  // namespace dymsum::cli
