// Edits of solids as text, and recordings of what was done to an EditableSolidSum: as edit_script.h for regions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/edit_script.h"
#include "dymsum/editable_solid_sum.h"

namespace dymsum {

struct SolidScriptStep {
  ScriptAction action = ScriptAction::edit;
  std::vector<SolidEdit> edits;  ///< at least one, where it is a step of edits
  std::int64_t line = 0;         ///< on which it begins, from 1; 0 where it was not read
  friend bool operator==(const SolidScriptStep&, const SolidScriptStep&) = default;
};

/// The steps of a script (docs/guide/editing.md). Errors: malformed with the line.
Result<std::vector<SolidScriptStep>> parse_solid_script(std::string_view text, std::string_view name_for_errors = "");
/// A script of these steps; nothing is rounded, and it reads back as them but for the lines.
std::string format_solid_script(std::span<const SolidScriptStep> steps);

/// One step of a sum: EditableSolidSum::edit, undo or redo.
Result<SolidEditWork> make_step(EditableSolidSum& sum, const SolidScriptStep& step);

/// All that it takes to make a session again, and what came of each of its steps.
struct SolidEditRecording {
  Mesh p, q;  ///< the operands before the first step
  Semantics semantics = Semantics::closed;
  bool reflect_q = false;
  bool tight = true;
  std::size_t undo_steps = SolidEditOptions().undo_steps;
  std::vector<SolidScriptStep> steps;
  std::vector<std::uint64_t> hashes;  ///< EditableSolidSum::hash before the first step, and after each
};

/// A recording that begins with the state of a sum, which has these options. Requires: nothing to undo or redo.
SolidEditRecording begin_recording(const EditableSolidSum& sum, const SolidEditOptions& options);
/// Adds a step that `sum` has made. O(n) for n vertices of the sum, in exact numbers.
void record_step(SolidEditRecording& recording, const SolidScriptStep& step, const EditableSolidSum& sum);

/// The recording as text. Nothing is rounded.
std::string format_recording(const SolidEditRecording& recording);
/// The recording of such a text. Errors: truncated or malformed, as parse_recording; those of Mesh::create.
Result<SolidEditRecording> parse_solid_recording(std::string_view text, std::string_view name_for_errors = "");
/// The same of a file; "-" is standard input. Errors: cannot_open, and those of parse_solid_recording.
Result<SolidEditRecording> read_solid_recording(const std::string& path);

/// Makes a session again and compares hash after hash. Errors: those of EditableSolidSum::create; cancelled.
Result<EditReplay> replay(const SolidEditRecording& recording, const Progress& progress = {});

}  // namespace dymsum
