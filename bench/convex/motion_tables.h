// Tables of convex sums in motion: updates alone, and up to the finished solid.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "convex/measure.h"
#include "coordinate_kinds.h"
#include "page.h"
#include "scaling/scatter.h"

namespace dymsum::bench {

using Models = std::vector<solids::NamedMesh>;
using WantedPair = std::function<bool(const solids::NamedMesh& p, const solids::NamedMesh& q)>;

/// The hulls of their vertices in coordinates of a kind.
Models with_coordinates(Models models, Kind kind);
const solids::NamedMesh& model(const Models& models, std::string_view name);

/// The columns of Report::csv.
extern const char* const kMotionColumns;

/// Tables 5.1 and 5.2, all pairs; and the same motions up to the finished solids. Here and below: off the grid without
/// the expert's brute force, whose doubles do not decide what is nearly a tie.
void rotation_tables(Report& report, const Models& models, Kind kind, const WantedPair& wanted);
/// Solids that have many directions in common and turn about the axis of all of them.
void shared_axis_table(Report& report, Kind kind, const WantedPair& wanted);
/// Figure 5.5, and the promise at 5,000 steps; the dots of the figure.
void step_table(Report& report, const Models& models, Kind kind, const WantedPair& wanted, std::vector<Dot>& update,
                std::vector<Dot>& from_scratch);
/// Figure 5.6. In coordinates of a kind the hulls of the cubes.
void cubes_table(Report& report, Kind kind, std::vector<Dot>& update, std::vector<Dot>& brute);
/// Spheres of up to 100,000 triangles together.
void growth_table(Report& report, Kind kind, const WantedPair& wanted);
/// Table 6.2.
void scaling_table(Report& report, const Models& models, const WantedPair& wanted);

}  // namespace dymsum::bench
