// dymsum scale P Q --sweep A:B:STEP | --at s,s,...
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "dymsum/scaling_sum.h"
#include "inputs.h"
#include "outputs.h"
#include "progress_bar.h"
#include "report.h"
#include "scale_pictures.h"
#include "sum_command.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

constexpr std::size_t kMostFrames = 1000000;

struct ScaleCommand {
  std::vector<std::string> operands{"", ""};
  std::string sweep, scaled = "p", mode = "automatic", semantics = "closed";
  std::vector<std::string> at, files;
  bool json = false, events = false;
  std::size_t repeat = 1;
  InputOptions input;
};

Scale parsed(const std::string& text) { return require(Scale::parse(text)); }

/// A:B:STEP with an exact step to add, or A:B:N% with a ratio of 1 + N/100.
std::vector<Scale> sweep_scales(const std::string& text) {
  const std::size_t first = text.find(':'), second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos) throw Stop(kUsage, "--sweep wants FROM:TO:STEP, such as 0.5:2:0.01 or 1:2:1%");
  std::string step = text.substr(second + 1);
  const bool ratio = step.ends_with('%');
  if (ratio) step.pop_back();
  std::vector<Scale> scales =
      require(scale_steps(parsed(text.substr(0, first)), parsed(text.substr(first + 1, second - first - 1)), parsed(step), ratio, kMostFrames));
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

ScalingOptions options_of(const ScaleCommand& command) {
  ScalingOptions options;
  options.scaled = command.scaled == "p" ? ScaledOperand::p : ScaledOperand::q;
  options.mode = command.mode == "window" ? ScalingMode::window : command.mode == "rebuild" ? ScalingMode::rebuild : ScalingMode::automatic;
  options.semantics = command.semantics == "open" ? Semantics::open : command.semantics == "regular" ? Semantics::regular : Semantics::closed;
  return options;
}

/// A fresh computation at a few of the scales.
double static_ms(const Region& p, const Region& q, const ScaleCommand& command, const std::vector<Scale>& scales) {
  ScalingOptions options = options_of(command);
  options.mode = ScalingMode::rebuild;
  ScalingSum fresh = require(ScalingSum::create(p, q, options));
  std::vector<double> ms;
  for (const std::size_t i : {std::size_t{0}, scales.size() / 2, scales.size() - 1})
    for (std::size_t k = 0; k < command.repeat; ++k) {
      require(fresh.set(scales[i]));
      ms.push_back(fresh.work().ms);
    }
  return timing_of(ms).median_ms;
}

ExitCode run_scale(const ScaleCommand& command) {
  if (command.sweep.empty() == command.at.empty()) throw Stop(kUsage, "give either --sweep or --at");
  std::vector<Scale> scales;
  if (!command.sweep.empty()) scales = sweep_scales(command.sweep);
  for (const std::string& s : command.at) scales.push_back(parsed(s));
  for (const std::string& file : command.files)
    if (!file.ends_with(".svg") && !file.ends_with(".html")) throw Stop(kUsage, "-o writes .svg (film strip) or .html (page with a slider): " + file);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const Region &p = inputs[0].region, &q = inputs[1].region;

  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  std::vector<double> all_ms;
  Json frames = Json::array();
  std::vector<PicturedFrame> pictures;
  std::uint64_t lists_changed = 0, degenerate = 0, windows = 0, rebuilt = 0;
  int tier = 0;
  // A strip shows every frame, a long sweep evenly chosen ones.
  const std::size_t pictured_every = command.files.empty() ? 0 : (scales.size() + 239) / 240;
  std::optional<ScalingSum> sum;
  for (std::size_t round = 0; round < command.repeat; ++round) {
    sum = require(ScalingSum::create(p, q, options_of(command)));
    const bool last = round + 1 == command.repeat;
    for (std::size_t i = 0; i < scales.size(); ++i) {
      if (!progress("frames", double(i) / double(scales.size()))) throw_if_interrupted();
      require(sum->set(scales[i]));
      all_ms.push_back(sum->work().ms);
      tier = std::max(tier, sum->sum().stats.tier_bits);
      if (!last) continue;
      lists_changed += sum->work().lists_changed;
      degenerate += sum->work().degenerate;
      windows += sum->work().new_window;
      rebuilt += sum->work().rebuilt;
      if (pictured_every > 0 && i % pictured_every == 0) pictures.push_back(pictured(*sum));
      const bool detail = command.json;
      if (detail)
        frames.push_back({{"s", scales[i].exact().to_string()},
                          {"outer", sum->sum().parts.size()},
                          {"holes", sum->sum().hole_count()},
                          {"vertices", sum->sum().vertex_count()},
                          {"area_exact", sum->sum().area_exact().to_string()},
                          {"tight", {{"points", sum->sum().tight_points.size()}, {"segments", sum->sum().tight_segments.size()}}},
                          {"update_ms", sum->work().ms}});
    }
  }
  std::vector<ScaleEvent> events;
  const bool page = std::any_of(command.files.begin(), command.files.end(), [](const std::string& f) { return f.ends_with(".html"); });
  if (command.events || page) {
    const auto [low, high] = std::minmax_element(scales.begin(), scales.end(), [](const Scale& a, const Scale& b) { return a.approx() < b.approx(); });
    events = require(sum->events(*low, *high, progress));
  }
  const double fresh_ms = static_ms(p, q, command, scales);
  bar.reset();
  const Timing timing = timing_of(all_ms);
  std::vector<std::string> texts;
  for (const std::string& file : command.files)
    texts.push_back(file.ends_with(".html") ? scrub_page(pictures, events, inputs[0].file + " and " + inputs[1].file + ", " + command.scaled + " scales")
                                            : film_strip(pictures, 8));
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.files[i], texts[i]);
  if (command.json) {
    Json list = command.events ? events_json(events) : Json(nullptr);
    const Json out = {{"inputs", inputs_json(inputs)},
                      {"tier", tier},
                      {"time_ms", {{"median", timing.median_ms}, {"min", timing.min_ms}, {"stages", {{"frames", timing.median_ms}}}}},
                      {"repeats", command.repeat},
                      {"scaled", command.scaled},
                      {"frames", frames},
                      {"static_ms", fresh_ms},
                      {"update_ms", timing.median_ms},
                      {"work", {{"lists_changed", lists_changed}, {"degenerate_frames", degenerate}, {"windows", windows}, {"rebuilt", rebuilt}}},
                      {"events", list}};
    std::cout << out.dump(2) << "\n";
  } else {
    std::cout << "scale of " << inputs[0].file << " and " << inputs[1].file << ", " << counted(scales.size(), "frame") << "\n  frame " << timing.median_ms
              << " ms (median, least " << timing.min_ms << " ms), from scratch " << fresh_ms << " ms\n  " << counted(windows, "window") << ", "
              << counted(rebuilt, "frame") << " from scratch, " << counted(degenerate, "frame") << " at which something touches\n  at s = "
              << sum->scale().exact().to_string() << ": " << counted(sum->sum().parts.size(), "part") << ", " << counted(sum->sum().hole_count(), "hole")
              << ", " << counted(sum->sum().vertex_count(), "vertex", "vertices") << "\n";
    for (const ScaleEvent& e : events)
      if (e.visible && command.events) std::cout << "  event " << e.s.to_string() << (e.topology ? "  topology changes" : "") << "\n";
  }
  return kDone;
}

}  // namespace

void add_scale(CLI::App& app, Action& action) {
  auto command = std::make_shared<ScaleCommand>();
  CLI::App& verb = *app.add_subcommand("scale", "s P (+) Q, frame by frame, exact at every scale");
  const char* const operand = "File, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option("P", command->operands[0], operand)->required();
  verb.add_option("Q", command->operands[1], operand)->required();
  verb.add_option("--sweep", command->sweep, "FROM:TO:STEP; STEP is added, or with % multiplies: 1:2:1%")->type_name("A:B:STEP");
  verb.add_option("--at", command->at, "Scales, exact: 3/2, 1.01, 1e-3")->delimiter(',')->type_name("S,S,...");
  verb.add_option("--scaled", command->scaled, "Which operand scales")->check(CLI::IsMember({"p", "q"}))->capture_default_str();
  verb.add_option("--mode", command->mode, "automatic chooses between the others by their cost; all give the same sums")
      ->check(CLI::IsMember({"automatic", "window", "rebuild"}))
      ->capture_default_str();
  verb.add_option("--semantics", command->semantics, "closed, open or regular")->check(CLI::IsMember({"closed", "open", "regular"}))->capture_default_str();
  verb.add_option("-o", command->files, "Write .svg (a film strip) or .html (a page with a slider and ticks at events); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_flag("--events", command->events, "List the exact scales at which the sum changes");
  verb.add_flag("--json", command->json, "Print one JSON object with the result's summary");
  verb.add_option("--repeat", command->repeat, "Sweep N times and report the median and minimum frame")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}))
      ->capture_default_str();
  add_input_options(verb, command->input);
  verb.footer("Example: dymsum scale plate.wkt star.wkt --sweep 1:2:1% --json -o frames.svg");
  verb.callback([command, &action] { action = [command] { return run_scale(*command); }; });
}

}  // namespace dymsum::cli
