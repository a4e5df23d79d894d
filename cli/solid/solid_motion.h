// Solids that turn or scale, frame by frame: what rotate and scale do with solid operands.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/solid_scale_events.h"
#include "exit_code.h"
#include "motion_report.h"
#include "solid/solid_operands.h"
#include "verbs/scale_command.h"

namespace dymsum::cli {

struct SolidFrame {
  SolidPose p, q;
  FrameName name;
};

/// Something that happens between frames, as a report says it.
struct MotionEvent {
  double at = 0;  ///< the uniform scale or the angle in radians
  std::string line;
  Json json;
};

/// What moves, and what is written of it.
struct SolidMotion {
  std::string verb;
  std::vector<SolidInput> inputs;
  std::vector<SolidFrame> frames;
  std::vector<std::string> files;  ///< meshes of a frame
  Json requested;                  ///< as MotionReport has it
  std::string note;
  std::optional<std::size_t> shown;  ///< the frame that meshes are of; else the last one
  bool has_events = false;           ///< reports tell them
  std::vector<MotionEvent> events = {};
};

/// Makes the frames, writes meshes and reports. Stops where `shown` is no frame.
ExitCode run_solid_motion(const SolidMotion& motion, const ReportOptions& report);

/// The report, with the events where there are some.
void print_solid_motion(std::ostream& out, const SolidMotion& motion, MotionReport& report, bool as_json);

/// Turned about an axis: of the name of the frame, theta is the exact rotation's angle, in (-pi, pi].
SolidFrame turned_frame(const Rotation& rotation, const Point3& axis, const std::string& pose);

/// scale with solid operands: `sweep` as parsed, or --at with one scale or three a frame.
ExitCode run_solid_scale(const ScaleCommand& command, const std::vector<Scale>& sweep);

}  // namespace dymsum::cli
