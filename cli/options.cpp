#include "options.h"

#include <CLI/CLI.hpp>

namespace dymsum::cli {

void add_operands(CLI::App& verb, const std::string& first, const std::string& second, std::vector<std::string>& operands) {
  const char* const what = "File, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option(first, operands[0], what)->required();
  verb.add_option(second, operands[1], what)->required();
}

void add_report_options(CLI::App& verb, ReportOptions& options, const std::string& repeated) {
  verb.add_flag("--json", options.json, "Print one JSON object with the result's summary");
  verb.add_option("--repeat", options.repeat, repeated)
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000000}))
      ->capture_default_str();
}

void add_input_options(CLI::App& verb, InputOptions& options) {
  verb.add_flag("--repair", options.repair,
                "Merge duplicate and collinear vertices, fix orientation, and say on standard error what changed");
  verb.add_option("--from", options.from, "Format of standard input; otherwise told from its first characters")
      ->check(CLI::IsMember({"poly", "wkt", "geojson", "svg", "json"}));
}

}  // namespace dymsum::cli
