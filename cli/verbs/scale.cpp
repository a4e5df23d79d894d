// dymsum scale P Q --sweep A:B:STEP | --at s,s,... | --copies FILE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "dymsum/scaling_sum.h"
#include "outputs.h"
#include "pictures/frame_pictures.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_motion.h"
#include "solid/solid_operands.h"
#include "timing.h"
#include "verbs/commands.h"
#include "verbs/scale_command.h"

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

std::vector<Scale> scales_of(const ScaleCommand& command) {
  if (command.sweep.empty() == command.at.empty()) throw Stop(kUsage, "give one of --sweep, --at and --copies");
  std::vector<Scale> scales;
  if (!command.sweep.empty()) scales = sweep_scales(command.sweep);
  for (const std::string& s : listed(command.at)) scales.push_back(read_scale(s, "--at"));
  check_frame_pictures(command.files);
  return scales;
}

Json events_json(const std::vector<ScaleEvent>& events) {
  Json list = Json::array();
  for (const ScaleEvent& e : events)
    list.push_back({{"s", e.s.to_string()},
                    {"approx", e.approx},
                    {"kind", e.kind == ScaleEvent::Kind::three_segments ? "three_segments" : "vertex_on_segment"},
                    {"visible", e.visible},
                    {"topology", e.topology}});
  return list;
}

Json frame_json(const ScalingSum& sum, bool exact) {
  Json json = {{"s", sum.scale().exact().to_string()}};
  json.update(size_json(sum.sum(), exact));
  json["update_ms"] = sum.work().ms;
  return json;
}

/// A fresh computation at a few of the scales.
double static_ms(const Region& p, const Region& q, const ScaleCommand& command, const std::vector<Scale>& scales) {
  ScalingOptions options = scaling_options(command);
  options.mode = FrameMode::rebuild;
  ScalingSum fresh = require(ScalingSum::create(p, q, options));
  std::vector<double> ms;
  for (const std::size_t i : {std::size_t{0}, scales.size() / 2, scales.size() - 1})
    for (std::size_t k = 0; k < command.report.repeat; ++k) {
      require(fresh.set(scales[i]));
      ms.push_back(fresh.work().ms);
    }
  return timing_of(ms).median_ms;
}

/// The exact scale, or its digits where that is long.
PicturedFrame pictured(const ScalingSum& sum) {
  std::string label = shown(sum.scale().exact());
  if (label.size() > 14) label = number(sum.scale().approx());
  return {sum.scale().approx(), "s = " + label, drawn(sum.sum())};
}

std::vector<PicturedTick> ticks_of(const std::vector<ScaleEvent>& events) {
  std::vector<PicturedTick> ticks;
  for (const ScaleEvent& e : events)
    if (e.visible) ticks.push_back({e.approx, "s = " + shown(e.s).substr(0, 60), e.topology});
  return ticks;
}

/// All rounds of a sweep: times of every frame; the last round's work, frames and pictures.
struct Sweep {
  std::optional<ScalingSum> sum;  ///< at the last scale
  std::vector<double> ms;
  int tier = 0;
  std::uint64_t lists_changed = 0, degenerate = 0, windows = 0, rebuilt = 0;
  Json frames = Json::array();
  std::vector<PicturedFrame> pictures;
};

void keep(Sweep& sweep, const ScaleCommand& command, bool picture) {
  const FrameWork& work = sweep.sum->work();
  sweep.lists_changed += work.lists_changed;
  sweep.degenerate += work.degenerate;
  sweep.windows += work.new_window;
  sweep.rebuilt += work.rebuilt;
  if (picture) sweep.pictures.push_back(pictured(*sweep.sum));
  if (command.report.json) sweep.frames.push_back(frame_json(*sweep.sum, command.report.exact));
}

Sweep run_sweep(const Region& p, const Region& q, const ScaleCommand& command, const std::vector<Scale>& scales,
                const Progress& progress) {
  Sweep sweep;
  const std::size_t every = picture_step(scales.size(), command.files);
  for (std::size_t round = 0; round < command.report.repeat; ++round) {
    sweep.sum = require(ScalingSum::create(p, q, scaling_options(command)));
    for (std::size_t i = 0; i < scales.size(); ++i) {
      if (!progress("frames", double(i) / double(scales.size()))) throw_if_interrupted();
      require(sweep.sum->set(scales[i]));
      sweep.ms.push_back(sweep.sum->work().ms);
      sweep.tier = std::max(sweep.tier, sweep.sum->sum().stats.tier_bits);
      if (round + 1 == command.report.repeat) keep(sweep, command, every > 0 && i % every == 0);
    }
  }
  return sweep;
}

std::vector<ScaleEvent> events_of(const Sweep& sweep, const ScaleCommand& command, const std::vector<Scale>& scales,
                                  const Progress& progress) {
  if (!command.events && std::none_of(command.files.begin(), command.files.end(), is_page)) return {};
  const auto [low, high] = std::minmax_element(scales.begin(), scales.end(),
                                               [](const Scale& a, const Scale& b) { return a.approx() < b.approx(); });
  return require(sweep.sum->events(*low, *high, progress));
}

void print_json(const Sweep& sweep, const std::vector<ScaleEvent>& events, double fresh_ms,
                const std::vector<Input>& inputs, const ScaleCommand& command) {
  const Timing timing = timing_of(sweep.ms);
  const Json list = command.events ? events_json(events) : Json(nullptr);
  Json json = report_head("scale", inputs_json(inputs), sweep.tier, timing, {{"frames", timing.median_ms}});
  json["repeats"] = command.report.repeat;
  json.update({{"semantics", command.semantics},
               {"scaled", command.scaled},
               {"robot", command.robot},
               {"frames", sweep.frames},
               {"static_ms", fresh_ms},
               {"update_ms", timing.median_ms},
               {"work",
                {{"lists_changed", sweep.lists_changed},
                 {"degenerate_frames", sweep.degenerate},
                 {"windows", sweep.windows},
                 {"rebuilt", sweep.rebuilt}}},
               {"events", list}});
  print_report(json);
}

void print_text(const Sweep& sweep, const std::vector<ScaleEvent>& events, double fresh_ms,
                const std::vector<Input>& inputs, const ScaleCommand& command, std::size_t frames) {
  const Timing timing = timing_of(sweep.ms);
  const PlanarSum& last = sweep.sum->sum();
  std::cout << "scale of " << inputs[0].file << " and " << inputs[1].file << ", " << counted(frames, "frame")
            << "\n  frame " << timing.median_ms << " ms (median, least " << timing.min_ms << " ms), from scratch "
            << fresh_ms << " ms\n  " << counted(sweep.windows, "window") << ", " << counted(sweep.rebuilt, "frame")
            << " from scratch, " << counted(sweep.degenerate, "frame")
            << " at which something touches\n  at s = " << shown(sweep.sum->scale().exact()) << ": "
            << counted(last.parts.size(), "part") << ", " << counted(last.hole_count(), "hole") << ", "
            << counted(last.vertex_count(), "vertex", "vertices") << "\n";
  for (const ScaleEvent& e : events)
    if (e.visible && command.events)
      std::cout << "  event " << shown(e.s) << (e.topology ? "  topology changes" : "") << "\n";
}

ExitCode run_scale(const ScaleCommand& command) {
  if (are_solid(command.operands, command.input))
    return run_solid_scale(command, command.sweep.empty() ? std::vector<Scale>{} : sweep_scales(command.sweep));
  if (!command.copies.empty()) return run_copies(command);
  const std::vector<Scale> scales = scales_of(command);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const Region &p = inputs[0].region, &q = inputs[1].region;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  const Sweep sweep = run_sweep(p, q, command, scales, progress);
  const std::vector<ScaleEvent> events = events_of(sweep, command, scales, progress);
  const double fresh_ms = static_ms(p, q, command, scales);
  bar.reset();
  const std::string title = inputs[0].file + " and " + inputs[1].file + ", " + command.scaled + " scales";
  write_frame_pictures(command.files, sweep.pictures, ticks_of(events), title);
  if (command.report.json) print_json(sweep, events, fresh_ms, inputs, command);
  else print_text(sweep, events, fresh_ms, inputs, command, scales.size());
  return kDone;
}

void add_options(CLI::App& verb, ScaleCommand& command) {
  command.parser = &verb;
  add_operands(verb, {"P", "The region or convex solid that scales, unless --scaled q"}, {"Q", "The other one"},
               command.operands);
  verb.add_option("--sweep", command.sweep,
                  "FROM:TO:STEP; STEP is added, or with % multiplies: 1:2:1%; the last frame is at TO")
      ->type_name("A:B:STEP");
  verb.add_option("--at", command.at,
                  "Scales between commas, exact: 3/2, 1.01, 1e-3; of solids also one per axis: 2:1:1/2; repeatable")
      ->type_name("S,S,...")
      ->allow_extra_args(false);
  verb.add_option("--copies", command.copies,
                  "Copies of P, one `scale x y` a line: the sum of each with Q, from one sum that scales")
      ->type_name("FILE");
  verb.add_flag("--robot", command.robot, "Q is a robot and P an obstacle: sums with -Q");
  verb.add_option("--scaled", command.scaled, "Which operand scales")
      ->check(CLI::IsMember({"p", "q"}))
      ->capture_default_str();
  verb.add_option("--mode", command.mode, "automatic chooses between the others by their cost; all give the same sums")
      ->check(CLI::IsMember({"automatic", "window", "rebuild"}))
      ->capture_default_str();
  verb.add_option("--semantics", command.semantics, "closed, open or regular")
      ->check(CLI::IsMember({"closed", "open", "regular"}))
      ->capture_default_str();
  verb.add_option("-o", command.files,
                  "Write .svg (a film strip), anim.svg (an animation) or .html (a page with a slider and ticks at "
                  "events); with --copies .svg (obstacles, "
                  "what they grow to, robot); of solids .html (a page that plays) and the last frame as .off .obj .stl "
                  ".ply .glb .json; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_flag("--events", command.events, "List the exact scales at which the sum changes");
  add_report_options(verb, command.report, "Sweep N times and report the median and minimum frame");
  add_exact_option(verb, command.report);
  add_solid_input_options(verb, command.input);
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

ScalingOptions scaling_options(const ScaleCommand& command) {
  ScalingOptions options;
  options.scaled = command.scaled == "p" ? ScaledOperand::p : ScaledOperand::q;
  options.reflect_q = command.robot;
  options.mode = command.mode == "window"    ? FrameMode::window
                 : command.mode == "rebuild" ? FrameMode::rebuild
                                             : FrameMode::automatic;
  options.semantics = command.semantics == "open"      ? Semantics::open
                      : command.semantics == "regular" ? Semantics::regular
                                                       : Semantics::closed;
  return options;
}

void add_scale(CLI::App& app, Action& action) {
  auto command = std::make_shared<ScaleCommand>();
  CLI::App& verb = *app.add_subcommand("scale", "s P (+) Q, frame by frame, exact at every scale");
  add_options(verb, *command);
  verb.footer("Example: dymsum scale plate.wkt star.wkt --sweep 1:2:1% --json -o frames.svg");
  verb.callback([command, &action] { action = [command] { return run_scale(*command); }; });
}

}  // namespace dymsum::cli
