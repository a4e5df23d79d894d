#include "planar/planar_edit.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "edit_report.h"
#include "line_file.h"
#include "pictures/frame_pictures.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"

namespace dymsum::cli {
namespace {

/// One round through a script; of the last round the report, the pictures and the recording.
struct EditSession {
  std::optional<EditableSum> sum;
  std::vector<double> ms;
  double static_ms = 0;
  int tier = 0;
  std::uint64_t rebuilt = 0, degenerate = 0;
  Json steps = Json::array();
  std::vector<RefusedStep> refused;
  std::vector<PicturedFrame> pictures;
  std::optional<EditRecording> recording;
};

Json rings_json(const EditableSum& sum, const FrameChanges& changes) {
  Json json = {{"kept", 0}, {"moved", 0}, {"reshaped", 0}, {"appeared", 0}, {"disappeared", 0}};
  std::size_t listed = 0;
  for (const RingChange& change : changes.rings) {
    json[std::string(name(change.kind))] = json[std::string(name(change.kind))].get<std::size_t>() + 1;
    listed += change.kind != RingChange::Kind::disappeared;
  }
  json["kept"] = sum.ring_ids().size() - listed;
  return json;
}

Json head_of(std::size_t step, const ScriptStep& made) {
  return step_head(step, made.line, made.action, made.edits.size());
}

Json step_json(std::size_t step, const ScriptStep& made, const EditableSum& sum, const FrameChanges& changes,
               bool exact) {
  Json json = head_of(step, made);
  json.update(size_json(sum.sum(), exact));
  json.update({{"rings", rings_json(sum, changes)},
               {"topology", changes.topology},
               {"hash", hash_text(sum.hash())},
               {"work", json_without(sum.work(), {"ms"})},
               {"update_ms", sum.work().ms}});
  return json;
}

/// "P" or "Q", whichever the edits would spoil: where they are of both, P if its own edits are refused.
std::string spoiled_operand(const EditableSum& sum, const ScriptStep& step) {
  std::vector<Edit> of_p;
  for (const Edit& edit : step.edits)
    if (edit.operand == MovingOperand::p) of_p.push_back(edit);
  if (of_p.empty()) return "Q";
  if (of_p.size() == step.edits.size()) return "P";
  EditOptions options;
  options.mode = FrameMode::rebuild;
  Result<EditableSum> alone = EditableSum::create(sum.p(), sum.q(), options);
  if (!alone) return "P";
  EditableSum copy = *std::move(alone);
  return copy.edit(of_p) ? "Q" : "P";
}

/// "p move 3 1 2; q remove 4", cut where it is long.
std::string shown_edits(const ScriptStep& step) {
  std::vector<std::string> lines;
  for (const Edit& edit : step.edits) {
    const ScriptStep alone{ScriptAction::edit, {edit}, 0};
    lines.push_back(format_script(std::span(&alone, 1)));
  }
  return on_one_line(lines);
}

/// The error with the line of the step, the operand it is about and the edits themselves.
Error in_script(Error error, const PlanarEdit& edit, const EditableSum& sum, const ScriptStep& step) {
  error.evidence.file = shown_file(edit.script), error.evidence.line = step.line;
  if (step.action != ScriptAction::edit) return error;
  const bool spoils = error.code != ErrorCode::out_of_range;
  error.message += spoils ? "; refused, as " + spoiled_operand(sum, step) + " would be no region: " : "; refused: ";
  error.message += shown_edits(step);
  return error;
}

class SessionMaker {
 public:
  SessionMaker(const PlanarEdit& edit, const std::vector<Input>& inputs, const std::vector<ScriptStep>& steps,
               const Progress& progress)
      : edit_(edit), inputs_(inputs), steps_(steps), progress_(progress) {
    every_ = picture_step(steps.size() + 1, edit.film.empty() ? std::vector<std::string>{} : std::vector{edit.film});
  }

  EditSession run() {
    EditSession session;
    for (std::size_t round = 0; round < edit_.report.repeat; ++round) {
      std::vector<double> ms = std::move(session.ms);
      session = EditSession{};
      session.ms = std::move(ms);
      make(session, round + 1 == edit_.report.repeat);
    }
    return session;
  }

 private:
  void make(EditSession& session, bool last) {
    EditOptions options = edit_.options;
    options.progress = progress_;
    session.sum = require_of(inputs_, EditableSum::create(inputs_[0].region, inputs_[1].region, options));
    session.static_ms = session.sum->work().ms;
    session.tier = session.sum->sum().stats.tier_bits;
    if (last && !edit_.record.empty()) session.recording = begin_recording(*session.sum, edit_.options);
    if (last) picture(session, 0, "before");
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      if (!progress_("steps", double(k) / double(steps_.size()))) throw_if_interrupted();
      step(session, k, last);
    }
  }
  void step(EditSession& session, std::size_t k, bool last) {
    const ScriptStep& step = steps_[k];
    EditableSum& sum = *session.sum;
    const Result<FrameChanges> changes = make_step(sum, step);
    if (!changes) {
      throw_if_interrupted();
      const Error error = in_script(changes.error(), edit_, sum, step);
      if (!edit_.keep_going) stop_with(error);
      session.refused.push_back({k + 1, error});
      if (last) session.steps.push_back(head_of(k + 1, step)), session.steps.back()["refused"] = error_json(error);
      return;
    }
    session.ms.push_back(sum.work().ms);
    session.tier = std::max(session.tier, sum.sum().stats.tier_bits);
    session.rebuilt += sum.work().rebuilt, session.degenerate += sum.work().degenerate;
    if (!last) return;
    if (edit_.report.json) session.steps.push_back(step_json(k + 1, step, sum, *changes, edit_.report.exact));
    if (session.recording) record_step(*session.recording, step, sum);
    picture(session, k + 1, "line " + std::to_string(step.line));
  }
  void picture(EditSession& session, std::size_t frame, const std::string& caption) const {
    if (every_ > 0 && frame % every_ == 0) session.pictures.push_back({caption, drawn(session.sum->sum())});
  }

  const PlanarEdit& edit_;
  const std::vector<Input>& inputs_;
  const std::vector<ScriptStep>& steps_;
  const Progress& progress_;
  std::size_t every_ = 0;
};

void check(const PlanarEdit& edit) {
  check_outputs(edit.output);
  for (const std::string& file : edit.output.files)
    if (is_stage_picture(file)) throw Stop(kUsage, file + ": edit has no stages to draw");
  if (!edit.film.empty() && !edit.film.ends_with(".svg"))
    throw Stop(kUsage, "--film writes .svg (a film strip) or anim.svg (an animation): " + edit.film);
}

void print_session(std::ostream& out, const PlanarEdit& edit, const EditSession& session, std::size_t steps) {
  const Timing timing = timing_of_steps(session.ms, session.static_ms);
  const PlanarSum& sum = session.sum->sum();
  out << "edit of " << edit.operands[0] << " and " << edit.operands[1] << ", " << counted(steps, "step");
  if (!session.refused.empty()) out << ", " << session.refused.size() << " of them refused";
  if (!session.ms.empty())
    out << "\n  step " << timing.median_ms << " ms (median, least " << timing.min_ms << " ms), the first sum "
        << session.static_ms << " ms";
  out << "\n  " << counted(session.rebuilt, "step") << " from scratch, " << counted(session.degenerate, "step")
      << " at which something touches\n  now " << counted(sum.parts.size(), "part") << ", "
      << counted(sum.hole_count(), "hole") << ", " << counted(sum.vertex_count(), "vertex", "vertices") << ", area "
      << shown_area(sum) << "\n";
}

Json session_json(const PlanarEdit& edit, const std::vector<Input>& inputs, EditSession& session) {
  Timing timing = timing_of_steps(session.ms, session.static_ms);
  const double update_ms = timing.median_ms;
  timing.repeats = edit.report.repeat;
  Json json = report_head("edit", inputs_json(inputs), session.tier, timing, {{"steps", update_ms}});
  json.update({{"semantics", name(edit.options.semantics)}, {"reflect", edit.options.reflect_q}});
  json.update(size_json(session.sum->sum(), edit.report.exact));
  json.update({{"refused", session.refused.size()},
               {"static_ms", session.static_ms},
               {"update_ms", update_ms},
               {"hash", hash_text(session.sum->hash())},
               {"work", {{"rebuilt", session.rebuilt}, {"degenerate_frames", session.degenerate}}},
               {"steps", std::move(session.steps)}});
  return json;
}

void write_session(const PlanarEdit& edit, const EditSession& session) {
  const Region& q = session.sum->q();
  write_sum(session.sum->p(), edit.options.reflect_q ? negated(q) : q, session.sum->sum(), SumNames{}, edit.output);
  if (!edit.film.empty()) write_frame_pictures({edit.film}, session.pictures);
  if (session.recording) write_text(edit.record, format_recording(*session.recording));
}

}  // namespace

ExitCode run_planar_edit(const PlanarEdit& edit) {
  std::ostream& out = report_stream(edit.output.files, edit.report.json);
  check(edit);
  const std::vector<Input> inputs = read_inputs(edit.operands, edit.input);
  const std::vector<ScriptStep> steps = require(parse_script(file_text(edit.script), shown_file(edit.script)));
  const InterruptGuard guard;
  auto bar = std::make_unique<ProgressBar>();
  const Progress progress = bar->callback();
  EditSession session = SessionMaker(edit, inputs, steps, progress).run();
  bar.reset();
  write_session(edit, session);
  for (const RefusedStep& refused : session.refused) std::cerr << refused.error.to_string() << "\n";
  if (edit.report.json) print_report(session_json(edit, inputs, session));
  else print_session(out, edit, session, steps.size());
  return session.refused.empty() ? kDone : kNo;
}

ExitCode run_replay(const std::string& file, const std::string& text, const ReportOptions& report) {
  const EditRecording recording = require(parse_recording(text, shown_file(file)));
  const InterruptGuard guard;
  auto bar = std::make_unique<ProgressBar>();
  const auto [made, timing] = timed(report.repeat, [&] { return require(replay(recording, bar->callback())); });
  bar.reset();
  const std::vector<Input> inputs{{file, recording.p}, {file, recording.q}};
  return report_replay(file, made, recording.steps.size(), timing,
                       report_head("edit", inputs_json(inputs), tier_of(recording.p, recording.q), timing), report.json,
                       [&](std::size_t step) { return format_script(std::span(&recording.steps[step - 1], 1)); });
}

}  // namespace dymsum::cli
