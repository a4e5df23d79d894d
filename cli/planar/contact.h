// Contacts of a robot and an obstacle in reports.
#pragma once

#include <optional>
#include <string>

#include "dymsum/planar_sum.h"
#include "json_report.h"

namespace dymsum::cli {

/// {"kind", "obstacle", "robot"}: the kind is vertex_on_edge or edge_on_vertex, of the robot on the obstacle, then the
/// indices of their features; null where there is no contact.
Json contact_json(const std::optional<Contact>& contact);
/// "edge 5 of the obstacle and vertex 1 of the robot".
std::string contact_text(const Contact& contact);

}  // namespace dymsum::cli
