// The repairs of regions and solids by name: each may be refused, and is reported with what it changed and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The repairs of regions. `collinear_vertices` lie inside straight lines, or are spikes; `empty_rings` enclose
/// nothing; `duplicate_rings` are parts, or holes of one part, that are there already, vertex by vertex;
/// `short_polylines` are one point.
enum class RegionRepairKind : std::uint8_t {
  duplicate_vertices,
  collinear_vertices,
  reversed_rings,
  empty_rings,
  duplicate_rings,
  short_polylines
};
/// All of them, in their order.
std::vector<RegionRepairKind> all_region_repairs();

struct RegionRepairOptions {
  std::vector<RegionRepairKind> kinds = all_region_repairs();  ///< those that may be made
};

/// A position at which something was repaired.
struct RegionRepairMark {
  RegionRepairKind kind;
  Point at;
  friend bool operator==(const RegionRepairMark&, const RegionRepairMark&) = default;
};

struct RegionRepairLog {
  RepairReport counts;
  std::size_t duplicate_rings = 0;               ///< parts and holes that were there already dropped
  static constexpr std::size_t kMostMarks = 16;  ///< of a kind
  std::vector<RegionRepairMark> marks;           ///< where the first ones of every kind are, kind by kind
  bool changed() const { return !marks.empty(); }
  std::vector<RegionRepairKind> kinds() const;  ///< those that were made, in their order
  std::string to_string() const;
};
struct LoggedRegion {
  Region region;
  RegionRepairLog log;
};

/// repair() of those kinds alone; the data is left as it is else, so that Region::create refuses it.
Result<LoggedRegion> repair(RegionData data, const RegionRepairOptions& options);

/// The repairs of solids. `unused_vertices` no face uses, `faces_without_area` have none. `duplicate_faces` are
/// there already, in the same direction, and the faces are not closed with them. `split_faces` are not plane, or have a
/// vertex twice. `nested_shells` run as the one around them does, `membranes` have the solid on both sides.
/// `loose_walls` are faces with edges that no other face has, inside of the solid that the others bound: without them
/// it is the same set. They are taken as inside where thin tetrahedra over them, on one side, lie in the solid.
/// `crossings` are where faces cross, overlap or touch.
enum class MeshRepairKind : std::uint8_t {
  duplicate_vertices,
  unused_vertices,
  faces_without_area,
  duplicate_faces,
  needles,
  t_junctions,
  cracks,
  holes,
  split_faces,
  reversed_faces,
  reversed_shells,
  nested_shells,
  membranes,
  loose_walls,
  crossings
};
/// All of them, in their order.
std::vector<MeshRepairKind> all_mesh_repairs();

/// What a shell is that runs as the one around it does: the boundary of a cavity, or of a body inside of
/// another one, which adds nothing and is dropped.
enum class NestedShells : std::uint8_t { cavity, solid };

struct MeshRepairOptions {
  std::vector<MeshRepairKind> kinds = all_mesh_repairs();  ///< those that may be made
  NestedShells nested = NestedShells::cavity;
  /// How wide a crack may be, in the data's units; nothing: 2^-20 of the surface's diagonal.
  std::optional<double> crack_width;
  /// How long the open edges around a hole may be together, in the data's units; nothing: half of the diagonal, of 64
  /// edges at most.
  std::optional<double> hole_length;
};

struct MeshRepairMark {
  MeshRepairKind kind;
  Point3 at;
  friend bool operator==(const MeshRepairMark&, const MeshRepairMark&) = default;
};

struct MeshRepairLog {
  MeshRepairReport counts;
  std::size_t nested_bodies = 0;                 ///< shells that ran as the one around them does dropped
  std::size_t loose_walls = 0;                   ///< faces dropped
  std::size_t duplicate_faces = 0;               ///< dropped
  double longest_hole = 0;                       ///< of those filled: its open edges together
  static constexpr std::size_t kMostMarks = 16;  ///< of a kind
  std::vector<MeshRepairMark> marks;             ///< where the first ones of every kind are, kind by kind
  bool changed() const { return !marks.empty(); }
  std::vector<MeshRepairKind> kinds() const;  ///< those that were made, in their order
  std::string to_string() const;
};
struct LoggedMesh {
  Mesh mesh;
  MeshRepairLog log;
};

/// repair() and repair_with_thin_parts() of those kinds alone; the data is left as it is else, so that Mesh::create
/// refuses it. Loose walls and crossings are repaired by repair_with_union only.
Result<LoggedMesh> repair(MeshData data, const MeshRepairOptions& options);
Result<LoggedMesh> repair_with_thin_parts(MeshData data, const MeshRepairOptions& options);

}  // namespace dymsum
