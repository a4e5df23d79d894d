// Pairs of solid operands of a command line.
#pragma once

#include <string>
#include <vector>

#include "solid/solid_inputs.h"

namespace dymsum::cli {

/// Whether all operands are solids, told by their extensions or by what standard input holds; a Stop when only some
/// are, and for extensions that are neither of regions nor of solids.
bool are_solid(const std::vector<std::string>& files, const InputOptions& options);
/// Stops for verbs that are for planar operands only, or for solids, when there are others.
void require_planar(const std::string& verb, const std::vector<std::string>& files);
void require_solid(const std::string& verb, const std::vector<std::string>& files, const InputOptions& options);
/// The solids of files, of any shape. Stops for exact results whose vertices are fractions.
std::vector<SolidInput> read_solids(const std::vector<std::string>& files, const InputOptions& options);
/// The same with such results.
std::vector<SolidInput> read_solids_and_results(const std::vector<std::string>& files, const InputOptions& options);
/// The convex solids of files.
std::vector<SolidInput> read_convex_solids(const std::vector<std::string>& files, const InputOptions& options);

/// "x,y,z".
Point3 parse_point(const std::string& text, const std::string& option);

}  // namespace dymsum::cli
