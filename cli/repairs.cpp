#include "repairs.h"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "dymsum/names.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

/// The name of a kind as options have it, with hyphens.
template <class Kind>
std::string option_name(Kind kind) {
  std::string text(name(kind));
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

template <class Log>
std::string names(const Log& log) {
  std::string text;
  for (const auto kind : log.kinds()) text += (text.empty() ? "" : ",") + option_name(kind);
  return text;
}

/// A length of three digits that is no shorter.
std::string rounded_up(double length) {
  for (double up = length;; up *= 1.001) {
    std::ostringstream text;
    text << std::setprecision(3) << up;
    if (std::stod(text.str()) >= length) return text.str();
  }
}

std::string point_text(const Point& p) {
  std::ostringstream text;
  text << "(" << p.x << ", " << p.y << ")";
  return text.str();
}
std::string point_text(const Point3& p) {
  std::ostringstream text;
  text << "(" << p.x << ", " << p.y << ", " << p.z << ")";
  return text.str();
}

Json point_json(const Point& p) { return {p.x, p.y}; }
Json point_json(const Point3& p) { return {p.x, p.y, p.z}; }

template <class Log>
std::string text_of_positions(const Log& log) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (const auto kind : log.kinds()) {
    text += (text.empty() ? "" : "; ") + option_name(kind);
    std::size_t count = 0;
    for (const auto& mark : log.marks)
      if (mark.kind == kind && ++count <= kShown) text += (count == 1 ? " at " : ", ") + point_text(mark.at);
    if (count > kShown) text += " and more";
  }
  return text;
}

template <class Log>
Json json_of_log(const Log& log) {
  Json positions = Json::object();
  for (const auto& mark : log.marks) positions[option_name(mark.kind)].push_back(point_json(mark.at));
  return {{"changed", log.to_string()}, {"positions", positions}};
}

[[noreturn]] void refuse(const std::string& name) {
  std::string known;
  const auto add = [&](const std::string& one) { known += (known.empty() ? "" : ", ") + one; };
  for (const RegionRepairKind kind : all_region_repairs()) add(option_name(kind));
  for (const MeshRepairKind kind : all_mesh_repairs())
    if (kind != MeshRepairKind::duplicate_vertices) add(option_name(kind));
  throw Stop(kUsage, "--repair wants all, or some of these separated by commas: " + known + "; not '" + name + "'");
}

void add_named(const std::string& name, NamedRepairs& repairs) {
  bool known = false;
  for (const RegionRepairKind kind : all_region_repairs())
    if (name == option_name(kind)) known = true, repairs.planar.push_back(kind);
  for (const MeshRepairKind kind : all_mesh_repairs())
    if (name == option_name(kind)) known = true, repairs.solid.push_back(kind);
  if (!known) refuse(name);
}

}  // namespace

NamedRepairs named_repairs(const std::string& text) {
  if (text.empty() || text == "all") return {all_region_repairs(), all_mesh_repairs(), {}, {}};
  NamedRepairs repairs;
  std::istringstream names(text + ",");
  for (std::string name; std::getline(names, name, ',');) {
    const std::size_t colon = name.find(':');
    add_named(name.substr(0, colon), repairs);
    if (colon == std::string::npos) continue;
    const std::optional<double> length = finite_number(name.substr(colon + 1));
    if (!length || *length < 0) refuse(name);
    if (name.starts_with("cracks:")) repairs.crack_width = length;
    else if (name.starts_with("holes:")) repairs.hole_length = length;
    else refuse(name);
  }
  return repairs;
}

std::string remedy(const RegionRepairLog& log) {
  return " (--repair=" + names(log) + " repairs it: " + log.to_string() + ")";
}
std::string remedy(const MeshRepairLog& log, const std::string& options) {
  return " (" + options + "--repair=" + names(log) + " repairs it: " + log.to_string() + ")";
}
std::string remedy_of_holes(const MeshRepairLog& log) {
  std::string kinds = names(log);
  const std::string hole = option_name(MeshRepairKind::holes), length = rounded_up(log.longest_hole);
  kinds.replace(kinds.find(hole), hole.size(), hole + ":" + length);
  return " (a hole is longer around than half of the diagonal, or has more than 64 edges: --repair=" + kinds +
         " fills those of up to " + length + ": " + log.to_string() + ")";
}

std::string positions_text(const RegionRepairLog& log) { return text_of_positions(log); }
std::string positions_text(const MeshRepairLog& log) { return text_of_positions(log); }

Json repair_json(const RegionRepairLog& log) { return json_of_log(log); }
Json repair_json(const MeshRepairLog& log) { return json_of_log(log); }

}  // namespace dymsum::cli
