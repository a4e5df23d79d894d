// A path that is given, to be checked: poses or waypoints of a file, and what there is to say about them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "dymsum/path_check.h"
#include "inputs.h"
#include "json_report.h"

namespace dymsum::cli {

/// Poses one after the other, or waypoints as `path` writes them, with their moves and exact coordinates.
using GivenPath = std::variant<std::vector<ExactPose>, std::vector<Waypoint>>;

/// Lines `x,y,theta` with # comments, theta in radians or as 90deg; JSON `[[x, y, theta], ...]`; or the JSON of `path`.
/// x and y may be fractions, in JSON as texts.
/// Stops with bad input, with the line where there is one.
GivenPath read_path_file(const std::string& file);

/// The path of `file`, for a robot, grown or not, and the obstacle of the operands.
PathCheck checked(const Region& robot, const std::vector<Input>& inputs, const GivenPath& path, Touching touching,
                  const std::string& file);
std::size_t size_of(const GivenPath& path);

Json check_json(const PathCheck& check, const GivenPath& path);
/// "free: 12 pieces", or the first piece that is not.
std::string check_text(const PathCheck& check);

}  // namespace dymsum::cli
