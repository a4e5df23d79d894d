// One pair: our time, work and memory, and what the others say.
#pragma once

#include <string>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "solid/inputs.h"
#include "versus/rival.h"

namespace dymsum::bench {

struct Ours {
  std::vector<double> ms, two_threads_ms;  ///< of the wall clock, per repetition
  double validate_ms = 0, round_ms = 0;    ///< Mesh::create of both; rounded() and writing OFF to memory
  double peak_bytes = 0;                   ///< of a process that makes the sum once, over what it had before
  double result_bytes = 0;                 ///< of these, what the finished sum holds
  SpatialStats stats;
  SpatialCost predicted;
  std::size_t faces = 0, tight = 0;
  double volume = 0;
  std::string wrong;  ///< what is wrong: an error, or two threads that differ
};

struct SolidRow {
  std::string name, group;
  std::size_t p_triangles = 0, q_triangles = 0;
  double published_ms = 0, limit_ms = 0;
  Ours ours;
  RivalAnswer cgal, manifold, unguarded;  ///< `area` is the volume
};

struct SolidProtocol {
  double budget_ms = 1500;  ///< for the repetitions of ours
  double limit_s = 0;       ///< for each rival; 0: none is asked
};

/// Manifold's sum through Python; `guard`: with both operands moved until the origin lies inside.
RivalAnswer query_manifold(const SolidPair& pair, bool guard, double limit_s);
Ours measure_ours(const SolidPair& pair, double budget_ms);
SolidRow measure_pair(const SolidPair& pair, const SolidProtocol& protocol);

}  // namespace dymsum::bench
