#include "viewer/viewer_pages.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <utility>

#include "outputs.h"
#include "solid/solid_operands.h"
#include "viewer/viewer_file.h"

namespace dymsum::cli {
namespace {

/// Takes those out of the files that end in .html.
std::vector<std::string> taken_pages(std::vector<std::string>& files) {
  std::vector<std::string> pages;
  const auto first =
      std::stable_partition(files.begin(), files.end(), [](const std::string& f) { return !is_page(f); });
  pages.assign(std::make_move_iterator(first), std::make_move_iterator(files.end()));
  files.erase(first, files.end());
  return pages;
}

/// The page that shows these operands; a Stop where there is none.
std::string page_of(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input) {
  const bool solid = are_solid(operands, input);
  std::string name = solid ? page.solid : page.planar;
  if (!name.empty() && operands.size() <= 2) return name;
  throw Stop(kUsage, "-o FILE.html: the viewer shows no " + page.verb->get_name() + " of " +
                         (operands.size() > 2 ? "more than two operands"
                          : solid             ? "solids"
                                              : "regions"));
}

ExitCode run_and_write(const std::string& text, std::vector<std::string>& files, const Action& action) {
  const std::vector<std::string> pages = taken_pages(files);
  const ExitCode code = action();
  if (code == kBadInput) return code;  // as info reports it
  for (const std::string& file : pages) write_text(file, text);
  return code;
}

}  // namespace

bool is_page(const std::string& file) { return file.ends_with(".html"); }

ExitCode run_with_pages(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input,
                        std::vector<std::string>& files, const Action& action) {
  if (std::none_of(files.begin(), files.end(), is_page)) return action();
  const std::string viewer = viewer_text();
  ViewerData data;
  data.page = page_of(page, operands, input);
  for (const std::string& operand : operands) data.inputs.push_back(viewer_input(operand, input));
  data.parameters = viewer_parameters(*page.verb);
  data.parameters.merge_patch(page.instead);
  return run_and_write(viewer_with(viewer, viewer_json(data)), files, action);
}

ExitCode run_with_pages(const CLI::App& verb, const std::string& page, const ViewerInputs& inputs,
                        std::vector<std::string>& files, const Action& action) {
  if (std::none_of(files.begin(), files.end(), is_page)) return action();
  const std::string viewer = viewer_text();
  const ViewerData data{page, inputs(), viewer_parameters(verb)};
  return run_and_write(viewer_with(viewer, viewer_json(data)), files, action);
}

ResultPages::ResultPages(const CLI::App& verb, std::vector<std::string>& files) : files_(taken_pages(files)) {
  if (!any()) return;
  viewer_ = viewer_text();
  parameters_ = viewer_parameters(verb);
}

void ResultPages::stop_with_nothing_to_show() const {
  throw Stop(kBadInput, file() + ": this has no area or volume that the viewer could show");
}

void ResultPages::write(ViewerInput shape) const {
  const std::string page = shape.name.ends_with(".off") ? "solids" : "sum";
  const std::string text = viewer_with(viewer_, viewer_json({page, {std::move(shape)}, parameters_}));
  for (const std::string& file : files_) write_text(file, text);
}

}  // namespace dymsum::cli
