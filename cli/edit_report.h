// What edit says about scripts, in the plane and in space.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dymsum/edit_script.h"
#include "inputs.h"
#include "json_report.h"
#include "timing.h"

namespace dymsum::cli {

/// A step that was refused.
struct RefusedStep {
  std::size_t step = 0;
  Error error;
};

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);
/// What a report says first of a step: its index from 1, its line, what it does and of how many edits it is.
Json step_head(std::size_t step, std::int64_t line, ScriptAction action, std::size_t edits);
/// Edits of a script on one line, cut where it is long.
std::string on_one_line(const std::vector<std::string>& edits);
/// The times of steps; of the first sum where there are none.
Timing timing_of_steps(const std::vector<double>& ms, double static_ms);

/// Reports a session that was made again; kNo where a step differs. `text` is that of a step, from 1.
ExitCode report_replay(const std::string& file, const EditReplay& made, std::size_t steps, const Timing& timing,
                       Json head, bool as_json, const std::function<std::string(std::size_t)>& text);

}  // namespace dymsum::cli
