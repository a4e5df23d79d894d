// -o FILE.html: the viewer with the inputs and options of a command.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "exit_code.h"
#include "inputs.h"
#include "json_report.h"
#include "viewer/viewer_data.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// Whether a file's name requests a page.
bool is_page(const std::string& file);

/// What the viewer shows of a command.
struct ViewerPage {
  const CLI::App* verb = nullptr;
  std::string planar, solid;      ///< the page for operands of either kind; empty: there is none
  Json instead = Json::object();  ///< parameters that go before the options as they were given; null leaves one out
};

/// Runs an action that writes `files`, and takes those that end in .html out of them first: when it has ended, and the
/// input was not bad, they are written as the viewer with these operands. Stops, before anything is computed, where
/// there is no viewer; with wrong usage where the viewer shows no such operands.
ExitCode run_with_pages(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input,
                        std::vector<std::string>& files, const Action& action);

/// Inputs of a page that are no operands as they stand; called where there is a viewer and before the action.
using ViewerInputs = std::function<std::vector<ViewerInput>()>;
/// The same with inputs that the verb makes, on this page.
ExitCode run_with_pages(const CLI::App& verb, const std::string& page, const ViewerInputs& inputs,
                        std::vector<std::string>& files, const Action& action);

/// Pages of the one shape that a verb makes.
class ResultPages {
 public:
  ResultPages() = default;
  /// Takes the files that end in .html out of `files`. Stops where there are some and no viewer.
  ResultPages(const CLI::App& verb, std::vector<std::string>& files);

  bool any() const { return !files_.empty(); }
  /// The first of them, which messages name. Requires: any().
  const std::string& file() const { return files_.front(); }
  /// Stops with bad input. Requires: any().
  [[noreturn]] void stop_with_nothing_to_show() const;
  /// Writes them with a shape, whose name ends in .off or .wkt. Requires: any().
  void write(ViewerInput shape) const;

 private:
  std::string viewer_;
  std::vector<std::string> files_;
  Json parameters_;
};

}  // namespace dymsum::cli
