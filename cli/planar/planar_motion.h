// Frames of a planar sum that moves, made one after the other, timed, counted and pictured: what scale and rotate do
// with planar operands.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/frames.h"
#include "inputs.h"
#include "motion_report.h"
#include "options.h"
#include "pictures/frame_pictures.h"
#include "progress_bar.h"
#include "report.h"

namespace dymsum::cli {

/// A frame to be made. `Position` is what the sum moves to.
template <class Position>
struct PlanarFrame {
  Position position;
  FrameName name;
  std::string caption;  ///< of its picture
};

/// How often each kind of work was done in the frames.
struct FrameCounts {
  std::uint64_t lists_changed = 0, degenerate = 0, windows = 0, rebuilt = 0;
  void add(const FrameWork& work) {
    lists_changed += work.lists_changed;
    degenerate += work.degenerate;
    windows += work.new_window;
    rebuilt += work.rebuilt;
  }
  Json json() const {
    return {{"lists_changed", lists_changed},
            {"degenerate_frames", degenerate},
            {"windows", windows},
            {"rebuilt", rebuilt}};
  }
  std::string text() const {
    return counted(windows, "window") + ", " + counted(rebuilt, "frame") + " from scratch, " +
           counted(degenerate, "frame") + " at which something touches";
  }
};

/// All rounds: the times of every frame; of the last round its work, frames and pictures.
template <class Sum>
struct PlanarMotion {
  std::optional<Sum> sum;  ///< at the last frame
  std::vector<double> ms;
  int tier = 0;
  FrameCounts work;
  Json frames = Json::array();
  std::vector<PicturedFrame> pictures;
};

/// Makes the frames `report.repeat` times. `make` returns a fresh sum, `move(sum, position)` moves it.
template <class Sum, class Position, class Make, class Move>
PlanarMotion<Sum> run_planar_motion(const std::vector<PlanarFrame<Position>>& frames, const ReportOptions& report,
                                    const std::vector<std::string>& files, const Progress& progress, Make&& make,
                                    Move&& move) {
  PlanarMotion<Sum> motion;
  const std::size_t every = picture_step(frames.size(), files);
  for (std::size_t round = 0; round < report.repeat; ++round) {
    motion.sum = make();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!progress("frames", double(i) / double(frames.size()))) throw_if_interrupted();
      move(*motion.sum, frames[i].position);
      const FrameWork& work = motion.sum->work();
      motion.ms.push_back(work.ms);
      motion.tier = std::max(motion.tier, motion.sum->sum().stats.tier_bits);
      if (round + 1 < report.repeat) continue;
      motion.work.add(work);
      if (report.json)
        motion.frames.push_back(frame_json(frames[i].name, size_json(motion.sum->sum(), report.exact), work.ms));
      if (every > 0 && i % every == 0) motion.pictures.push_back({frames[i].caption, drawn(motion.sum->sum())});
    }
  }
  return motion;
}

/// The median of fresh computations at a few of the frames. `make` returns a fresh sum that computes every frame from
/// scratch, `move(sum, position)` moves it there unless that is where it was made.
template <class Position, class Make, class Move>
double planar_static_ms(const std::vector<PlanarFrame<Position>>& frames, std::size_t repeat, Make&& make,
                        Move&& move) {
  std::vector<double> ms;
  for (const std::size_t i : {std::size_t{0}, frames.size() / 3, frames.size() / 2, frames.size() - 1})
    for (std::size_t k = 0; k < repeat; ++k) {
      auto fresh = make();
      move(fresh, frames[i].position);
      ms.push_back(fresh.work().ms);
    }
  return timing_of(ms).median_ms;
}

/// What all planar motions report alike.
template <class Sum, class Position>
MotionReport planar_motion_report(const std::string& verb, const std::vector<Input>& inputs, std::size_t repeats,
                                  const std::vector<PlanarFrame<Position>>& frames, PlanarMotion<Sum>&& motion) {
  MotionReport report;
  report.verb = verb;
  for (const Input& input : inputs) report.files.push_back(input.file);
  report.inputs = inputs_json(inputs);
  report.tier = motion.tier;
  report.repeats = repeats;
  report.frame_count = frames.size();
  report.ms = std::move(motion.ms);
  report.frames = std::move(motion.frames);
  report.work = motion.work.json();
  report.work_text = motion.work.text();
  const PlanarSum& last = motion.sum->sum();
  report.lines = {"at " + frames.back().name.pose + ": " + counted(last.parts.size(), "part") + ", " +
                  counted(last.hole_count(), "hole") + ", " + counted(last.vertex_count(), "vertex", "vertices")};
  return report;
}

}  // namespace dymsum::cli
