#include "planar/planar_turn.h"

#include <iostream>
#include <optional>

#include "dymsum/rotating_sum.h"
#include "pictures/frame_pictures.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

/// The exact orientation of a frame.
struct Pose {
  Orientation theta;
  std::string caption;
};

std::vector<Pose> poses_of(const PlanarTurn& turn) {
  std::vector<Pose> poses;
  for (const Angle& angle : turn.angles)
    poses.push_back({require_option(Orientation::nearest(angle.radians(), turn.error), "--error"), angle.label()});
  return poses;
}

RotatingOptions rotating_options(const PlanarTurn& turn, FrameMode mode) {
  RotatingOptions options;
  options.semantics = turn.semantics == "open"      ? Semantics::open
                      : turn.semantics == "regular" ? Semantics::regular
                                                    : Semantics::closed;
  options.mode = mode;
  return options;
}

Json frame_json(const PlanarSum& sum, const Pose& pose, double ms, bool exact) {
  Json json = {{"theta", pose.theta.radians()}, {"tan_half", orientation_json(pose.theta)["tan_half"]}};
  json.update(size_json(sum, exact));
  json["update_ms"] = ms;
  return json;
}

struct Turned {
  std::vector<double> ms;
  int tier = 0;
  std::uint64_t windows = 0, rebuilt = 0, degenerate = 0;
  Json frames = Json::array();
  std::vector<PicturedFrame> pictures;
};

Turned run_frames(const PlanarTurn& turn, const std::vector<Input>& inputs, const std::vector<Pose>& poses,
                  const Progress& progress) {
  Turned turned;
  const std::size_t every = picture_step(poses.size(), turn.files);
  for (std::size_t round = 0; round < turn.report.repeat; ++round) {
    RotatingSum sum =
        require(RotatingSum::create(inputs[0].region, inputs[1].region, rotating_options(turn, FrameMode::automatic)));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!progress("frames", double(i) / double(poses.size()))) throw_if_interrupted();
      // The sum was made at zero: a frame there is that one, with its time.
      if (!(sum.orientation() == poses[i].theta)) require(sum.set(poses[i].theta));
      const FrameWork& work = sum.work();
      turned.ms.push_back(work.ms);
      turned.tier = std::max(turned.tier, sum.sum().stats.tier_bits);
      if (round + 1 < turn.report.repeat) continue;
      turned.windows += work.new_window;
      turned.rebuilt += work.rebuilt;
      turned.degenerate += work.degenerate;
      if (turn.report.json) turned.frames.push_back(frame_json(sum.sum(), poses[i], work.ms, turn.report.exact));
      if (every > 0 && i % every == 0)
        turned.pictures.push_back({turn.angles[i].value, poses[i].caption, drawn(sum.sum())});
    }
  }
  return turned;
}

/// A fresh computation at a few of the orientations.
double static_ms(const PlanarTurn& turn, const std::vector<Input>& inputs, const std::vector<Pose>& poses) {
  RotatingSum fresh =
      require(RotatingSum::create(inputs[0].region, inputs[1].region, rotating_options(turn, FrameMode::rebuild)));
  std::vector<double> ms;
  for (const std::size_t i : {std::size_t{0}, poses.size() / 3, poses.size() / 2, poses.size() - 1})
    for (std::size_t k = 0; k < turn.report.repeat; ++k) {
      require(fresh.set(poses[i].theta));
      ms.push_back(fresh.work().ms);
    }
  return timing_of(ms).median_ms;
}

}  // namespace

ExitCode run_planar_turn(const PlanarTurn& turn) {
  check_frame_pictures(turn.files);
  const std::vector<Pose> poses = poses_of(turn);
  const std::vector<Input> inputs = read_inputs(turn.operands, turn.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Turned turned = run_frames(turn, inputs, poses, bar->callback());
  const double fresh_ms = static_ms(turn, inputs, poses);
  bar.reset();
  throw_if_interrupted();
  const std::string title = inputs[0].file + " turns, " + inputs[1].file + " stays";
  write_frame_pictures(turn.files, turned.pictures, {}, title);
  const Timing timing = timing_of(turned.ms);
  if (turn.report.json) {
    Json json = report_head("rotate", inputs_json(inputs), turned.tier, timing, {{"frames", timing.median_ms}});
    json["repeats"] = turn.report.repeat;
    json.update(
        {{"semantics", turn.semantics},
         {"angle_error", turn.error},
         {"frames", turned.frames},
         {"static_ms", fresh_ms},
         {"update_ms", timing.median_ms},
         {"work",
          {{"degenerate_frames", turned.degenerate}, {"windows", turned.windows}, {"rebuilt", turned.rebuilt}}}});
    print_report(json);
    return kDone;
  }
  std::cout << "rotate of " << inputs[0].file << " and " << inputs[1].file << ", " << counted(poses.size(), "frame")
            << ", each exact at an orientation within " << turn.error << " of its angle\n  frame " << timing.median_ms
            << " ms (median, least " << timing.min_ms << " ms), from scratch " << fresh_ms << " ms\n  "
            << counted(turned.windows, "window") << ", " << counted(turned.rebuilt, "frame") << " from scratch, "
            << counted(turned.degenerate, "frame") << " of them where something touches or nearly does\n";
  return kDone;
}

}  // namespace dymsum::cli
