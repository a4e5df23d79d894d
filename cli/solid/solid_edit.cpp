#include "solid/solid_edit.h"

#include <iostream>
#include <memory>
#include <optional>

#include "edit_report.h"
#include "line_file.h"
#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"
#include "solid/solid_json.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {
namespace {

/// One round through a script; of the last round the report and the recording.
struct SolidSession {
  std::optional<EditableSolidSum> sum;
  std::vector<double> ms;
  double static_ms = 0;
  Json steps = Json::array();
  std::vector<RefusedStep> refused;
  std::optional<SolidEditRecording> recording;
};

/// The operands that the edits of a step change.
std::string edited_operands(const SolidScriptStep& step) {
  bool p = false, q = false;
  for (const SolidEdit& edit : step.edits) (edit.operand == MovingOperand::p ? p : q) = true;
  return p && q ? "P or Q" : p ? "P" : "Q";
}

/// The error with the line of the step, the operand it is about and the edits themselves.
Error in_solid_script(Error error, const SolidEditing& edit, const SolidScriptStep& step) {
  error.evidence.file = shown_file(edit.script), error.evidence.line = step.line;
  if (step.action != ScriptAction::edit) return error;
  std::vector<std::string> lines;
  for (const SolidEdit& one : step.edits) {
    const SolidScriptStep alone{ScriptAction::edit, {one}, 0};
    lines.push_back(format_solid_script(std::span(&alone, 1)));
  }
  const bool spoils = error.code != ErrorCode::out_of_range;
  error.message += spoils ? "; refused, as " + edited_operands(step) + " would be no solid: " : "; refused: ";
  error.message += on_one_line(lines);
  return error;
}

void make_solid_step(const SolidEditing& edit, const SolidScriptStep& step, std::size_t k, bool last,
                     SolidSession& session) {
  EditableSolidSum& sum = *session.sum;
  const Json head = step_head(k + 1, step.line, step.action, step.edits.size());
  const Result<SolidEditWork> work = make_step(sum, step);
  if (!work) {
    throw_if_interrupted();
    const Error error = in_solid_script(work.error(), edit, step);
    if (!edit.keep_going) stop_with(error);
    session.refused.push_back({k + 1, error});
    if (last) session.steps.push_back(head), session.steps.back()["refused"] = error_json(error);
    return;
  }
  session.ms.push_back(work->ms);
  if (!last) return;
  if (session.recording) record_step(*session.recording, step, sum);
  if (!edit.report.json) return;
  Json json = head;
  json.update(solid_sum_json(sum.sum(), edit.report.exact));
  json.update({{"hash", hash_text(sum.hash())}, {"work", json_without(*work, {"ms"})}, {"update_ms", work->ms}});
  session.steps.push_back(std::move(json));
}

SolidSession run_session(const SolidEditing& edit, const std::vector<SolidInput>& inputs,
                         const std::vector<SolidScriptStep>& steps, const Progress& progress) {
  SolidSession session;
  SolidEditOptions options = edit.options;
  options.progress = progress;
  for (std::size_t round = 0; round < edit.report.repeat; ++round) {
    const bool last = round + 1 == edit.report.repeat;
    session.refused.clear();
    session.sum = require(EditableSolidSum::create(inputs[0].mesh, inputs[1].mesh, options));
    session.static_ms = session.sum->work().ms;
    if (last && !edit.record.empty()) session.recording = begin_recording(*session.sum, edit.options);
    for (std::size_t k = 0; k < steps.size(); ++k) make_solid_step(edit, steps[k], k, last, session);
  }
  return session;
}

Json solid_session_json(const SolidEditing& edit, const std::vector<SolidInput>& inputs, SolidSession& session) {
  Timing timing = timing_of_steps(session.ms, session.static_ms);
  const double update_ms = timing.median_ms;
  timing.repeats = edit.report.repeat;
  const SpatialSum& sum = session.sum->sum();
  Json json =
      report_head("edit", solid_inputs_json(inputs), solid_tier(sum.stats.bits), timing, {{"steps", update_ms}});
  json.update({{"semantics", name(edit.options.semantics)}, {"reflect", edit.options.reflect_q}});
  json.update(solid_sum_json(sum, edit.report.exact));
  json.update({{"refused", session.refused.size()},
               {"static_ms", session.static_ms},
               {"update_ms", update_ms},
               {"hash", hash_text(session.sum->hash())},
               {"steps", std::move(session.steps)}});
  return json;
}

void print_solid_session(std::ostream& out, const SolidEditing& edit, const SolidSession& session, std::size_t steps) {
  const SpatialSum& sum = session.sum->sum();
  out << "edit of " << edit.operands[0] << " and " << edit.operands[1] << ", " << counted(steps, "step");
  if (!session.refused.empty()) out << ", " << session.refused.size() << " of them refused";
  if (!session.ms.empty()) {
    const Timing timing = timing_of(session.ms);
    out << "\n  step " << timing.median_ms << " ms (median, least " << timing.min_ms << " ms), the first sum "
        << session.static_ms << " ms";
  }
  out << "\n  now " << counted(sum.shells, "shell") << ", " << counted(sum.vertices.size(), "vertex", "vertices")
      << ", " << counted(sum.faces.size(), "face") << ", volume " << shown(volume_of(sum)) << "\n";
}

}  // namespace

ExitCode run_solid_edit(const SolidEditing& edit) {
  std::ostream& out = report_stream(edit.files, edit.report.json);
  const SolidOutput how{edit.to};
  check_solid_outputs(edit.files, how);
  for (const std::string& file : edit.files)
    if (is_stage_mesh(file)) throw Stop(kUsage, file + ": edit has no stages to draw");
  const std::vector<SolidInput> inputs = read_solids(edit.operands, edit.input);
  const std::vector<SolidScriptStep> steps =
      require(parse_solid_script(file_text(edit.script), shown_file(edit.script)));
  const InterruptGuard guard;
  auto bar = std::make_unique<ProgressBar>();
  SolidSession session = run_session(edit, inputs, steps, bar->callback());
  bar.reset();
  std::vector<std::string> texts;
  for (const std::string& file : edit.files) texts.push_back(solid_output(session.sum->sum(), file, how));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(edit.files[i], texts[i]);
  if (session.recording) write_text(edit.record, format_recording(*session.recording));
  for (const RefusedStep& refused : session.refused) std::cerr << refused.error.to_string() << "\n";
  if (edit.report.json) print_report(solid_session_json(edit, inputs, session));
  else print_solid_session(out, edit, session, steps.size());
  return session.refused.empty() ? kDone : kNo;
}

bool records_solids(const std::string& text) { return text.find("\"dymsum solid edits\"") != std::string::npos; }

ExitCode run_solid_replay(const std::string& file, const std::string& text, const ReportOptions& report) {
  const SolidEditRecording recording = require(parse_solid_recording(text, shown_file(file)));
  const InterruptGuard guard;
  auto bar = std::make_unique<ProgressBar>();
  const auto [made, timing] = timed(report.repeat, [&] { return require(replay(recording, bar->callback())); });
  bar.reset();
  const std::vector<SolidInput> inputs{{file, recording.p}, {file, recording.q}};
  return report_replay(file, made, recording.steps.size(), timing,
                       report_head("edit", solid_inputs_json(inputs), tier_of(recording.p, recording.q), timing),
                       report.json,
                       [&](std::size_t step) { return format_solid_script(std::span(&recording.steps[step - 1], 1)); });
}

}  // namespace dymsum::cli
