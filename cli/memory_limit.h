// --memory MB: a command that ends before it holds more than so much.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace dymsum::cli {

/// Declares --memory MB of a verb for which all that it holds counts.
void add_memory_limit(CLI::App& verb, double& megabytes);

/// Begins to count every array before it is made: std::bad_alloc is thrown where more than so many megabytes would be
/// held. 0: no limit. The library's own limits, which say what would need how much, come first.
void limit_memory(double megabytes);
/// No limit any more: for what is told about an end.
void lift_memory_limit();
/// "the limit of --memory is 100 MB, and 123 MB would be held"; nothing where the limit was never reached.
std::string memory_limit_reached();

}  // namespace dymsum::cli
