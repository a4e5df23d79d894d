// What the command line requests of the verb scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"

namespace dymsum::cli {

struct ScaleCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::vector<std::string> operands{"", ""};
  std::string sweep, ratio, copies, scaled = "p", mode = "automatic", semantics = "closed";
  std::vector<std::string> at, files;
  std::size_t threads = 1;
  double memory_mb = 0;  ///< 0: no limit
  bool robot = false;    ///< Q is a robot: sums with -Q
  bool events = false;
  std::string range, next;           ///< of scales whose events are requested; only the first of a kind
  std::optional<std::size_t> frame;  ///< of solids: the one that is written
  ReportOptions report;
  InputOptions input;
};

/// The pieces between the commas of an option's values, empty ones too.
std::vector<std::string> listed(const std::vector<std::string>& values);
/// An exact scale; a Stop with wrong usage for what is none.
Scale read_scale(const std::string& text, const std::string& option);
MovingOptions scaling_options(const ScaleCommand& command);

/// scale --copies: the sums of the copies of a master shape that a file lists.
ExitCode run_copies(const ScaleCommand& command);

}  // namespace dymsum::cli
