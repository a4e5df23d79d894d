// dymsum view FILES
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include "options.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"
#include "viewer/serving.h"
#include "viewer/viewer_data.h"
#include "viewer/viewer_file.h"
#include "viewer/watched_inputs.h"

namespace dymsum::cli {
namespace {

struct ViewCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> files;
  std::string page;
  std::size_t port = 0;
  bool no_open = false;
  InputOptions input;
};

std::size_t most_inputs(const std::string& page) {
  return page == "home" ? 0 : page == "discs" ? 1 : page == "nesting" ? 1000 : 2;
}

/// Whether a file holds several shapes, as nesting instances do.
bool holds_several(const ViewCommand& command) {
  return command.files.size() == 1 && read_all(command.files[0], command.input).size() > 1;
}

/// The page that was requested, or follows from the files.
std::string page_of(const ViewCommand& command) {
  if (command.files.empty()) return command.page.empty() ? "home" : command.page;
  const bool solid = are_solid(command.files, command.input);
  std::string page = command.page;
  if (page.empty()) page = solid ? "solids" : command.files.size() > 2 || holds_several(command) ? "nesting" : "sum";
  if (solid != (page == "solids"))
    throw Stop(kUsage, "--page " + page + " shows " + (solid ? "regions, not solids: " : "solids, not regions: ") +
                           shown_file(command.files[0]));
  if (command.files.size() > most_inputs(page))
    throw Stop(kUsage, "the page " + page + " shows at most " + counted(most_inputs(page), "file") + ", not " +
                           std::to_string(command.files.size()));
  return page;
}

/// Stops with the error of the first file that is not what the page shows.
void check_inputs(const ViewCommand& command, const std::string& page) {
  if (page == "solids") {
    read_solids_and_results(command.files, command.input);
  } else if (page != "nesting") {
    read_inputs(command.files, command.input);
  } else {
    for (const std::string& file : command.files)
      for (NamedShape& shape : read_all(file, command.input)) {
        const std::string which = shape.name.empty() ? file : file + "#" + shape.name;
        require(make_input(std::move(shape), which, command.input));
      }
  }
}

/// Tells which files changed, and what is wrong with them now.
void report_changes(const ViewCommand& command, const std::string& page, const std::vector<std::size_t>& changed) {
  for (const std::size_t i : changed) std::cerr << command.files[i] << " has changed\n";
  // What another file has become meanwhile, as the end of a pipe, may take for ever to read.
  const auto is_there = [](const std::string& file) {
    std::error_code unknown;
    return file == "-" || is_footprint(file) || std::filesystem::is_regular_file(file_of_shape(file), unknown);
  };
  if (!std::all_of(command.files.begin(), command.files.end(), is_there)) return;
  try {
    check_inputs(command, page);
  } catch (const Stop& stop) {
    std::cerr << stop.what() << "\n";
  }
}

ExitCode run_view(const ViewCommand& command) {
  const std::string viewer = viewer_text(), page = page_of(command);
  refuse_unused_format(command.files, command.input);
  check_inputs(command, page);
  WatchedInputs watched(command.files, command.input);
  serve(viewer, {page, watched.inputs(), viewer_parameters(*command.parser), true, 0}, watched,
        {static_cast<int>(command.port), !command.no_open,
         [&](const std::vector<std::size_t>& changed) { report_changes(command, page, changed); }});
  return kDone;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App& verb =
      *app.add_subcommand("view", "Opens files in a browser, where they can be dragged, scaled and turned");
  command->parser = &verb;
  verb.add_option("FILES", command->files,
                  "Regions or solids: files, FILE#NAME for one shape of several, or - for standard input; none: a "
                  "gallery of examples")
      ->type_name("");
  verb.add_option("--page", command->page,
                  "What is shown: sum, obstacle (of a robot and an obstacle), discs (that grow), nesting; of solids "
                  "solids [by the files]")
      ->check(CLI::IsMember({"sum", "obstacle", "solids", "discs", "nesting"}));
  whole_within(verb.add_option("--port", command->port, "Of 127.0.0.1; 0: a free one"), 0, 65535)
      ->type_name("N")
      ->capture_default_str();
  verb.add_flag("--no-open", command->no_open, "Print the address only, and open no browser");
  add_solid_input_options(verb, command->input);
  verb.footer(
      "The page follows the files: it shows them anew whenever one is written. Nothing is reachable from other\n"
      "machines, and nothing is loaded from them.\n"
      "Examples: dymsum view gear.poly disc.wkt\n"
      "          dymsum view robot.wkt rooms.wkt --page obstacle\n"
      "          dymsum view part.off tool.stl --port 8080 --no-open");
  verb.callback([command, &action] { action = [command] { return run_view(*command); }; });
}

}  // namespace dymsum::cli
