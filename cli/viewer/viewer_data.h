// What the viewer is told: the inputs and options of a command (docs/design/viewer.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "inputs.h"
#include "json_report.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// A file as the page takes it: its name without folders, whose extension is the format, and its bytes.
struct ViewerInput {
  std::string name, bytes;
};

struct ViewerData {
  std::string page;  ///< home, sum, obstacle, solids, discs or nesting
  std::vector<ViewerInput> inputs;
  Json parameters = Json::object();
  bool live = false;
  std::size_t revision = 0;
};

/// What the page calls an operand, without the extension of a format: "gear" of gear.poly, "two 8" of two.json#8.
std::string shape_name(const std::string& operand);

/// The input that an operand names: the bytes of FILE, of "-" or of a footprint. What is not a whole file as it stands
/// is given as the same regions in .wkt, or the same solid in .off: one shape of several, maps, and what is repaired or
/// taken as its hull, unless it cannot be. Stops with bad input where the file cannot be read.
ViewerInput viewer_input(const std::string& operand, const InputOptions& options);

/// The verb and the options that were given to it, but those of outputs and reports: flags are true, others text.
Json viewer_parameters(const CLI::App& verb);

/// The object as JSON text in which no "<" is left.
std::string viewer_json(const ViewerData& data);

}  // namespace dymsum::cli
