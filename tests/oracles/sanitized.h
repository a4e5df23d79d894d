// Sanitizers make the same work some ten times slower: tests then do a share of it.
#pragma once

namespace dymsum::oracles {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace dymsum::oracles
