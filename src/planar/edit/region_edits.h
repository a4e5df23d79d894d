// Edits of a region's data, and whether the edited data are a region.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/editable_sum.h"
#include "planar/edit/walk_changes.h"

namespace dymsum::planar {

/// Region data and what became of the vertices before.
struct EditedData {
  RegionData data;
  VertexChanges changes;
};

/// Whether an edit leaves every vertex with its index: it moves one.
inline bool only_moves(const Edit& edit) { return edit.kind == EditKind::move || edit.kind == EditKind::invert; }

/// Makes one edit. Error out_of_range for what there is not; `edited` is then as it was.
Result<void> apply(const Edit& edit, EditedData& edited);

/// The region of edited data. Where rings of one valid region without touching points and polylines changed, only edges
/// that are new are compared with the others around them: O(n), a few operations an edge; what they do not prove,
/// Region::create decides. Errors: its errors.
Result<Region> edited_region(const Region& before, EditedData edited);

}  // namespace dymsum::planar
