#include "planar/configuration.h"

#include <cmath>
#include <optional>

#include "exit_code.h"
#include "planar/query_file.h"

namespace dymsum::cli {
namespace {

/// What is wrong with a configuration; nothing where it is one.
std::string fault_of(const std::optional<QueryLine>& q) {
  constexpr double kLargest = 0x1p400;  // as for the vertices of robots and obstacles
  if (!q || !q->theta) return "wants x,y,theta with theta in radians, or in degrees as 90deg";
  return std::abs(q->x) > kLargest || std::abs(q->y) > kLargest ? "has a coordinate larger than 2^400" : "";
}

}  // namespace

PlacedRobot read_placed_robot(const std::string& text, const char* option) {
  const std::optional<QueryLine> q = query_in(text, Fractions::taken);
  if (const std::string fault = fault_of(q); !fault.empty())
    throw Stop(kUsage, std::string(option) + " " + fault + ", not '" + text + "'");
  return {q->at(), q->theta->radians()};
}

std::vector<PlacedRobot> read_placed_robots(const std::string& file) {
  std::vector<PlacedRobot> all;
  const auto take = [&](const QueryLine& q, const Refuse& refuse) {
    if (const std::string fault = fault_of(q); !fault.empty()) refuse("a line " + fault);
    all.push_back({q.at(), q.theta->radians()});
  };
  for_each_query(file, take, Fractions::taken);
  return all;
}

}  // namespace dymsum::cli
