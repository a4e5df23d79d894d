#include "arguments.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "dymsum/region_io.h"
#include "exit_code.h"
#include "inputs.h"

namespace dymsum::cli {
namespace {

/// One name for one file, however its path is written.
std::string position_of(const std::string& output) {
  std::error_code unknown;
  const std::filesystem::path position = std::filesystem::absolute(written_path(output), unknown);
  return output == "-" || unknown ? output : std::filesystem::weakly_canonical(position, unknown).string();
}

void refuse_repeated(const CLI::Option& outputs) {
  std::set<std::string> positions;
  for (const std::string& output : outputs.results())
    if (!positions.insert(position_of(output)).second)
      throw Stop(kUsage, "-o " + output + " is given twice: one result would replace the other");
}

bool is_output(const CLI::Option& option) { return option.check_name("-o") || option.check_name("OUT"); }

void refuse_replaced_input(const CLI::App& verb, const std::string& output) {
  std::error_code unknown;
  const std::filesystem::path position = written_path(output);
  if (!std::filesystem::is_regular_file(position, unknown)) return;
  for (const CLI::Option* option : verb.get_options()) {
    if (is_output(*option)) continue;
    for (const std::string& value : option->results())
      if (std::filesystem::equivalent(file_of_shape(value), position, unknown))
        throw Stop(kUsage,
                   "the output " + output + " is the file that " + value + " is read from, and would replace it");
  }
}

}  // namespace

void check_arguments(const CLI::App& verb) {
  bool input_taken = false;
  for (const CLI::Option* option : verb.get_options()) {
    const bool output = is_output(*option);
    if (option->check_name("-o")) refuse_repeated(*option);
    for (const std::string& value : option->results()) {
      if (value.empty()) throw Stop(kUsage, option->get_name() + " is given as an empty text");
      const bool file = output && !value.ends_with('/');  // verbs that write into a folder make it
      if (file) require(check_writable(value));
      if (file) refuse_replaced_input(verb, value);
      if (output || value != "-") continue;
      if (input_taken) throw Stop(kUsage, "standard input can be only one of the operands and files that are read");
      input_taken = true;
    }
  }
}

}  // namespace dymsum::cli
