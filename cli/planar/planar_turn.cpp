#include "planar/planar_turn.h"

#include <iostream>
#include <sstream>

#include "dymsum/rotating_sum.h"
#include "planar/planar_motion.h"
#include "solid/solid_limits.h"

namespace dymsum::cli {
namespace {

std::vector<PlanarFrame<Orientation>> frames_of(const PlanarRotation& turn) {
  std::vector<PlanarFrame<Orientation>> frames;
  for (const Angle& angle : turn.angles) {
    const Orientation theta = require_option(Orientation::nearest(angle.radians(), turn.error), "--error");
    frames.push_back({theta, frame_name(angle.label(), theta), angle.label()});
  }
  return frames;
}

RotatingSum rotating_sum(const PlanarRotation& turn, const std::vector<Input>& inputs, FrameMode mode) {
  MovingOptions options;
  options.semantics = named<Semantics>(turn.semantics);
  options.mode = mode;
  options.memory = memory_bytes(turn.memory_mb);
  options.threads = static_cast<int>(turn.threads);
  return require_of(inputs, RotatingSum::create(inputs[0].region, inputs[1].region, options));
}

/// The sum was made at zero: a frame there is that one, with its time.
void turn_to(RotatingSum& sum, const Orientation& theta) {
  if (!(sum.orientation() == theta)) require(sum.set(theta));
}

}  // namespace

ExitCode run_planar_rotation(const PlanarRotation& turn) {
  check_frame_pictures(turn.files);
  const std::vector<PlanarFrame<Orientation>> frames = frames_of(turn);
  const std::vector<Input> inputs = read_inputs(turn.operands, turn.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  auto motion = run_planar_motion<RotatingSum>(
      frames, turn.report, turn.files, bar->callback(),
      [&] { return rotating_sum(turn, inputs, FrameMode::automatic); }, turn_to);
  const double static_ms = planar_static_ms(
      frames, turn.report.repeat, [&] { return rotating_sum(turn, inputs, FrameMode::rebuild); }, turn_to);
  bar.reset();
  throw_if_interrupted();
  write_frame_pictures(turn.files, motion.pictures);
  MotionReport report = planar_motion_report("rotate", inputs, turn.report.repeat, frames, std::move(motion));
  report.static_ms = static_ms;
  report.requested = {{"semantics", turn.semantics}, {"angle_error", turn.error}};
  std::ostringstream note;
  note << ", each exact at an orientation within " << turn.error << " of its angle";
  report.note = note.str();
  if (turn.report.json) print_report(motion_json(report));
  else print_motion(std::cout, report);
  return kDone;
}

}  // namespace dymsum::cli
