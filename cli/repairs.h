// The repairs that --repair names, and what is reported of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/named_repairs.h"
#include "json_report.h"

namespace dymsum::cli {

/// What --repair says: "all", or names of repairs separated by commas, of which cracks may have a width, cracks:0.01,
/// and holes a length around, holes:20. Stops with wrong usage for names of none.
struct NamedRepairs {
  std::vector<RegionRepairKind> planar;
  std::vector<MeshRepairKind> solid;
  std::optional<double> crack_width, hole_length;
};
NamedRepairs named_repairs(const std::string& text);

/// How an error of an operand ends that repairs take, with what they change: " (--repair=t-junctions,holes repairs it:
/// ...)". Options that belong to it stand in front.
std::string remedy(const RegionRepairLog& log);
std::string remedy(const MeshRepairLog& log, const std::string& options = "");

/// The same where holes are filled that are larger than those that are filled unless a length says more, which it
/// names.
std::string remedy_of_holes(const MeshRepairLog& log);

/// "reversed-rings at (0, 0), (3, 1) and more; ...".
std::string positions_text(const RegionRepairLog& log);
std::string positions_text(const MeshRepairLog& log);

/// {"changed": in words, "positions": {"reversed-rings": [[0, 0], ...]}}.
Json repair_json(const RegionRepairLog& log);
Json repair_json(const MeshRepairLog& log);

}  // namespace dymsum::cli
