// scale with solid operands.
#include <algorithm>

#include "dymsum/solid_scale_events.h"
#include "outputs.h"
#include "progress_bar.h"
#include "solid/solid_motion.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {
namespace {

/// Those between the least and the largest uniform scale of the frames, or the first that is requested.
std::vector<ScaleEvent> events_of(const SolidMotion& motion, const ScaleCommand& command,
                                  const std::vector<Scale>& scales) {
  const auto [low, high] = std::minmax_element(scales.begin(), scales.end(),
                                               [](const Scale& a, const Scale& b) { return a.exact() < b.exact(); });
  const InterruptGuard guard;
  ProgressBar bar;
  const Progress progress = bar.callback();
  SolidScaleOptions options;
  options.moving = named<MovingOperand>(command.scaled);
  options.threads = static_cast<int>(command.threads);
  const Result<SolidScaleEvents> sum = SolidScaleEvents::create(motion.inputs[0].mesh, motion.inputs[1].mesh, options);
  if (!sum) stop_with(in_solid_operand(sum.error(), motion.inputs));
  if (command.next.empty()) {
    Result<std::vector<ScaleEvent>> events = sum->events(*low, *high, progress);
    throw_if_interrupted();
    return require(std::move(events));
  }
  const EventChange change = named<EventChange>(command.next);
  Result<std::optional<ScaleEvent>> first = sum->next_event(*low, *high, change, progress);
  throw_if_interrupted();
  const std::optional<ScaleEvent> event = require(std::move(first));
  return event ? std::vector<ScaleEvent>{*event} : std::vector<ScaleEvent>{};
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
  if (!command.events) refuse_options(*command.parser, {"--threads"}, "is for planar operands, and for events");
  if (sweep.empty() == command.at.empty()) throw Stop(kUsage, "give one of --sweep and --at");
  SolidMotion motion{"scale", read_solids(command.operands, command.input), {}, command.files, {}, "", command.frame};
  std::vector<Scale> uniform;
  const auto add = [&](const std::vector<Scale>& s) {
    if (s.size() == 1 || (s[0] == s[1] && s[1] == s[2])) uniform.push_back(s[0]);
    SolidFrame frame;
    (command.scaled == "p" ? frame.p : frame.q).scale = {s.front(), s[s.size() / 2], s.back()};
    frame.name = frame_name(s);
    motion.frames.push_back(frame);
  };
  for (const Scale& s : sweep) add({s});
  for (const std::string& text : listed(command.at)) add(scales_in(text));
  if (command.robot) motion.inputs[1].mesh = negated(motion.inputs[1].mesh);
  motion.requested = {{"scaled", command.scaled}, {"robot", command.robot}};
  const bool is_uniform = uniform.size() == motion.frames.size();
  if (command.events && !is_uniform) throw Stop(kUsage, "--events wants the same scale along all axes");
  motion.has_events = command.events;
  if (command.events)
    for (const ScaleEvent& event : events_of(motion, command, uniform))
      motion.events.push_back({event.approx, event_line(event), event_json(event)});
  const ExitCode code = run_solid_motion(motion, command.report);
  return code == kDone && !command.next.empty() && motion.events.empty() ? kNo : code;
}

}  // namespace dymsum::cli
