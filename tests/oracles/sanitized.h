// Sanitizers make the same work some ten times slower: tests then do a fraction of it.
#pragma once

// The address sanitizer's own, in every program that is linked with it.
extern "C" void __asan_init() __attribute__((weak));

namespace dymsum::oracles {

/// Whether the library is under sanitizers. The tests themselves need not be: one object file of theirs is linked with
/// either library, so this is asked when the program starts.
inline const bool kSanitized = &__asan_init != nullptr;

/// The rounds of a test, or how many cases it has to meet in them: a fraction of what is usual under sanitizers, which
/// look at memory and undefined behaviour, not at answers.
inline int rounds(int usual, int fraction = 4) { return kSanitized ? usual / fraction : usual; }

}  // namespace dymsum::oracles
