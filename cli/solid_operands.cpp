#include "solid_operands.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "exit_code.h"

namespace dymsum::cli {

bool are_solid(const std::vector<std::string>& files) {
  std::size_t solids = 0;
  for (const std::string& file : files) solids += names_solid(file);
  if (solids != 0 && solids != files.size()) throw Stop(kUsage, "one operand is planar and the other one solid");
  return solids != 0;
}

std::vector<SolidInput> read_convex_solids(const std::vector<std::string>& files, const InputOptions& options) {
  std::vector<SolidInput> inputs;
  for (const std::string& file : files) {
    inputs.push_back(read_solid(file, options));
    // Told here, where the file is known.
    if (std::optional<Error> error = convexity_error(inputs.back().mesh)) {
      error->evidence.file = file;
      stop_with(*error);
    }
  }
  return inputs;
}

Point3 parse_point(const std::string& text, const std::string& option) {
  Point3 p;
  const char* at = text.c_str();
  for (double* c : {&p.x, &p.y, &p.z}) {
    char* end = nullptr;
    *c = std::strtod(at, &end);
    const bool last = c == &p.z;
    if (end == at || !std::isfinite(*c) || *end != (last ? '\0' : ',')) throw Stop(kUsage, option + " wants three numbers, X,Y,Z: " + text);
    at = end + 1;
  }
  return p;
}

}  // namespace dymsum::cli
