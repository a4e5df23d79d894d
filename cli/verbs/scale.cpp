// dymsum scale P Q --sweep A:B:STEP | --at s,s,... | --copies FILE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "dymsum/scaling_sum.h"
#include "memory_limit.h"
#include "numbers.h"
#include "planar/planar_motion.h"
#include "solid/solid_limits.h"
#include "solid/solid_motion.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"
#include "verbs/scale_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

constexpr std::size_t kMostFrames = 1000000;

/// A:B:STEP with an exact step to add, or A:B:N% with a ratio of 1 + N/100.
std::vector<Scale> sweep_scales(const std::string& text) {
  const std::size_t first = text.find(':'), second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos) throw Stop(kUsage, "--sweep wants FROM:TO:STEP, such as 0.5:2:0.01 or 1:2:1%");
  std::string step = text.substr(second + 1);
  const bool ratio = step.ends_with('%');
  if (ratio) step.pop_back();
  const Scale from = read_scale(text.substr(0, first), "--sweep"),
              to = read_scale(text.substr(first + 1, second - first - 1), "--sweep");
  return require_option(scale_steps(from, to, require_option(parse_scale_step(step), "--sweep"),
                                    ratio ? StepKind::percent : StepKind::difference, kMostFrames),
                        "--sweep");
}

/// diag(x, y).
struct AxisScales {
  Scale x, y;
  bool uniform() const { return x == y; }
};

/// diag(s, R s) with --ratio R, else s for both axes.
AxisScales with_ratio(const Scale& s, const ScaleCommand& command) {
  if (command.ratio.empty()) return {s, s};
  const Scale ratio = read_scale(command.ratio, "--ratio");
  return {s, require_option(Scale::of(s.exact() * ratio.exact()), "--ratio")};
}

AxisScales axis_scales(const std::string& text, const ScaleCommand& command) {
  const std::vector<std::string> pieces = split(text, ':');
  if (pieces.size() == 1) return with_ratio(read_scale(text, "--at"), command);
  if (pieces.size() != 2) throw Stop(kUsage, "--at wants one scale or two, SX:SY: " + text);
  if (!command.ratio.empty()) throw Stop(kUsage, "--ratio does not apply to --at SX:SY: " + text);
  return {read_scale(pieces[0], "--at"), read_scale(pieces[1], "--at")};
}

std::vector<AxisScales> scales_of(const ScaleCommand& command) {
  if (command.sweep.empty() == command.at.empty()) throw Stop(kUsage, "give one of --sweep, --at and --copies");
  std::vector<AxisScales> scales;
  if (!command.sweep.empty())
    for (const Scale& s : sweep_scales(command.sweep)) scales.push_back(with_ratio(s, command));
  for (const std::string& s : listed(command.at)) scales.push_back(axis_scales(s, command));
  check_frame_pictures(command.files);
  return scales;
}

Json events_json(const std::vector<ScaleEvent>& events) {
  Json list = Json::array();
  for (const ScaleEvent& e : events) list.push_back(event_json(e));
  return list;
}

/// Pictures have the exact scale as a caption, or its digits where that is long.
std::vector<PlanarFrame<AxisScales>> frames_at(const std::vector<AxisScales>& scales) {
  const auto caption = [](const Scale& s) {
    const std::string exact = shown(s.exact());
    return exact.size() > 14 ? number(s.approx()) : exact;
  };
  std::vector<PlanarFrame<AxisScales>> frames;
  for (const AxisScales& s : scales)
    frames.push_back({s, s.uniform() ? frame_name({s.x}) : frame_name({s.x, s.y}),
                      "s = " + caption(s.x) + (s.uniform() ? "" : ":" + caption(s.y))});
  return frames;
}

/// Those that were requested, or none. Requires, where they were: uniform scales.
std::vector<ScaleEvent> events_of(const ScalingSum& sum, const ScaleCommand& command,
                                  const std::vector<AxisScales>& scales, const Progress& progress) {
  if (!command.events) return {};
  const auto [low, high] =
      std::minmax_element(scales.begin(), scales.end(),
                          [](const AxisScales& a, const AxisScales& b) { return a.x.approx() < b.x.approx(); });
  if (!command.next.empty()) {
    const EventChange change = named<EventChange>(command.next);
    const std::optional<ScaleEvent> first = require(sum.next_event(low->x, high->x, change, progress));
    return first ? std::vector<ScaleEvent>{*first} : std::vector<ScaleEvent>{};
  }
  return require(sum.events(low->x, high->x, progress));
}

void set_scales(ScalingSum& sum, const AxisScales& s) { require(s.uniform() ? sum.set(s.x) : sum.set(s.x, s.y)); }

std::vector<std::string> event_lines(const std::vector<ScaleEvent>& events) {
  std::vector<std::string> lines;
  for (const ScaleEvent& e : events)
    if (e.visible) lines.push_back(event_line(e));
  return lines;
}

ScalingSum scaling_sum(const std::vector<Input>& inputs, const MovingOptions& options) {
  return require_of(inputs, ScalingSum::create(inputs[0].region, inputs[1].region, options));
}

ExitCode run_planar_scale(const ScaleCommand& command) {
  const std::vector<AxisScales> scales = scales_of(command);
  if (command.events && !std::all_of(scales.begin(), scales.end(), [](const AxisScales& s) { return s.uniform(); }))
    throw Stop(kUsage, "--events wants the same scale along both axes");
  const std::vector<PlanarFrame<AxisScales>> frames = frames_at(scales);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  MovingOptions options = scaling_options(command);
  options.threads = static_cast<int>(command.threads);
  auto motion = run_planar_motion<ScalingSum>(
      frames, command.report, command.files, progress, [&] { return scaling_sum(inputs, options); }, set_scales);
  const std::vector<ScaleEvent> events = events_of(*motion.sum, command, scales, progress);
  options.mode = FrameMode::rebuild;
  const double static_ms = planar_static_ms(
      frames, command.report.repeat, [&] { return scaling_sum(inputs, options); },
      [](ScalingSum& sum, const AxisScales& s) {
        if (!(s.uniform() && s.x == sum.scale())) set_scales(sum, s);
      });
  bar.reset();
  write_frame_pictures(command.files, motion.pictures);
  MotionReport report = planar_motion_report("scale", inputs, command.report.repeat, frames, std::move(motion));
  report.static_ms = static_ms;
  report.requested = {{"semantics", command.semantics}, {"scaled", command.scaled}, {"robot", command.robot}};
  if (command.report.json) {
    Json json = motion_json(report);
    json["events"] = command.events ? events_json(events) : Json(nullptr);
    print_report(json);
    return !command.next.empty() && events.empty() ? kNo : kDone;
  }
  if (command.events)
    for (std::string& line : event_lines(events)) report.lines.push_back(std::move(line));
  print_motion(std::cout, report);
  return !command.next.empty() && events.empty() ? kNo : kDone;
}

/// --range as frames at both ends and their events.
void take_range(ScaleCommand& command) {
  if (command.range.empty()) {
    if (!command.next.empty()) throw Stop(kUsage, "--next wants --range A:B");
    return;
  }
  if (!command.sweep.empty() || !command.at.empty() || !command.copies.empty() || !command.ratio.empty())
    throw Stop(kUsage, "--range takes the place of --sweep, --at, --copies and --ratio");
  const std::vector<std::string> ends = split(command.range, ':');
  if (ends.size() != 2) throw Stop(kUsage, "--range wants A:B, such as 1:3/2, not '" + command.range + "'");
  const Scale low = read_scale(ends[0], "--range"), high = read_scale(ends[1], "--range");
  if (low.exact() > high.exact()) throw Stop(kUsage, "--range begins after its end: " + command.range);
  command.at = {ends[0], ends[1]}, command.events = true;
}

ExitCode run_scale(ScaleCommand command) {
  limit_memory(command.memory_mb);
  take_range(command);
  if (are_solid(command.operands, command.input))
    return run_solid_scale(command, command.sweep.empty() ? std::vector<Scale>{} : sweep_scales(command.sweep));
  refuse_options(*command.parser, {"--frame"}, "is for solid operands");
  return command.copies.empty() ? run_planar_scale(command) : run_copies(command);
}

void add_options(CLI::App& verb, ScaleCommand& command) {
  command.parser = &verb;
  add_operands(verb, {"P", "The region or solid that scales, unless --scaled q"}, {"Q", "The other one"},
               command.operands);
  verb.add_option("--sweep", command.sweep,
                  "FROM:TO:STEP; STEP is added, or with % multiplies: 1:2:1%; the last frame is at TO")
      ->type_name("A:B:STEP");
  verb.add_option("--at", command.at,
                  "Scales between commas, exact: 3/2, 1.01, 1e-3; or one per axis: 2:1, of solids 2:1:1/2; repeatable")
      ->type_name("S,S,...")
      ->allow_extra_args(false);
  verb.add_option("--ratio", command.ratio, "Planar: y scales by R times as much as x, diag(s, R s); exact")
      ->type_name("R");
  verb.add_option("--copies", command.copies,
                  "Planar: copies of P, one `scale x y` a line: the sum of each with Q, from one sum that scales")
      ->type_name("FILE");
  verb.add_flag("--robot", command.robot, "Q is a robot and P an obstacle: sums with -Q");
  one_of<MovingOperand>(verb.add_option("--scaled", command.scaled, "Which operand scales"))->capture_default_str();
  one_of<FrameMode>(
      verb.add_option("--mode", command.mode,
                      "Planar: automatic chooses between the others by their cost; all give the same sums"))
      ->capture_default_str();
  add_threads_option(verb, command.threads);
  add_memory_limit(verb, command.memory_mb);
  one_of<Semantics>(verb.add_option("--semantics", command.semantics, "Planar: closed, open or regular"))
      ->capture_default_str();
  verb.add_option(
          "-o", command.files,
          "Write .svg (a film strip), anim.svg (an animation) or .html (the viewer); with --copies .svg alone "
          "(obstacles, what they grow to, robot); of solids .html, and a frame as .off .obj .stl .ply .3mf .glb "
          ".json; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  whole_within(verb.add_option("--frame", command.frame, "Of solids: the frame that meshes are of, from 0 [the last]"),
               0, 1000000000)
      ->type_name("N");
  verb.add_flag("--events", command.events, "List the exact scales at which the sum changes");
  verb.add_option("--range", command.range, "Events of these scales, with frames at both ends")->type_name("A:B");
  one_of<EventChange>(verb.add_option(
      "--next", command.next,
      "With --range: only the first event after A that is visible, or changes the topology; exit code 4 if "
      "there is none"));
  add_report_options(verb, command.report, "Sweep N times and report the median and minimum frame");
  add_exact_option(verb, command.report, OperandKind::planar);
  add_solid_input_options(verb, command.input, OperandKind::either, Hulls::of_results_too);
}

}  // namespace

std::vector<std::string> listed(const std::vector<std::string>& values) {
  std::vector<std::string> all;
  for (const std::string& value : values)
    for (std::string& piece : split(value, ',')) all.push_back(std::move(piece));
  return all;
}

Scale read_scale(const std::string& text, const std::string& option) {
  return require_option(Scale::parse(text), option);
}

MovingOptions scaling_options(const ScaleCommand& command) {
  MovingOptions options;
  options.moving = named<MovingOperand>(command.scaled);
  options.reflect_q = command.robot;
  options.mode = named<FrameMode>(command.mode);
  options.semantics = named<Semantics>(command.semantics);
  options.memory = memory_bytes(command.memory_mb);
  return options;
}

void add_scale(CLI::App& app, Action& action) {
  auto command = std::make_shared<ScaleCommand>();
  CLI::App& verb = *app.add_subcommand("scale", "s P (+) Q, frame by frame, exact at every scale");
  add_options(verb, *command);
  verb.footer(
      "Examples: dymsum scale plate.wkt star.wkt --sweep 1:2:1% --json -o frames.svg\n"
      "          dymsum scale plate.wkt star.wkt --sweep 1:2:0.1% --threads 2\n"
      "          dymsum scale plate.wkt star.wkt --sweep 1:2:1% --ratio 2/3\n"
      "          dymsum scale block.off peg.off --range 1/2:2 --next topology");
  verb.callback([command, &action] {
    action = [command]() -> ExitCode {
      const InterruptGuard guard;
      if (!command->copies.empty()) return run_scale(*command);
      return run_with_pages({command->parser, "sum", "solids"}, command->operands, command->input, command->files,
                            [command] { return run_scale(*command); });
    };
  });
}

}  // namespace dymsum::cli
