// What scale and rotate say about sums in motion, planar or solid: one set of words and keys.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/orientation.h"
#include "dymsum/scale.h"
#include "json_report.h"

namespace dymsum::cli {

/// How a frame is told from the others.
struct FrameName {
  std::string pose;  ///< "s = 3/2", "90°"
  Json exact;        ///< {"s"}, or {"theta"} with {"tan_half"} of regions and {"quaternion"} of solids
};

/// One factor for all axes, or one for each.
FrameName frame_name(const std::vector<Scale>& scales);
FrameName frame_name(const std::string& pose, const Orientation& orientation);

/// A frame: its name, the sizes of the sum, and how long the update took.
Json frame_json(const FrameName& name, Json sizes, double update_ms);

Json event_json(const ScaleEvent& event);
std::string event_line(const ScaleEvent& event);

struct MotionReport {
  std::string verb;
  std::vector<std::string> files;
  Json inputs;
  int tier = 0;
  std::size_t repeats = 1, frame_count = 0;
  std::vector<double> ms;  ///< of every frame, every time
  double static_ms = 0;    ///< of a frame from scratch
  Json requested;          ///< what was asked: `semantics`, `scaled`, `robot`, `angle_error`, `axis`
  Json frames, work;
  std::string note;                ///< of the frames, for a person: what makes them exact
  std::string work_text;           ///< the work, for a person
  std::vector<std::string> lines;  ///< what else a person is told: the last frame, events
};

Json motion_json(const MotionReport& report);
void print_motion(std::ostream& out, const MotionReport& report);

}  // namespace dymsum::cli
