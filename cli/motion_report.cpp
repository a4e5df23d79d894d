#include "motion_report.h"

#include <ostream>

#include "report.h"

namespace dymsum::cli {

FrameName frame_name(const std::vector<Scale>& scales) {
  FrameName name{"s = ", {}};
  Json exact = Json::array();
  for (const Scale& s : scales) {
    if (!exact.empty()) name.pose += ":";
    name.pose += shown(s.exact());
    exact.push_back(s.exact().to_string());
  }
  name.exact["s"] = scales.size() == 1 ? exact[0] : exact;
  return name;
}

FrameName frame_name(const std::string& pose, const Orientation& orientation) {
  const Json both = orientation_json(orientation);
  return {pose, {{"theta", both["theta"]}, {"tan_half", both["tan_half"]}}};
}

Json frame_json(const FrameName& name, Json sizes, double update_ms) {
  Json json = {{"pose", name.pose}};
  json.update(name.exact);
  json.update(sizes);
  json["update_ms"] = update_ms;
  return json;
}

Json event_json(const ScaleEvent& event) {
  return {{"s", event.parameter.to_string()},
          {"approx", event.approx},
          {"kind", name(event.kind)},
          {"visible", event.visible},
          {"topology", event.topology}};
}

std::string event_line(const ScaleEvent& event) {
  return "event " + shown(event.parameter) + (event.topology ? "  topology changes" : "");
}

Json motion_json(const MotionReport& report) {
  Timing timing = timing_of(report.ms);
  const double update_ms = timing.median_ms;
  timing.repeats = report.repeats;
  Json json = report_head(report.verb, report.inputs, report.tier, timing, {{"frames", update_ms}});
  json.update(report.requested);
  json.update(
      {{"frames", report.frames}, {"static_ms", report.static_ms}, {"update_ms", update_ms}, {"work", report.work}});
  return json;
}

void print_motion(std::ostream& out, const MotionReport& report) {
  const Timing timing = timing_of(report.ms);
  out << report.verb << " of " << report.files[0] << " and " << report.files[1] << ", "
      << counted(report.frame_count, "frame") << report.note << "\n  frame " << timing.median_ms
      << " ms (median, least " << timing.min_ms << " ms"
      << (report.repeats > 1 ? ", of " + std::to_string(report.repeats) + " rounds" : "") << "), from scratch "
      << report.static_ms << " ms\n  " << report.work_text << "\n";
  for (const std::string& line : report.lines) out << "  " << line << "\n";
}

}  // namespace dymsum::cli
