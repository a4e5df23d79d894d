#include "planar/winding.h"

#include <stdexcept>

namespace dymsum::planar {

bool run_winding(const SumOptions&, SumState&) { throw std::logic_error("winding engine: not linked yet"); }

}  // namespace dymsum::planar
