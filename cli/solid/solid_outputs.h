// Files, pictures and summaries of solid sums.
#pragma once

#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh_io.h"
#include "report.h"
#include "solid/solid_operands.h"

namespace dymsum::cli {

/// How meshes of sums are written.
struct SolidOutput {
  std::string to = "off";  ///< the format of -
  bool hull =
      false;  ///< where rounding changes the topology, take the hull of what is left and say so on standard error
  bool triangulate = false;
  double round =
      0;  ///< what may be merged where rounded surfaces meet, as a fraction of the largest coordinate; 0: the default
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
/// .json the exact sum with provenance, otherwise a valid convex mesh in which facets are coloured by kind, or red
/// where they changed; a Stop where rounding would spoil it.
std::string solid_output(const SolidSum& sum, const std::string& file, const SolidOutput& how = {});
/// What else may be written, for messages.
inline constexpr const char* kExactFile = ".json keeps it exactly";
inline constexpr const char* kOtherFiles = ".json keeps it exactly, .glb draws it";
inline constexpr const char* kDoubles = ".off, .obj, .ply and .3mf hold it";
/// Ends with the error that is about this output, and what else may be done.
[[noreturn]] void stop_for(Error error, const std::string& file, const std::string& instead = kOtherFiles);

/// The bytes of a file; a Stop where single precision cannot hold the mesh.
std::string mesh_text(const Mesh& mesh, MeshFormat format, const std::string& file,
                      const std::vector<FaceColour>& colours = {}, const std::string& instead = kDoubles);

/// face + vertex, vertex + face, edge + edge, merged.
std::string facet_kind(const SolidFacet& facet);
/// Of the faces of a mesh that was made from the sum: that of the facet that has their vertices, grey where there is
/// none.
std::vector<FaceColour> facet_colours(const SolidSum& sum, const Mesh& mesh, Precision precision);

/// Facets with a face of one operand, and of two edges.
struct FacetKinds {
  std::size_t with_face = 0, of_edges = 0;
};
FacetKinds facet_kinds(const SolidSum& sum);

Json solid_sum_json(const SolidSum& sum);
Json feature_json(const SolidFeature& feature);

}  // namespace dymsum::cli
