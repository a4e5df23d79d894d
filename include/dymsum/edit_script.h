// Edits of regions as text, and recordings of what was done to an EditableSum, from which it can be made again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/editable_sum.h"

namespace dymsum {

enum class ScriptAction : std::uint8_t { edit, undo, redo };

/// A step of a script: edits that are made as one, or one back or forward.
struct ScriptStep {
  ScriptAction action = ScriptAction::edit;
  std::vector<Edit> edits;  ///< at least one, where it is a step of edits
  std::int64_t line = 0;    ///< on which it begins, from 1; 0 where it was not read
  friend bool operator==(const ScriptStep&, const ScriptStep&) = default;
};

/// The steps of a script (docs/guide/editing.md). Errors: malformed with the line. A decimal number is the nearest
/// double; a fraction has to be one. Whether there are such vertices only the edits decide.
Result<std::vector<ScriptStep>> parse_script(std::string_view text, std::string_view name_for_errors = "");

/// A script of these steps; nothing is rounded, and it reads back as them but for the lines.
std::string format_script(std::span<const ScriptStep> steps);

/// One step of a sum: EditableSum::edit, undo or redo.
Result<FrameChanges> make_step(EditableSum& sum, const ScriptStep& step);

/// All that it takes to make a session again, and what came of each of its steps.
struct EditRecording {
  Region p, q;  ///< the operands before the first step
  Semantics semantics = Semantics::closed;
  bool reflect_q = false;
  FrameMode mode = FrameMode::automatic;
  std::size_t undo_steps = EditOptions().undo_steps;
  std::vector<ScriptStep> steps;
  std::vector<std::uint64_t> hashes;  ///< EditableSum::hash before the first step, and after each
};

/// A recording that begins with the state of a sum, which has these options. Requires: nothing to undo or redo.
EditRecording begin_recording(const EditableSum& sum, const EditOptions& options);
/// Adds a step that `sum` has made. O(n) for n vertices of the sum, in exact numbers: often more than the step.
void record_step(EditRecording& recording, const ScriptStep& step, const EditableSum& sum);

/// The recording as text. Nothing is rounded.
std::string format_recording(const EditRecording& recording);
/// The recording of such a text. Errors: truncated or malformed where the text is not complete, or not what was written
/// (it has a checksum); those of Region::create.
Result<EditRecording> parse_recording(std::string_view text, std::string_view name_for_errors = "");
/// The same of a file; "-" is standard input. Errors: cannot_open, and those of parse_recording.
Result<EditRecording> read_recording(const std::string& path);

/// What came of making a session again.
struct EditReplay {
  std::size_t steps = 0;  ///< that were made; those after the first that differs are not
  /// The first step after which the sum has another hash than was recorded, or that is refused; 0 is the sum before the
  /// first step, step k the k-th, counted from 1. None where all is as it was.
  std::optional<std::size_t> differs;
  std::optional<Error> refused;  ///< where that step is refused: why
};

/// Makes a session again and compares hash after hash. Errors: those of EditableSum::create; cancelled.
Result<EditReplay> replay(const EditRecording& recording, const Progress& progress = {});

}  // namespace dymsum
