// Regions as plain data.
#pragma once

#include <string>

#include "bind.h"
#include "dymsum/region_io.h"

namespace dymsum::web {

/// RegionShape of index.d.ts.
val region_shape(const RegionData& data);
RegionFormat region_format_in(const std::string& name);

}  // namespace dymsum::web
