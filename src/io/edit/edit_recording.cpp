#include <array>
#include <limits>
#include <stdexcept>

#include "base/poll.h"
#include "dymsum/edit_script.h"
#include "dymsum/names.h"
#include "io/checked_json.h"
#include "io/read_file.h"

namespace dymsum {
namespace {

using RecordingJson = nlohmann::json;

constexpr io::CheckedFormat kRecordingFormat{"dymsum edits", 1, "a recording of edits"};
constexpr std::size_t kHashDigits = 16;

/// 16 hexadecimal digits: other programs read numbers of 64 bits as doubles.
std::string hash_text(std::uint64_t hash) {
  std::string text(kHashDigits, '0');
  for (std::size_t k = 0; k < kHashDigits; ++k) text[kHashDigits - 1 - k] = "0123456789abcdef"[hash >> (4 * k) & 15];
  return text;
}

std::uint64_t hash_in(const RecordingJson& j) {
  const std::string& text = io::text(j);
  io::demand(text.size() == kHashDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos,
             "a hash is 16 hexadecimal digits");
  std::uint64_t hash = 0;
  for (const char c : text) hash = hash << 4 | static_cast<std::uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10);
  return hash;
}

template <names::Enumeration E>
E enumerator_in(const RecordingJson& j) {
  const std::optional<E> value = parse<E>(io::text(j));
  io::demand(value.has_value(), "an option has a value that it does not have");
  return *value;
}

Result<EditRecording> recording_of(const RecordingJson& content) {
  EditRecording recording;
  Result<Region> p = io::region_of(content.at("p")), q = io::region_of(content.at("q"));
  if (!p) return p.error();
  if (!q) return q.error();
  recording.p = *std::move(p), recording.q = *std::move(q);
  const RecordingJson& options = content.at("options");
  recording.semantics = enumerator_in<Semantics>(options.at("semantics"));
  recording.reflect_q = io::flag(options.at("reflect_q"));
  recording.mode = enumerator_in<FrameMode>(options.at("mode"));
  recording.undo_steps = io::whole(options.at("undo_steps"), std::numeric_limits<std::uint32_t>::max());
  recording.hashes.push_back(hash_in(content.at("hash")));
  for (const RecordingJson& j : io::list(content.at("steps"))) {
    io::array(j, 2);
    Result<std::vector<ScriptStep>> step = parse_script(io::text(j[0]));
    if (!step) return Error{ErrorCode::malformed, step.error().message, {}};
    io::demand(step->size() == 1, "a step is not one");
    recording.steps.push_back(step->front());
    recording.steps.back().line = 0;
    recording.hashes.push_back(hash_in(j[1]));
  }
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
  if (recording.hashes.size() != recording.steps.size() + 1)
    throw std::invalid_argument("format_recording: a hash before the first step, and one after each");
  RecordingJson steps = RecordingJson::array();
  for (std::size_t k = 0; k < recording.steps.size(); ++k)
    steps.push_back(
        RecordingJson::array({format_script(std::span(&recording.steps[k], 1)), hash_text(recording.hashes[k + 1])}));
  return io::format_checked(kRecordingFormat, {{"p", io::region_json(recording.p)},
                                               {"q", io::region_json(recording.q)},
                                               {"options",
                                                {{"semantics", name(recording.semantics)},
                                                 {"reflect_q", recording.reflect_q ? 1 : 0},
                                                 {"mode", name(recording.mode)},
                                                 {"undo_steps", recording.undo_steps}}},
                                               {"hash", hash_text(recording.hashes[0])},
                                               {"steps", std::move(steps)}});
}

Result<EditRecording> parse_recording(std::string_view text, std::string_view name_for_errors) {
  std::optional<EditRecording> read;
  const auto use = [&](const RecordingJson& content) -> Result<void> {
    Result<EditRecording> made = recording_of(content);
    if (!made) return made.error();
    read.emplace(*std::move(made));
    return {};
  };
  const Result<void> done = io::read_checked(kRecordingFormat, text, name_for_errors, use);
  if (!done) return done.error();
  return *std::move(read);
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
  Result<EditableSum> sum = EditableSum::create(recording.p, recording.q, options);
  if (!sum) return sum.error();
  EditableSum edited = *std::move(sum);
  EditReplay made;
  if (edited.hash() != recording.hashes.at(0)) made.differs = 0;
  for (std::size_t k = 0; k < recording.steps.size() && !made.differs; ++k) {
    if (progress && !progress("steps", static_cast<double>(k) / static_cast<double>(recording.steps.size())))
      return cancelled();
    const Result<FrameChanges> changes = make_step(edited, recording.steps[k]);
    if (!changes && changes.error().code == ErrorCode::cancelled) return changes.error();
    if (!changes) made.refused = changes.error();
    else ++made.steps;
    if (!changes || edited.hash() != recording.hashes.at(k + 1)) made.differs = k + 1;
  }
  return made;
}

}  // namespace dymsum
