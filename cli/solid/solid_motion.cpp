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
};

Rounds run(const SolidMotion& motion, const ReportOptions& report, const Progress& progress) {
  Rounds rounds;
  const std::vector<SolidFrame>& frames = motion.frames;
  const bool pictures = std::any_of(motion.files.begin(), motion.files.end(), is_page);
  for (std::size_t round = 0; round < report.repeat; ++round) {
    rounds.sum = require(ConvexSum::create(motion.inputs[0].mesh, motion.inputs[1].mesh));
    const std::size_t facets = rounds.sum->facet_count().all;
    const std::size_t most = std::clamp<std::size_t>(kMostPicturedFacets / facets, 1, kMostFramePictures);
    const std::size_t every = (frames.size() + most - 1) / most;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!progress("frames", double(i) / double(frames.size()))) throw_if_interrupted();
      const auto [work, timing] = timed(1, [&] { return rounds.sum->set(frames[i].p, frames[i].q); });
      rounds.ms.push_back(timing.median_ms);
      if (round + 1 < report.repeat) continue;
      rounds.changed += rounds.sum->facet_count().changed;
      rounds.checked += checked(work);
      if (report.json)
        rounds.frames.push_back(frame_json(frames[i].name, sizes_json(*rounds.sum, work), timing.median_ms));
      if (pictures && i % every == 0) rounds.pictures.push_back({frames[i].name.pose, rounds.sum->sum()});
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
    texts.push_back(is_page(file) ? solid_page(rounds.pictures, title)
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
    if (motion.has_events) json["events"] = solid_events_json(motion.events);
    return print_report(json);
  }
  for (std::string& line : solid_event_lines(motion.events)) report.lines.push_back(std::move(line));
  print_motion(out, report);
}

Json solid_events_json(const std::vector<SolidScaleEvent>& events) {
  constexpr const char* kKinds[] = {"vertex_on_facet", "edge_on_edge", "four_facets", "coplanar_facets"};
  Json list = Json::array();
  for (const SolidScaleEvent& e : events)
    list.push_back({{"s", e.s.to_string()},
                    {"approx", e.approx},
                    {"kind", kKinds[static_cast<std::size_t>(e.kind)]},
                    {"visible", true},
                    {"topology", e.topology}});
  return list;
}

std::vector<std::string> solid_event_lines(const std::vector<SolidScaleEvent>& events) {
  std::vector<std::string> lines;
  for (const SolidScaleEvent& e : events)
    lines.push_back("event " + shown(e.s) + (e.topology ? "  topology changes" : ""));
  return lines;
}

namespace {

/// Those between the least and the largest uniform scale of the frames, or the first that is asked for.
std::vector<SolidScaleEvent> events_of(const SolidMotion& motion, const ScaleCommand& command,
                                       const std::vector<Scale>& scales) {
  const auto [low, high] = std::minmax_element(scales.begin(), scales.end(),
                                               [](const Scale& a, const Scale& b) { return a.exact() < b.exact(); });
  const InterruptGuard guard;
  ProgressBar bar;
  const Progress progress = bar.callback();
  ScalingSolidOptions options;
  options.moving = command.scaled == "p" ? MovingOperand::p : MovingOperand::q;
  options.threads = static_cast<int>(command.threads);
  const Result<ScalingSolidSum> sum = ScalingSolidSum::create(motion.inputs[0].mesh, motion.inputs[1].mesh, options);
  if (!sum) stop_with(in_solid_operand(sum.error(), motion.inputs));
  if (command.next.empty()) {
    Result<std::vector<SolidScaleEvent>> events = sum->events(*low, *high, progress);
    throw_if_interrupted();
    return require(std::move(events));
  }
  const EventChange change = command.next == "topology" ? EventChange::topology : EventChange::visible;
  Result<std::optional<SolidScaleEvent>> first = sum->next_event(*low, *high, change, progress);
  throw_if_interrupted();
  const std::optional<SolidScaleEvent> event = require(std::move(first));
  return event ? std::vector<SolidScaleEvent>{*event} : std::vector<SolidScaleEvent>{};
}

/// One scale for all axes, or three between colons.
std::vector<Scale> scales_in(const std::string& text) {
  const std::vector<std::string> pieces = split(text, ':');
  if (pieces.size() != 1 && pieces.size() != 3) throw Stop(kUsage, "--at wants one scale or three, SX:SY:SZ: " + text);
  std::vector<Scale> scales;
  for (const std::string& piece : pieces) scales.push_back(read_scale(piece, "--at"));
  return scales;
}

}  // namespace

ExitCode run_solid_scale(const ScaleCommand& command, const std::vector<Scale>& sweep) {
  refuse_options(*command.parser, {"--copies", "--ratio", "--mode", "--semantics", "--exact"},
                 "is for planar operands");
  if (!command.events && std::none_of(command.files.begin(), command.files.end(), is_page))
    refuse_options(*command.parser, {"--threads"}, "is for planar operands, and for events");
  if (sweep.empty() == command.at.empty()) throw Stop(kUsage, "give one of --sweep and --at");
  SolidMotion motion{"scale", read_solids(command.operands, command.input), {}, command.files, {}, "", command.frame};
  std::vector<Scale> uniform;
  const auto add = [&](const std::vector<Scale>& s) {
    if (s.size() == 1 || (s[0] == s[1] && s[1] == s[2])) uniform.push_back(s[0]);
    SolidFrame frame;
    (command.scaled == "p" ? frame.p : frame.q).scale = {s.front(), s[s.size() / 2], s.back()};
    frame.name = frame_name(s);
    frame.scale = s[0].approx();
    motion.frames.push_back(frame);
  };
  for (const Scale& s : sweep) add({s});
  for (const std::string& text : listed(command.at)) add(scales_in(text));
  if (command.robot) motion.inputs[1].mesh = negated(motion.inputs[1].mesh);
  motion.asked = {{"scaled", command.scaled}, {"robot", command.robot}};
  const bool is_uniform = uniform.size() == motion.frames.size();
  if (command.events && !is_uniform) throw Stop(kUsage, "--events wants the same scale along all axes");
  motion.has_events = command.events, motion.has_scale = is_uniform;
  const bool page = std::any_of(command.files.begin(), command.files.end(), is_page);
  const bool thin = motion.inputs[0].mesh.has_thin_parts() || motion.inputs[1].mesh.has_thin_parts();
  if (command.events || (page && is_uniform && !thin)) motion.events = events_of(motion, command, uniform);
  const ExitCode code = run_solid_motion(motion, command.report);
  return code == kDone && !command.next.empty() && motion.events.empty() ? kNo : code;
}

}  // namespace dymsum::cli
