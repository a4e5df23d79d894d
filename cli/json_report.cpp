#include "json_report.h"

#include <iostream>

#include "dymsum/version.h"
#include "progress_bar.h"
#include "record_json.h"

namespace dymsum::cli {
namespace {

bool is_there(const std::string& text) { return !text.empty(); }
template <class T>
bool is_there(const std::optional<T>& value) {
  return value.has_value();
}

Json evidence_json(const Evidence& evidence) {
  Json json = Json::object();
  names::for_each_field(evidence, [&](std::string_view name, const auto& value) {
    if (is_there(value)) json[std::string(name)] = json_of(value);
  });
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
