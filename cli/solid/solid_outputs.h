// Files and pictures of sums of solids.
#pragma once

#include <string>
#include <vector>

#include "dymsum/mesh_io.h"
#include "dymsum/spatial_sum.h"
#include "report.h"
#include "solid/solid_json.h"
#include "solid/solid_operands.h"

namespace dymsum::cli {

/// How meshes of sums are written.
struct SolidOutput {
  std::string to = "off";  ///< the format of -
  bool hull = false;       ///< of a convex sum: take the hull of what rounding leaves, and say so on standard error
  bool triangulate = false;
  double round =
      0;  ///< what may be merged where rounded surfaces meet, as a fraction of the largest coordinate; 0: the default
  std::vector<SolidContact> changed = {};  ///< what touches at faces to be drawn as new, sorted
};

/// Usage errors for outputs that cannot be written, before any long work; `also` is what the verb writes besides, for
/// the message.
void check_solid_outputs(const std::vector<std::string>& files, const SolidOutput& how = {},
                         const std::string& also = "");
/// Whether one of them is a mesh, not the exact sum.
bool writes_mesh(const std::vector<std::string>& files, const SolidOutput& how);
/// The format of a mesh in a file, or in --to for "-"; a Stop for others, which says so where it is one of planar
/// regions.
MeshFormat mesh_output_format(const std::string& file, const std::string& to);

/// The bytes of a file, and what rounding did where the nearest coordinates did not do; null otherwise.
struct WrittenSolid {
  std::string text;
  Json rounding;
};
/// .json the exact sum with provenance, else a mesh in which faces are coloured by kind, or red where they changed: of
/// a convex sum a valid convex one with whole faces, of others a closed one of triangles; a Stop where merging within
/// `how.round` does not give one. .glb is a picture, with tight features in red, which is drawn whatever rounding does
/// to parts of it. Stages need a sum with its trace.
WrittenSolid written_solid(const SpatialSum& sum, const std::string& file, const SolidOutput& how);
std::string solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how = {});
/// The mesh of these, in a format of meshes; `file` is what errors name. Says on standard error what was merged.
WrittenSolid mesh_of_sum(const SpatialSum& sum, MeshFormat format, const std::string& file, const SolidOutput& how);

/// Whether a file's name requests the picture of the stages ("stages.glb", "x.stages.glb"): the convolution, cut along
/// red lines, beside the result.
bool is_stage_mesh(const std::string& file);
/// What drawing the stages takes beside the sum, as a mesh and as a file.
std::uint64_t stage_mesh_bytes(const SpatialTrace& trace);

/// What else may be written, for messages.
inline constexpr const char* kExactFile = ".json keeps it exactly";
inline constexpr const char* kOtherFiles = ".json keeps it exactly, .glb draws it";
inline constexpr const char* kDoubles = ".off, .obj, .ply and .3mf hold it";
/// Ends with the error that is about this output, and what else may be done.
[[noreturn]] void stop_for(Error error, const std::string& file, const std::string& instead = kOtherFiles);

/// The bytes of a file; a Stop where single precision cannot hold the mesh.
std::string mesh_text(const Mesh& mesh, MeshFormat format, const std::string& file,
                      const std::vector<FaceColour>& colours = {}, const std::string& instead = kDoubles);

/// The error with the file of the operand that has the vertex it names, or whose reflection has; where it says
/// nothing, of the last one that is empty.
Error in_solid_operand(Error error, const std::vector<SolidInput>& inputs);

}  // namespace dymsum::cli
