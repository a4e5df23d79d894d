// What the named repair of meshes reports.
#include <algorithm>
#include <cstdio>
#include <string>

#include "dymsum/named_repairs.h"
#include "spatial/mesh/mesh_repair.h"

namespace dymsum {

namespace spatial {

bool allows(const MeshRepairOptions& options, MeshRepairKind kind) {
  return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
}

RepairMarks::RepairMarks(const std::vector<MeshRepairMark>& known) {
  for (const MeshRepairMark& mark : known) add(mark.kind, mark.at);
}

void RepairMarks::add(MeshRepairKind kind, const Point3& at) {
  if (marks_[static_cast<std::size_t>(kind)].size() < MeshRepairLog::kMostMarks)
    marks_[static_cast<std::size_t>(kind)].push_back({kind, at});
}

std::vector<MeshRepairMark> RepairMarks::all() const {
  std::vector<MeshRepairMark> marks;
  for (const std::vector<MeshRepairMark>& of_kind : marks_) marks.insert(marks.end(), of_kind.begin(), of_kind.end());
  return marks;
}

}  // namespace spatial

std::vector<MeshRepairKind> all_mesh_repairs() {
  std::vector<MeshRepairKind> all;
  for (int k = 0; k <= static_cast<int>(MeshRepairKind::crossings); ++k) all.push_back(static_cast<MeshRepairKind>(k));
  return all;
}

std::vector<MeshRepairKind> MeshRepairLog::kinds() const {
  std::vector<MeshRepairKind> made;
  for (const MeshRepairMark& mark : marks)
    if (made.empty() || made.back() != mark.kind) made.push_back(mark.kind);
  return made;
}

std::string MeshRepairLog::to_string() const {
  std::string text = counts.changed() ? counts.to_string() : "";
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? one : many);
  };
  say(nested_bodies, "shell inside another body dropped", "shells inside other bodies dropped");
  say(duplicate_faces, "face given twice dropped", "faces given twice dropped");
  say(loose_walls, "loose wall inside the solid dropped", "loose walls inside the solid dropped");
  return text.empty() ? counts.to_string() : text;
}

std::string MeshRepairReport::to_string() const {
  std::string text;
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? one : many);
  };
  say(duplicate_vertices, "duplicate vertex merged", "duplicate vertices merged");
  say(unused_vertices, "unused vertex dropped", "unused vertices dropped");
  say(degenerate_faces, "face without area dropped", "faces without area dropped");
  say(needles, "needle that lay on its neighbours dropped", "needles that lay on their neighbours dropped");
  say(split_edges, "edge split at vertices of its neighbours", "edges split at vertices of their neighbours");
  if (largest_gap > 0) {
    char gap[32];
    std::snprintf(gap, sizeof gap, "%.3g", largest_gap);
    text += std::string(" (the furthest ") + gap + " off)";
  }
  say(cracks, "vertex merged across a crack", "vertices merged across cracks");
  if (cracks > 0) {
    char wide[32];
    std::snprintf(wide, sizeof wide, "%.3g", largest_crack);
    text += std::string(" (at most ") + wide + " wide)";
  }
  say(holes, "small hole filled", "small holes filled");
  say(split_faces, "face split into triangles", "faces split into triangles");
  say(reversed_faces, "face turned over", "faces turned over");
  say(reversed_shells, "shell turned right", "shells turned right");
  say(cavities, "shell that ran the same way as the one around it made a cavity",
      "shells that ran the same way as those around them made cavities");
  say(membranes, "face inside the solid dropped", "faces inside the solid dropped");
  if (united) {
    text += std::string(text.empty() ? "" : ", ") + "what crossed or overlapped united (" +
            std::to_string(united_crossings) + (united_crossings == 1 ? " new vertex" : " new vertices");
    if (united_distance > 0) {
      char within[48];
      std::snprintf(within, sizeof within, ", merged within %.3g", united_distance);
      text += within;
    }
    text += ")";
  }
  return text.empty() ? "nothing to repair" : text;
}

}  // namespace dymsum
