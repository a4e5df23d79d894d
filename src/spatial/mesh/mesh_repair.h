// The first part of the named repair: surfaces that may still cross.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "dymsum/named_repairs.h"
#include "dymsum/result.h"

namespace dymsum::spatial {

struct PreparedSurface {
  MeshData data;
  MeshRepairLog log;
};

/// What repair() does before it looks at shells: vertices at one position merged, faces without area dropped,
/// T-junctions closed, faces that are not plane split, and single faces turned over that do not agree with their
/// neighbours; of these what the options allow. Errors: not_finite, bad_index.
Result<PreparedSurface> prepared_surface(MeshData data, const MeshRepairOptions& options);

/// Whether a repair may be made.
bool allows(const MeshRepairOptions& options, MeshRepairKind kind);

/// The positions at which the first ones of every kind were repaired.
class RepairMarks {
 public:
  RepairMarks() = default;
  explicit RepairMarks(const std::vector<MeshRepairMark>& known);
  void add(MeshRepairKind kind, const Point3& at);
  std::vector<MeshRepairMark> all() const;  ///< kind by kind

 private:
  std::array<std::vector<MeshRepairMark>, static_cast<std::size_t>(MeshRepairKind::crossings) + 1> marks_;
};

}  // namespace dymsum::spatial
