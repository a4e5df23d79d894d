#include "dymsum/version.h"

namespace dymsum {

const char* version() noexcept { return DYMSUM_VERSION; }

}  // namespace dymsum
