// -o FILE.html: the viewer with the inputs and options of a command.
#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "inputs.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// What the viewer shows of a command.
struct ViewerPage {
  const CLI::App* verb = nullptr;
  std::string planar, solid;  ///< the page for operands of either kind; empty: there is none
  bool has_own = false;       ///< the verb writes a page of its own where there is no viewer
};

/// Runs an action that writes `files`, and takes those that end in .html out of them first: when it has ended they are
/// written as the viewer with these operands. Stops, before anything long, where there is no viewer, unless the verb
/// has a page of its own, which it then writes; with wrong usage where the viewer shows no such operands.
ExitCode run_with_pages(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input,
                        std::vector<std::string>& files, const Action& action);

}  // namespace dymsum::cli
