#include "json_report.h"

#include <iostream>

#include "dymsum/version.h"
#include "progress_bar.h"

namespace dymsum::cli {
namespace {

Json evidence_json(const Evidence& e) {
  Json json = Json::object();
  if (!e.file.empty()) json["file"] = e.file;
  const auto add = [&](const char* key, const auto& value) {
    if (value) json[key] = *value;
  };
  add("line", e.line);
  add("part", e.part);
  add("ring", e.ring);
  add("vertex", e.vertex);
  add("other_part", e.other_part);
  add("other_ring", e.other_ring);
  add("other_vertex", e.other_vertex);
  add("face", e.face);
  add("other_face", e.other_face);
  add("x", e.x);
  add("y", e.y);
  add("z", e.z);
  return json;
}

/// The code of a failure that no library function reported.
const char* code_of(ExitCode exit) {
  switch (exit) {
    case kUsage:
      return "usage";
    case kDefect:
      return "defect";
    case kInterrupted:
      return "cancelled";
    default:
      return "bad_input";
  }
}

}  // namespace

Json report_head(const std::string& verb, Json inputs, int tier, const Timing& timing, Json stages) {
  return {{"verb", verb},
          {"version", DYMSUM_VERSION},
          {"inputs", std::move(inputs)},
          {"tier", tier},
          {"time_ms", {{"median", timing.median_ms}, {"min", timing.min_ms}, {"stages", std::move(stages)}}},
          {"repeats", timing.repeats}};
}

std::string report_text(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_report(const Json& report) {
  const std::string text = report_text(report);
  const WriteGuard guard;
  std::cout << text << std::flush;
}

Json error_json(const Error& error) {
  return {{"code", std::string(name(error.code))},
          {"message", error.to_string()},
          {"evidence", evidence_json(error.evidence)},
          {"exit", kBadInput}};
}

Json failure_json(const std::string& verb, const Stop& stop) {
  Json error = stop.error()
                   ? error_json(*stop.error())
                   : Json{{"code", code_of(stop.code())}, {"message", stop.what()}, {"evidence", Json::object()}};
  error["message"] = stop.what();
  error["exit"] = stop.code();
  return {
      {"verb", verb.empty() ? Json(nullptr) : Json(verb)}, {"version", DYMSUM_VERSION}, {"error", std::move(error)}};
}

}  // namespace dymsum::cli
