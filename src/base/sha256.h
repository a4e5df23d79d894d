// SHA-256 (FIPS 180-4): names for what is too long to compare.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dymsum::base {

using Digest = std::array<std::uint8_t, 32>;

Digest sha256(std::string_view bytes);

}  // namespace dymsum::base
