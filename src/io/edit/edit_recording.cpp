#include <stdexcept>

#include "dymsum/edit_script.h"
#include "dymsum/names.h"
#include "io/edit/recorded_steps.h"
#include "io/read_file.h"

namespace dymsum {
namespace {

using RecordingJson = nlohmann::json;

constexpr io::CheckedFormat kRecordingFormat{"dymsum edits", 1, "a recording of edits"};

Result<EditRecording> recording_of(const RecordingJson& content) {
  EditRecording recording;
  Result<Region> p = io::region_of(content.at("p")), q = io::region_of(content.at("q"));
  if (!p) return p.error();
  if (!q) return q.error();
  recording.p = *std::move(p), recording.q = *std::move(q);
  const RecordingJson& options = content.at("options");
  recording.semantics = io::enumerator_in<Semantics>(options.at("semantics"));
  recording.reflect_q = io::flag(options.at("reflect_q"));
  recording.mode = io::enumerator_in<FrameMode>(options.at("mode"));
  recording.undo_steps = io::count_in(options.at("undo_steps"));
  io::read_steps(content, recording, [](std::string_view text) { return parse_script(text); });
  return recording;
}

}  // namespace

EditRecording begin_recording(const EditableSum& sum, const EditOptions& options) {
  if (sum.undo_count() + sum.redo_count() > 0)
    throw std::invalid_argument("begin_recording: the sum has steps that are not recorded");
  return {sum.p(), sum.q(), options.semantics, options.reflect_q, options.mode, options.undo_steps, {}, {sum.hash()}};
}

void record_step(EditRecording& recording, const ScriptStep& step, const EditableSum& sum) {
  recording.steps.push_back(step);
  recording.steps.back().line = 0;
  recording.hashes.push_back(sum.hash());
}

std::string format_recording(const EditRecording& recording) {
  RecordingJson content =
      io::steps_json(recording, [](std::span<const ScriptStep> step) { return format_script(step); });
  content.update({{"p", io::region_json(recording.p)},
                  {"q", io::region_json(recording.q)},
                  {"options",
                   {{"semantics", name(recording.semantics)},
                    {"reflect_q", recording.reflect_q ? 1 : 0},
                    {"mode", name(recording.mode)},
                    {"undo_steps", recording.undo_steps}}}});
  return io::format_checked(kRecordingFormat, content);
}

Result<EditRecording> parse_recording(std::string_view text, std::string_view name_for_errors) {
  return io::checked_recording<EditRecording>(kRecordingFormat, text, name_for_errors, recording_of);
}

Result<EditRecording> read_recording(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_recording(*text, path == "-" ? "standard input" : path);
}

Result<EditReplay> replay(const EditRecording& recording, const Progress& progress) {
  EditOptions options;
  options.semantics = recording.semantics, options.reflect_q = recording.reflect_q, options.mode = recording.mode;
  options.undo_steps = recording.undo_steps, options.progress = progress;
  return io::replayed(recording, EditableSum::create(recording.p, recording.q, options), progress);
}

}  // namespace dymsum
