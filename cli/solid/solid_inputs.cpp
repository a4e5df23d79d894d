#include "solid/solid_inputs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "dymsum/names.h"
#include "dymsum/solid_by_planes.h"
#include "dymsum/solid_union.h"
#include "exit_code.h"
#include "numbers.h"
#include "repairs.h"
#include "snapped_operand.h"
#include "solid/solid_results.h"

namespace dymsum::cli {

namespace {

/// The first word of a text after comments, in small letters.
std::string first_word(std::string_view text) {
  const auto skip = [&](std::size_t length) { text.remove_prefix(std::min(length, text.size())); };
  const auto skip_blanks = [&] { skip(text.find_first_not_of(" \t\r\n\f\v")); };
  for (skip_blanks(); text.starts_with('#'); skip_blanks()) skip(text.find_first_of("\r\n"));
  constexpr std::size_t kLongest = 16;  // of those that are looked for, and more
  text = text.substr(0, kLongest);
  std::string word(text.substr(0, text.find_first_of(" \t\r\n\f\v")));
  if (word.find_first_not_of("0123456789") == 0)
    word.erase(word.find_last_not_of("0123456789") + 1);  // as in OFF8 12 18
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// The format of a text that begins as only solids do: OFF or ply, solid (text .stl), or a statement of .obj; of bytes:
/// glTF or the mark of a .zip.
std::optional<MeshFormat> solid_format_of(std::string_view text) {
  constexpr std::array<std::string_view, 9> kObj{"v", "vn", "vt", "mtllib", "usemtl", "o", "g", "s", "f"};
  if (text.starts_with("glTF")) return MeshFormat::glb;
  if (text.starts_with("PK\x03\x04")) return MeshFormat::three_mf;
  const std::string word = first_word(without_mark(text));
  if (word.ends_with("off")) return MeshFormat::off;
  if (word == "ply") return MeshFormat::ply;
  if (word == "solid") return MeshFormat::stl;
  if (std::find(kObj.begin(), kObj.end(), word) != kObj.end()) return MeshFormat::obj;
  return std::nullopt;
}

MeshRepairOptions repairs_of(const InputOptions& options) {
  const NamedRepairs named = named_repairs(options.repairs);
  return {named.solid, options.nested == "solid" ? NestedShells::solid : NestedShells::cavity, named.crack_width,
          named.hole_length};
}

Result<LoggedMesh> repaired(MeshData data, const InputOptions& options, const MeshRepairOptions& repairs) {
  return options.thin ? repair_with_thin_parts(std::move(data), repairs)
                      : repair_with_union(std::move(data), parse<Fill>(options.fill).value_or(Fill::nonzero), repairs);
}

/// What all repairs would do: of large surfaces that cross that takes too long for a hint.
Result<LoggedMesh> repaired_for_a_hint(const MeshData& data, const InputOptions& options,
                                       std::optional<double> hole_length = {}) {
  constexpr std::size_t kMany = 20000;
  MeshRepairOptions all = repairs_of(options);
  all.kinds = all_mesh_repairs();
  if (hole_length) all.hole_length = hole_length;
  return options.thin || data.faces.size() <= kMany ? repaired(data, options, all) : repair(data, all);
}

/// Says which option takes the solid: which repairs it, or takes its parts without volume, or its hull.
Error with_remedy(Error error, const MeshData& data, const InputOptions& options) {
  if (error.code == ErrorCode::bad_index && !error.evidence.face && data.faces.empty()) {
    error.message = "the file holds vertices and no faces (--hull takes the convex hull of points)";
    return error;
  }
  // With all repairs the error is that of what they leave.
  const bool all = options.repairs == "all";
  const Result<LoggedMesh> after_repair = all ? Result<LoggedMesh>(error) : repaired_for_a_hint(data, options);
  if (after_repair && !after_repair->mesh.empty() && options.offers_repair) {
    error.message += remedy(after_repair->log);
    return error;
  }
  if (!after_repair && options.offers_repair && !options.thin && after_repair.error().code == ErrorCode::not_closed) {
    const Result<LoggedMesh> filled = repaired_for_a_hint(data, options, std::numeric_limits<double>::max());
    if (filled && !filled->mesh.empty() && filled->log.counts.holes > 0) error.message += remedy_of_holes(filled->log);
  }
  // What is left when all else is repaired.
  const ErrorCode code = after_repair ? error.code : after_repair.error().code;
  const bool thin =
      code == ErrorCode::not_closed || code == ErrorCode::not_manifold || error.code == ErrorCode::too_few_vertices;
  if (!thin || !options.offers_thin || options.thin) return error;
  if (Mesh::with_thin_parts(data)) error.message += " (--thin takes parts without volume)";
  else if (repair_with_thin_parts(data)) error.message += " (--thin with --repair takes parts without volume)";
  return error;
}

/// What repair did, also where that leaves nothing.
void announce(const MeshRepairLog& report, const Mesh& mesh, const std::string& file) {
  if (!report.changed() && !mesh.empty()) return;
  std::cerr << file << ": " << (report.changed() ? "repaired: " : "") << report.to_string()
            << (mesh.empty() ? "; it holds no face with an area, and is taken as the empty solid" : "") << "\n";
  if (report.changed()) std::cerr << file << ": repaired: " << positions_text(report) << "\n";
}

Result<SolidInput> hull_of(const MeshData& data, const std::string& file, bool quiet) {
  Result<HulledMesh> hull = hulled(data);
  if (!hull) return hull.error();
  if (!quiet) std::cerr << shown_file(file) << ": convex hull: " << hull->report.to_string() << "\n";
  return SolidInput{file, hull->mesh, hull->report};
}

}  // namespace

std::optional<MeshFormat> mesh_format_of_input(const InputOptions& options) {
  if (options.from.empty()) return solid_format_of(standard_input());
  const Result<MeshFormat> named = mesh_format("." + options.from);
  return named ? std::optional(*named) : std::nullopt;
}

void refuse_selection(const std::string& file) {
  const std::size_t mark = file.rfind('#');
  if (mark == std::string::npos || !mesh_format(file.substr(0, mark))) return;
  throw Stop(kUsage, file + ": the file of a solid holds one shape; name it without " + file.substr(mark));
}

void refuse_unknown_extension(const std::string& file) {
  refuse_selection(file);
  if (file == "-" || is_footprint(file) || mesh_format(file) || names_region(file)) return;
  Error error = read_shapes(file).error();
  if (error.code == ErrorCode::unsupported_format) error.message += ", .off, .obj, .stl, .ply, .glb, .3mf";
  stop_with(error);
}

bool names_solid(const std::string& file, const InputOptions& options) {
  refuse_selection(file);
  if (holds_solid_result(file, options)) return true;
  return file == "-" ? mesh_format_of_input(options).has_value() : mesh_format(file).ok();
}

void refuse_planar_options(const InputOptions& options) {
  const std::pair<bool, const char*> given[] = {{options.drop_z, "--drop-z"},
                                                {!options.join.empty(), "--join"},
                                                {!options.lines.empty(), "--lines"},
                                                {!options.curve_error.empty(), "--curve-error"},
                                                {!options.curve_bound.empty(), "--curve-bound"}};
  for (const auto& [is_given, name] : given)
    if (is_given) throw Stop(kUsage, std::string(name) + " is for planar operands");
  if (!options.nested.empty() && !options.repair()) throw Stop(kUsage, "--nested belongs to --repair");
  if (options.repair() && named_repairs(options.repairs).solid.empty())
    throw Stop(kUsage, "--repair=" + options.repairs + " names repairs of regions alone");
}

Result<MeshFile> read_mesh_data(const std::string& file, const InputOptions& options) {
  refuse_selection(file);
  refuse_planar_options(options);
  if (file != "-") return read_mesh_file(file);
  const std::optional<MeshFormat> format = mesh_format_of_input(options);
  if (!format)
    throw Stop(kUsage, "--from names the format of the solid on standard input: off, obj, stl, ply, glb or 3mf");
  return parse_mesh_file(standard_input(), *format, "standard input");
}

namespace {

/// Validates, repairs or takes the hull of lists whose coordinates are as they are to be.
Result<SolidInput> solid_of(MeshData data, const std::string& file, const InputOptions& options, ReadingNotes& notes) {
  if (options.hull) return hull_of(data, file, options.quiet);
  if (!options.repair()) {
    if (!options.fill.empty()) throw Stop(kUsage, "--fill of solids belongs to --repair");
    Result<Mesh> mesh = options.thin ? Mesh::with_thin_parts(data) : Mesh::create(data);
    if (!mesh) return with_remedy(mesh.error(), data, options);
    return SolidInput{file, std::move(mesh).value()};
  }
  Result<LoggedMesh> after_repair = repaired(data, options, repairs_of(options));
  if (!after_repair) return with_remedy(after_repair.error(), data, options);
  if (!options.quiet) announce(after_repair->log, after_repair->mesh, shown_file(file));
  if (after_repair->log.changed()) notes["repair"] = repair_json(after_repair->log);
  return SolidInput{file, std::move(after_repair).value().mesh};
}

}  // namespace

Result<SolidInput> make_solid(MeshFile read, const std::string& file, const InputOptions& options) {
  ReadingNotes notes = Json::object();
  if (!read.unit.empty()) notes["unit"] = read.unit;
  std::optional<Error> error = snap_operand(read.data, file, options, notes);
  Result<SolidInput> made =
      error ? Result<SolidInput>(*std::move(error)) : solid_of(std::move(read.data), file, options, notes);
  if (!made) {
    Error why = made.error();
    if (why.evidence.file.empty()) why.evidence.file = shown_file(file);
    return why;
  }
  SolidInput input = std::move(made).value();
  input.notes = std::move(notes);
  return input;
}

namespace {

/// The solid by its planes; in doubles where these hold its vertices.
SolidInput input_of(SolidByPlanes made, const std::string& file, ReadingNotes notes, bool quiet) {
  notes["planes"] = {{"tolerance", made.tolerance},   {"largest_move", made.largest_move},
                     {"given_faces", made.faces},     {"faces", made.solid.faces.size()},
                     {"bent_faces", made.bent_faces}, {"axes", made.axes.size()}};
  if (!quiet) std::cerr << shown_file(file) << ": by planes: " << made.to_string() << "\n";
  SolidInput input{file, Mesh()};
  input.notes = std::move(notes);
  input.by_planes = std::move(made.solid);
  if (Result<Mesh> mesh = as_mesh(*input.by_planes)) input.mesh = mesh->canonical();
  else input.result = input.by_planes, input.fractions = true;
  return input;
}

}  // namespace

std::vector<SolidInput> read_by_planes(const std::vector<std::string>& files, const InputOptions& options) {
  if (options.thin) throw Stop(kUsage, "--planes is for solids without thin parts");
  std::vector<SolidInput> inputs(files.size());
  std::vector<std::size_t> of;
  std::vector<MeshData> solids;
  std::vector<ReadingNotes> notes;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (holds_solid_result(files[k], options)) {
      inputs[k] = result_operand(files[k], options);  // whose planes are what they are
      continue;
    }
    MeshFile read = require(read_mesh_data(files[k], options));
    ReadingNotes& note = notes.emplace_back(Json::object());
    if (!read.unit.empty()) note["unit"] = read.unit;
    if (std::optional<Error> error = snap_operand(read.data, files[k], options, note)) stop_with(*error);
    of.push_back(k);
    solids.push_back(std::move(read.data));
  }
  PlanesOptions how;
  if (options.planes != "auto") how.tolerance = finite_number(options.planes);
  Result<std::vector<SolidByPlanes>> made = by_planes(solids, how);
  for (std::size_t k = 0; k < of.size() && !made; ++k) {  // whose fault it is
    Result<SolidByPlanes> alone = by_planes(solids[k], how);
    if (alone) continue;
    Error error = alone.error();
    error.evidence.file = shown_file(files[of[k]]);
    stop_with(error);
  }
  for (std::size_t k = 0; k < of.size(); ++k)
    inputs[of[k]] = input_of(std::move((*made)[k]), files[of[k]], std::move(notes[k]), options.quiet);
  return inputs;
}

SolidInput read_solid(const std::string& file, const InputOptions& options) {
  if (!options.planes.empty()) return std::move(read_by_planes({file}, options)[0]);
  if (holds_solid_result(file, options)) {
    refuse_planar_options(options);
    return result_operand(file, options);
  }
  return require(make_solid(require(read_mesh_data(file, options)), file, options));
}

Json solid_inputs_json(const std::vector<SolidInput>& inputs) {
  Json list = Json::array();
  for (const SolidInput& input : inputs) {
    const bool exact = input.fractions;
    list.push_back({{"file", input.file},
                    {"vertices", exact ? input.result->vertices.size() : input.mesh.vertices().size()},
                    {"faces", exact ? input.result->faces.size() : input.mesh.faces().size()},
                    {"shells", exact ? input.result->shells : input.mesh.shell_count()}});
    if (input.hull)
      list.back()["hull"] = {{"given", input.hull->vertices},
                             {"inside", input.hull->inside_vertices},
                             {"deviation", input.hull->deviation}};
    list.back().update(input.notes);
  }
  return list;
}

}  // namespace dymsum::cli
