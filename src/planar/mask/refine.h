#pragma once

namespace dymsum::planar {

/// When crowded cells of a mask are refined; always, whatever that costs, is for tests.
enum class Refine { where_it_pays, always };

}  // namespace dymsum::planar
