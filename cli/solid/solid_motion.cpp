#include "solid/solid_motion.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "outputs.h"
#include "pictures/frame_pictures.h"
#include "pictures/solid_page.h"
#include "progress_bar.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

/// Pictures show every frame, of a long or large motion evenly chosen ones.
constexpr std::size_t kMostPictures = 240, kMostPicturedFacets = 150000;

void check_outputs(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!is_page(file)) check_solid_outputs({file}, {}, ".html, and the last frame as ");
}

Json frame_json(const ConvexSum& sum, const std::string& label, double ms) {
  const MotionWork& w = sum.work();
  const ConvexSum::FacetCount facets = sum.facet_count();
  return {{"pose", label},
          {"faces", facets.all},
          {"volume_exact", sum.volume_exact().to_string()},
          {"changed", facets.changed},
          {"checked", w.vertex_checks + w.crossing_checks + w.arc_checks},
          {"update_ms", ms}};
}

struct Motion {
  std::optional<ConvexSum> sum;
  std::vector<double> ms;
  std::uint64_t changed = 0, checked = 0;
  Json frames = Json::array();
  std::vector<SolidPicture> pictures;
};

Motion run(const std::vector<SolidInput>& inputs, const std::vector<SolidFramePose>& poses, bool pictures,
           const ReportOptions& report, const Progress& progress) {
  Motion motion;
  for (std::size_t round = 0; round < report.repeat; ++round) {
    motion.sum = require(ConvexSum::create(inputs[0].mesh, inputs[1].mesh));
    const std::size_t facets = motion.sum->facet_count().all;
    const std::size_t most = std::clamp<std::size_t>(kMostPicturedFacets / facets, 1, kMostPictures);
    const std::size_t every = (poses.size() + most - 1) / most;
    const bool last = round + 1 == report.repeat;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!progress("frames", double(i) / double(poses.size()))) throw_if_interrupted();
      const auto [work, timing] = timed(1, [&] { return motion.sum->set(poses[i].p, poses[i].q); });
      motion.ms.push_back(timing.median_ms);
      if (!last) continue;
      motion.changed += motion.sum->facet_count().changed;
      motion.checked += work.vertex_checks + work.crossing_checks + work.arc_checks;
      if (report.json) motion.frames.push_back(frame_json(*motion.sum, poses[i].label, timing.median_ms));
      if (pictures && i % every == 0) motion.pictures.push_back({poses[i].label, motion.sum->sum()});
    }
  }
  return motion;
}

double static_ms(const ConvexSum& sum) {
  ConvexSum fresh = sum;
  return timed(9, [&] { return fresh.rebuild(); }).second.median_ms;
}

}  // namespace

ExitCode run_solid_motion(const std::string& verb, const std::vector<SolidInput>& inputs,
                          const std::vector<SolidFramePose>& poses, const std::vector<std::string>& files,
                          const ReportOptions& report) {
  std::ostream& out = report_stream(files, report.json);
  check_outputs(files);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const bool pictures = std::any_of(files.begin(), files.end(), is_page);
  const Motion motion = run(inputs, poses, pictures, report, bar->callback());
  bar.reset();
  throw_if_interrupted();
  std::vector<std::string> texts;
  for (const std::string& file : files)
    texts.push_back(is_page(file)
                        ? solid_page(motion.pictures, verb + " of " + inputs[0].file + " and " + inputs[1].file)
                        : solid_output(motion.sum->sum(), file, {"off", inputs[0].hull.has_value(), false}));
  for (std::size_t i = 0; i < files.size(); ++i) write_text(files[i], texts[i]);
  const Timing timing = timing_of(motion.ms);
  const double fresh = static_ms(*motion.sum);
  if (report.json) {
    Json json =
        report_head(verb, solid_inputs_json(inputs), motion.sum->tier_bits(), timing, {{"frames", timing.median_ms}});
    json["repeats"] = report.repeat;
    json.update({{"frames", motion.frames},
                 {"static_ms", fresh},
                 {"update_ms", timing.median_ms},
                 {"work", {{"changed", motion.changed}, {"checked", motion.checked}}}});
    print_report(json);
    return kDone;
  }
  const auto per_frame = [&](std::uint64_t n) { return double(n) / double(poses.size()); };
  out << verb << " of " << inputs[0].file << " and " << inputs[1].file << ", " << counted(poses.size(), "frame")
      << "\n  update " << timing.median_ms << " ms (median, least " << timing.min_ms << " ms), from scratch " << fresh
      << " ms\n  a frame checks " << per_frame(motion.checked) << " features and changes " << per_frame(motion.changed)
      << " of " << motion.sum->facet_count().all << " facets\n";
  return kDone;
}

ExitCode run_solid_scale(const ScaleCommand& command, const std::vector<Scale>& sweep) {
  refuse_options(*command.parser, {"--copies", "--events", "--mode", "--semantics", "--exact"},
                 "is for planar operands");
  if (sweep.empty() == command.at.empty()) throw Stop(kUsage, "give one of --sweep and --at");
  const std::vector<SolidInput> inputs = read_convex_solids(command.operands, command.input);
  std::vector<SolidFramePose> poses;
  const auto add = [&](const std::array<Scale, 3>& s, const std::string& label) {
    SolidFramePose pose;
    (command.scaled == "p" ? pose.p : pose.q).scale = s;
    pose.label = label;
    poses.push_back(pose);
  };
  for (const Scale& s : sweep) add({s, s, s}, "s = " + shown(s.exact()));
  for (const std::string& text : listed(command.at)) {
    const std::size_t a = text.find(':'), b = a == std::string::npos ? a : text.find(':', a + 1);
    if (a == std::string::npos) {
      const Scale s = read_scale(text, "--at");
      add({s, s, s}, "s = " + text);
    } else if (b == std::string::npos) {
      throw Stop(kUsage, "--at wants one scale or three, SX:SY:SZ: " + text);
    } else {
      add({read_scale(text.substr(0, a), "--at"), read_scale(text.substr(a + 1, b - a - 1), "--at"),
           read_scale(text.substr(b + 1), "--at")},
          "s = " + text);
    }
  }
  std::vector<SolidInput> operands = inputs;
  if (command.robot) operands[1].mesh = negated(operands[1].mesh);
  return run_solid_motion("scale", operands, poses, command.files, command.report);
}

}  // namespace dymsum::cli
