// Reading solids a command line names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/mesh_io.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "inputs.h"
#include "report.h"

namespace dymsum::cli {

struct SolidInput {
  std::string file;  ///< as it was written on the command line
  Mesh mesh;
  std::optional<HullReport> hull = {};  ///< where --hull was requested
  ReadingNotes notes = Json::object();
  /// Of a file that holds an exact one whose vertices no doubles hold, or with something tight.
  std::optional<SpatialSum> result = {};
  bool fractions = false;  ///< no doubles hold the vertices of `result`: `mesh` does not have its regular part
  /// A solid by its planes, also where `mesh` has it.
  std::optional<SpatialSum> by_planes = {};

  /// For what takes results.
  SpatialOperand operand() const { return result ? SpatialOperand(*result) : SpatialOperand(mesh); }
};

/// Stops with wrong usage for FILE#NAME where FILE is one of a solid.
void refuse_selection(const std::string& file);
/// Stops with bad input where a file's extension is one of no input at all.
void refuse_unknown_extension(const std::string& file);
/// Whether a file's extension is one of a solid (.off .obj .stl .ply .glb .3mf), it holds an exact result of solids
/// (.json), or standard input holds a solid: by --from, else by its first characters.
bool names_solid(const std::string& file, const InputOptions& options);

/// The format of the solid on standard input, by --from, else by its first characters; nothing where it is none.
std::optional<MeshFormat> mesh_format_of_input(const InputOptions& options);

/// The lists of a file, or of standard input, and their unit.
Result<MeshFile> read_mesh_data(const std::string& file, const InputOptions& options);
/// Validates what was read from a file, or snaps, repairs it or takes its hull where requested.
Result<SolidInput> make_solid(MeshFile read, const std::string& file, const InputOptions& options);
/// Solids by their planes, with axes in common where that does; exact results as they are.
std::vector<SolidInput> read_by_planes(const std::vector<std::string>& files, const InputOptions& options);
/// The valid mesh of a file, or the exact result that it holds.
SolidInput read_solid(const std::string& file, const InputOptions& options);

Json solid_inputs_json(const std::vector<SolidInput>& inputs);

}  // namespace dymsum::cli
