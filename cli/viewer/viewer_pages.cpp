#include "viewer/viewer_pages.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>

#include "outputs.h"
#include "pictures/frame_pictures.h"
#include "solid/solid_operands.h"
#include "viewer/viewer_data.h"
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

std::string page_text(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input) {
  const std::string viewer = viewer_text();
  ViewerData data;
  const bool solid = are_solid(operands, input);
  data.page = solid ? page.solid : page.planar;
  if (data.page.empty() || operands.size() > 2)
    throw Stop(kUsage, "-o FILE.html: the viewer shows no " + page.verb->get_name() + " of " +
                           (operands.size() > 2 ? "more than two operands"
                            : solid             ? "solids"
                                                : "regions"));
  for (const std::string& operand : operands) data.inputs.push_back(viewer_input(operand, input));
  data.parameters = viewer_parameters(*page.verb);
  return viewer_with(viewer, viewer_json(data));
}

}  // namespace

ExitCode run_with_pages(const ViewerPage& page, const std::vector<std::string>& operands, const InputOptions& input,
                        std::vector<std::string>& files, const Action& action) {
  if (std::none_of(files.begin(), files.end(), is_page) || (page.has_own && !find_viewer())) return action();
  const std::string text = page_text(page, operands, input);
  const std::vector<std::string> pages = taken_pages(files);
  const ExitCode code = action();
  for (const std::string& file : pages) write_text(file, text);
  return code;
}

}  // namespace dymsum::cli
