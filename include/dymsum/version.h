/// \file
/// Which version of dymsum these headers are of. Versions follow semver.org; while the first number is 0, a new second
/// number may change interfaces. CMake and the Python package read the numbers from here.
#pragma once

#define DYMSUM_VERSION_MAJOR 0
#define DYMSUM_VERSION_MINOR 1
#define DYMSUM_VERSION_PATCH 0

#define DYMSUM_VERSION_TEXT_OF(number) #number
#define DYMSUM_VERSION_TEXT(major, minor, patch) \
  DYMSUM_VERSION_TEXT_OF(major) "." DYMSUM_VERSION_TEXT_OF(minor) "." DYMSUM_VERSION_TEXT_OF(patch)

/// The version as text: "0.1.0".
#define DYMSUM_VERSION DYMSUM_VERSION_TEXT(DYMSUM_VERSION_MAJOR, DYMSUM_VERSION_MINOR, DYMSUM_VERSION_PATCH)

/// The version as a number, to compare in `#if`: DYMSUM_VERSION_NUMBER >= 1200 means version 0.12.0 or later.
#define DYMSUM_VERSION_NUMBER (DYMSUM_VERSION_MAJOR * 10000 + DYMSUM_VERSION_MINOR * 100 + DYMSUM_VERSION_PATCH)

namespace dymsum {

/// The version of the library that runs, for programs that load it as a shared one: equal to DYMSUM_VERSION of the
/// headers it was compiled with.
[[nodiscard]] const char* version() noexcept;

}  // namespace dymsum
