#include "solid/solid_operands.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "exit_code.h"
#include "numbers.h"
#include "solid/nearly_convex.h"
#include "solid/solid_results.h"

namespace dymsum::cli {

bool are_solid(const std::vector<std::string>& files, const InputOptions& options) {
  std::string solid, planar;
  for (const std::string& file : files) (names_solid(file, options) ? solid : planar) = shown_file(file);
  if (!planar.empty())
    for (const std::string& file : files) refuse_unknown_extension(file);
  if (!solid.empty() && !planar.empty())
    throw Stop(kUsage, solid + " is a solid and " + planar + " is not: all operands have to be solids, or none");
  return planar.empty();
}

void require_planar(const std::string& verb, const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (names_solid(file, {}))
      throw Stop(kUsage, verb + " is for planar operands; " + shown_file(file) + " is a solid");
}

void require_solid(const std::string& verb, const std::vector<std::string>& files, const InputOptions& options) {
  if (!are_solid(files, options))
    throw Stop(kUsage, verb + " is for solids: .off .obj .stl .ply .glb .3mf, or an exact result of them, .json, not " +
                           shown_file(files[0]));
}

std::vector<SolidInput> read_solids(const std::vector<std::string>& files, const InputOptions& options) {
  std::vector<SolidInput> inputs = read_solids_and_results(files, options);
  refuse_fractions(inputs, options.quiet);
  return inputs;
}

std::vector<SolidInput> read_solids_and_results(const std::vector<std::string>& files, const InputOptions& options) {
  refuse_unused_format(files, options);
  if (!options.planes.empty()) return read_by_planes(files, options);
  std::vector<SolidInput> inputs;
  for (const std::string& file : files) {
    inputs.push_back(read_solid(file, options));
    if (!options.hull && !options.quiet && !inputs.back().result) report_nearly_convex(inputs.back());
  }
  return inputs;
}

std::vector<SolidInput> read_convex_solids(const std::vector<std::string>& files, const InputOptions& options) {
  std::vector<SolidInput> inputs = read_solids(files, options);
  for (const SolidInput& input : inputs) {
    // Told here, where the file is known.
    if (std::optional<Error> error = convexity_error(input.mesh)) {
      error->evidence.file = shown_file(input.file);
      error->message += " (only convex solids are taken; --hull takes the convex hull)";
      stop_with(*error);
    }
  }
  return inputs;
}

Point3 parse_point(const std::string& text, const std::string& option) {
  const std::vector<double> c = numbers_of(text, 3, option + " wants three numbers, X,Y,Z");
  return {c[0], c[1], c[2]};
}

}  // namespace dymsum::cli
