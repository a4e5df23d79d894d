// Files and summaries of solid sums of any shape.
#pragma once

#include <string>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {

/// .json the exact sum with provenance, else a closed mesh of triangles coloured by kind; a Stop where merging within
/// `how.round` does not give one. .glb is a picture, with tight features in red, which is drawn whatever rounding does
/// to parts of it. Stages need a sum with its trace.
std::string any_solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how);

/// The bytes of a file, and what rounding did where the nearest coordinates did not do; null otherwise.
struct WrittenSolid {
  std::string text;
  Json rounding;
};
/// The same with what rounding did.
WrittenSolid written_solid(const SpatialSum& sum, const std::string& file, const SolidOutput& how);

/// The mesh that any_solid_output writes, in a format of meshes; `file` is what errors name. Says on standard error
/// what was merged.
WrittenSolid rounded_sum_text(const SpatialSum& sum, MeshFormat format, const std::string& file, double round = 0);

/// Whether a file's name asks for the picture of the stages ("stages.glb", "x.stages.glb"): the convolution, cut along
/// red lines, beside the result.
bool is_stage_mesh(const std::string& file);
/// What drawing the stages takes beside the sum, as a mesh and as a file.
std::uint64_t stage_mesh_bytes(const SpatialTrace& trace);

/// The summary of a report. volume_exact is null where it is long, unless it is wanted `exact`.
Json any_solid_sum_json(const SpatialSum& sum, bool exact);

/// A summary, and behind it vertices, edges, faces and what is tight, exactly and with provenance.
Json exact_sum_json(const SpatialSum& sum, Json summary);

/// The error with the file of the operand that has the vertex it tells, or whose reflection has; where it tells
/// nothing, of the last one that is empty.
Error in_solid_operand(Error error, const std::vector<SolidInput>& inputs);

}  // namespace dymsum::cli
