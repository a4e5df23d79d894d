// dymsum info F
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "planar/tier.h"
#include "report.h"
#include "solid/solid_info.h"
#include "solid/solid_inputs.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct InfoCommand {
  std::string file;
  bool json = false;
  InputOptions input;
  OutputOptions output;
  bool draws = false;  ///< a picture or a page, which show one shape
};

/// One shape of the file: its region when it is valid.
struct Shape {
  std::string name;
  Result<Input> input;
};

Json shape_json(const Shape& shape) {
  Json json = {{"name", shape.name}, {"valid", shape.input.ok()}};
  if (!shape.input) {
    json["error"] = error_json(shape.input.error());
    return json;
  }
  if (shape.input->result) {
    json["exact"] = true;
    json.update(size_json(*shape.input->result, false));
    return json;
  }
  const Region& region = shape.input->region;
  json.update({{"tier", tier_of(region)},
               {"outer", region.parts().size()},
               {"holes", region.hole_count()},
               {"vertices", region.vertex_count()},
               {"polylines", region.polylines().size()},
               {"points", region.points().size()},
               {"bounds", region.empty() ? Json(nullptr) : Json(bounds(region))},
               {"area", area_json(region)}});
  return json;
}

void print_result_of(std::ostream& out, const PlanarSum& sum) {
  out << "valid, an exact result: " << counted(sum.parts.size(), "part") << ", " << counted(sum.hole_count(), "hole")
      << ", " << counted(sum.vertex_count(), "vertex", "vertices") << ", " << counted(sum.segments.size(), "segment")
      << ", " << counted(sum.points.size(), "point") << "\n  tight: " << counted(sum.tight_segments.size(), "segment")
      << ", " << counted(sum.tight_points.size(), "point") << "\n  area " << shown_area(sum) << "\n";
}

void print_shape(std::ostream& out, const Shape& shape) {
  if (!shape.name.empty()) out << shape.name << ": ";
  if (!shape.input) {
    out << "not valid (" << name(shape.input.error().code) << ")\n";
    return;
  }
  if (shape.input->result) return print_result_of(out, *shape.input->result);
  const Region& region = shape.input->region;
  const std::array<double, 4> box = bounds(region);
  const auto precision = out.precision(17);
  out << "valid, " << counted(region.parts().size(), "part") << ", " << counted(region.hole_count(), "hole") << ", "
      << counted(region.vertex_count(), "vertex", "vertices");
  if (!region.polylines().empty()) out << ", " << counted(region.polylines().size(), "polyline");
  if (!region.points().empty()) out << ", " << counted(region.points().size(), "isolated point");
  if (!region.empty()) out << "\n  bounds [" << box[0] << ", " << box[2] << "] x [" << box[1] << ", " << box[3] << "]";
  print_notes(out, shape.input->notes);
  out << "\n  area " << shown_area(region) << "\n  " << tier_name(tier_of(region)) << " integers\n";
  out.precision(precision);
}

Json file_json(const std::vector<Shape>& shapes, const Timing& timing) {
  std::vector<Input> inputs;
  Json list = Json::array();
  int tier = 29;
  for (const Shape& shape : shapes) {
    list.push_back(shape_json(shape));
    if (!shape.input) continue;
    inputs.push_back(*shape.input);
    const int bits = shape.input->result ? 0 : list.back()["tier"].get<int>();
    tier = tier == 0 || bits == 0 ? 0 : std::max(tier, bits);
  }
  Json json = report_head("info", inputs_json(inputs), tier, timing);
  json["shapes"] = list;
  return json;
}

std::vector<Shape> read_and_validate(const InfoCommand& command) {
  if (holds_result(command.file, command.input) || !command.input.lines.empty())
    return {{"", read_operand(command.file, command.input)}};
  std::vector<NamedShape> named = read_all(command.file, command.input);
  std::vector<Shape> shapes;
  for (NamedShape& shape : named) {
    const std::string file = named.size() == 1 ? command.file : command.file + "#" + shape.name;
    const std::string name = shape.name;
    shapes.push_back({name, make_input(std::move(shape), file, command.input)});
  }
  return shapes;
}

void check_pictures(const InfoCommand& command) {
  for (const std::string& file : command.output.files)
    if (output_format(file, command.output) != RegionFormat::svg)
      throw Stop(kUsage, "info draws regions as .svg pictures or .html only, not " + file);
}

/// The pictures of the file's one shape, where it is valid.
void draw(const InfoCommand& command, const std::vector<Shape>& shapes) {
  if (command.draws && shapes.size() != 1) throw Stop(kUsage, "select one shape to draw: " + command.file + "#NAME");
  for (const std::string& file : command.output.files)
    if (const Result<Input>& input = shapes.front().input)
      write_text(file, input->result ? draw_section(*input->result) : draw_region(input->region));
}

ExitCode run(const InfoCommand& command) {
  refuse_unused_format({command.file}, command.input);
  refuse_unknown_extension(command.file);
  if (names_solid(command.file, command.input)) {
    return run_solid_info({command.file, command.json, command.input, command.output.files});
  }
  std::ostream& out = report_stream(command.output.files, command.json);
  check_pictures(command);
  const auto [shapes, timing] = timed(1, [&] { return read_and_validate(command); });
  draw(command, shapes);
  if (command.json) {
    print_report(file_json(shapes, timing));
  } else {
    for (const Shape& shape : shapes) print_shape(out, shape);
  }
  // That a shape is not valid is what info reports, and bad input all the same.
  ExitCode code = kDone;
  for (const Shape& shape : shapes) {
    if (shape.input) continue;
    std::cerr << shape.input.error().to_string() << "\n";
    code = kBadInput;
  }
  return code;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto command = std::make_shared<InfoCommand>();
  command->output.to = "svg";
  CLI::App* const verb =
      app.add_subcommand("info", "What a file holds: counts, bounds, area or volume, validity, tier");
  verb->add_option("F", command->file, "File, FILE#NAME for one shape of several, or - for standard input")->required();
  verb->add_option("-o", command->output.files,
                   "Draw the region (.svg) or the solid (.glb), or show it in the viewer (.html); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb->add_flag("--json", command->json, "Print one JSON object");
  add_solid_input_options(*verb, command->input);
  add_lines_option(*verb, command->input);
  verb->footer("Example: dymsum info neuron.poly --json");
  verb->callback([command, verb, &action] {
    action = [command, verb] {
      command->draws = !command->output.files.empty();
      return run_with_pages({verb, "sum", "solids"}, {command->file}, command->input, command->output.files,
                            [command] { return run(*command); });
    };
  });
}

}  // namespace dymsum::cli
