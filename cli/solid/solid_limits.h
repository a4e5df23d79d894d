// What a solid sum may take, and what it is expected to.
#pragma once

#include <cstdint>

#include "dymsum/mesh.h"
#include "options.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// Declares --round: SolidOutput::round.
void add_round_option(CLI::App& verb, double& tolerance, OperandKind kind);

/// --memory MB.
void add_memory_option(CLI::App& verb, double& megabytes, OperandKind kind);
std::uint64_t memory_bytes(double megabytes);

/// Says on standard error what a sum is expected to take where that may be more than a second.
void announce_cost(const Mesh& p, const Mesh& q);

}  // namespace dymsum::cli
