// Tables of the depth benchmark about continuous depth.
#pragma once

#include <string>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/mesh.h"

namespace dymsum::bench {

class Report;

struct ContinuousPair {
  std::string name;
  MeshData p, q;
  double size;  ///< of P, about; depths are about a tenth of it, the smoothing length a third
};
std::vector<ContinuousPair> continuous_pairs();

/// Random walks of `steps` steps in all in and about the sums' boundaries: the largest turn of the normal and change of
/// depth for a unit of translation, depth over exact depth, jumps and why, time of a projection; and steps that turn
/// by more than their derivative says without telling of a jump, of which there are to be none.
void continuity(long steps, Kind kind, Report& report);
/// A thread that makes local sums while Q moves and turns, and one that asks the last of them a thousand times a
/// second, for `seconds`.
void two_rates(double seconds, Kind kind, Report& report);

/// Figure 7.4 of the thesis: whole sums, and the parts that a ball meets.
std::string figure_7_4();

}  // namespace dymsum::bench
