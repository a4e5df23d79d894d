// Everything that must hold for one pair of operands, by every engine.
#pragma once

#include <string>

#include "dymsum/planar_sum.h"
#include "tiny_regions.h"

namespace dymsum::oracles {

/// The first thing wrong with sum, nfp, erode or contains of the pair, or nothing. Every engine under every semantics
/// gives the same sum; that sum equals the reference. Invalid regions are refused with the sentence "invalid operand:
/// ...". Tiny operands only: the reference is slow.
std::string verdict(const RegionData& p, const RegionData& q);
inline bool refused(const std::string& verdict) { return verdict.rfind("invalid operand", 0) == 0; }

/// A failed pair as text to put into tests/corpus/planar: what is wrong, the shrunk pair, the pair itself.
std::string failure_report(const RegionData& p, const RegionData& q, const std::string& wrong);

/// The value of an environment variable, or `fallback`.
std::uint64_t setting(const char* name, std::uint64_t fallback);

}  // namespace dymsum::oracles
