#include "planar/planar_local.h"

#include <iostream>
#include <optional>
#include <sstream>

#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

struct PlanarPosition {
  PlanarBox box;
  std::optional<PlanarDisc> disc;
};

PlanarPosition position_of(const PlanarLocal& local) {
  PlanarPosition position;
  if (local.disc.empty()) {
    const std::vector<double> v = numbers_of(local.box, 4, "--box wants two corners X,Y,X,Y");
    if (!(v[0] < v[2] && v[1] < v[3]))
      throw Stop(kUsage, "--box wants the lower corner first, and an extent along both axes");
    position.box = {{v[0], v[1]}, {v[2], v[3]}};
    return position;
  }
  const std::vector<double> v = numbers_of(local.disc, 3, "--disc wants a place and a radius X,Y,R");
  if (!(v[2] > 0)) throw Stop(kUsage, "--disc wants a positive radius");
  position.disc = PlanarDisc{{v[0], v[1]}, v[2]};
  return position;
}

Json part_summary(const PlanarLocalPart& part) {
  return {{"where", name(part.where)},
          {"box", {part.box.low.x, part.box.low.y, part.box.high.x, part.box.high.y}},
          {"vertices", part.vertices.size()},
          {"edges", part.edges.size()},
          {"tight", {{"points", part.tight_points.size()}, {"segments", part.tight_segments.size()}}},
          {"near_segments", part.work.segments},
          {"collision_tests", part.work.collision_tests}};
}

Json edges_json(const std::vector<PlanarLocalPart::Edge>& edges) {
  Json list = Json::array();
  for (const PlanarLocalPart::Edge& e : edges)
    list.push_back(
        {{"vertices", {e.from, e.to}}, {"kind", name(e.contact.kind)}, {"p", e.contact.p}, {"q", e.contact.q}});
  return list;
}

Json exact_part_json(const PlanarLocalPart& part) {
  Json json = part_summary(part), vertices = Json::array();
  for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
    const RationalPoint at = part.exact(v);
    vertices.push_back(
        {{"at", {part.vertices[v].x, part.vertices[v].y}}, {"exact", {at.x.to_string(), at.y.to_string()}}});
  }
  json["vertex_list"] = std::move(vertices);
  json["edge_list"] = edges_json(part.edges);
  json["tight_segments"] = edges_json(part.tight_segments);
  json["tight_points"] = part.tight_points;
  return json;
}

std::string part_text(const PlanarLocalPart& part) {
  std::ostringstream out;
  if (part.where == PlanarLocalPart::Where::crossed)
    out << "  " << counted(part.edges.size(), "edge") << ", " << counted(part.vertices.size(), "vertex", "vertices")
        << "; tight: " << counted(part.tight_segments.size(), "segment") << ", "
        << counted(part.tight_points.size(), "point") << "\n";
  else out << "  nothing bounds the sum there: it lies " << name(part.where) << "\n";
  return out.str();
}

std::string part_output(const PlanarLocal& local, const PlanarLocalPart& part, const std::string& file) {
  if (format_name(file, local.to).ends_with(".svg")) return part_svg(part);
  return exact_part_json(part).dump(1) + "\n";
}

PlanarLocalPart compute(const PlanarLocal& local, const PlanarPosition& position, const std::vector<Input>& inputs,
                        const PlanarPose& pose, const Progress& progress) {
  PlanarLocalOptions options;
  options.engine = local.engine, options.progress = progress;
  options.memory = memory_bytes(local.memory_mb);
  PlanarLocalSum sum = require_of(inputs, PlanarLocalSum::create(inputs[0].region, inputs[1].region, options));
  return require_of(inputs, position.disc ? sum.in(*position.disc, pose) : sum.in(position.box, pose));
}

}  // namespace

ExitCode run_planar_local(const PlanarLocal& local) {
  const PlanarPosition position = position_of(local);
  PlanarPose pose;
  if (local.angle.given())
    pose.rotation = require_option(Orientation::nearest(read_angle(local.angle).radians()), "--angle");
  for (const std::string& file : local.files)
    if (const std::string name = format_name(file, local.to); !name.ends_with(".json") && !name.ends_with(".svg"))
      throw Stop(kUsage, "-o writes a part of a planar sum as .json, .svg or .html: " + file);
  std::ostream& out = report_stream(local.files, local.report.json);
  const std::vector<Input> inputs = read_inputs(local.operands, local.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const auto [part, timing] =
      timed(local.report.repeat, [&] { return compute(local, position, inputs, pose, bar->callback()); });
  bar.reset();
  std::vector<std::string> texts;
  for (const std::string& file : local.files) texts.push_back(part_output(local, part, file));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(local.files[i], texts[i]);
  if (local.report.json) {
    Json json = report_head("local-sum", inputs_json(inputs), tier_of(inputs[0].region, inputs[1].region), timing);
    json["engine"] = local.engine_name;
    json.update(part_summary(part));
    print_report(json);
  } else {
    out << "local-sum of " << inputs[0].file << " and " << inputs[1].file << "\n" << part_text(part);
    print_times(out, timing);
  }
  return kDone;
}

}  // namespace dymsum::cli
