// The blocks of a DXF text, which INSERT draws.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/region/dxf_groups.h"
#include "io/region/plane_transform.h"

namespace dymsum::io {

struct DxfBlock {
  Point base;
  std::vector<DxfEntity> entities;
};

/// The blocks by their names without case. Errors: malformed, not_finite.
std::map<std::string, DxfBlock> dxf_blocks(const Source& source, const std::vector<DxfGroup>& groups);

/// The positions in which an INSERT puts its block: one map for each of its rows and columns. Errors: malformed,
/// not_finite.
std::vector<PlaneTransform> dxf_placements(const Source& source, const DxfEntity& insert, const DxfBlock& block);

}  // namespace dymsum::io
