// Options that several verbs share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "inputs.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// How a verb reports what it found.
struct ReportOptions {
  bool json = false;
  std::size_t repeat = 1;
};

/// Declares two required operands by these names. Requires: `operands` holds two.
void add_operands(CLI::App& verb, const std::string& first, const std::string& second, std::vector<std::string>& operands);

/// Declares --json and --repeat.
void add_report_options(CLI::App& verb, ReportOptions& options, const std::string& repeated);

/// Declares --repair and --from.
void add_input_options(CLI::App& verb, InputOptions& options);

}  // namespace dymsum::cli
