// Edges in directions other than the axes of their ring, put on common lines: the exact positions of vertices.
#pragma once

#include <cstddef>
#include <vector>

#include "planar/boolean/line_axes.h"

namespace dymsum::planar {

struct PlacedOnLines {
  std::vector<Position> at;     ///< of a region's vertices
  std::size_t merged = 0;       ///< lines that became one with another one
  std::size_t loose_edges = 0;  ///< of meant families, but on no line of theirs
};

/// The vertices of every region. Each meant family gets one exact direction, that of its edges along axes of theirs
/// where they are parallel there; edges of a ring's group within half the tolerance one line, the one they all
/// lie on, or a multiple of the unit from the group's midpoint on. Vertices are where the lines of
/// their two edges meet; else the nearest positions on the one line, or those along the axis that the other edge runs
/// along. Where that moves a vertex by more than the tolerance, the shorter edge stays off its line. `groups`: all
/// chains, each once.
std::vector<PlacedOnLines> edges_on_lines(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains,
                                          const LineFamilies& found, const std::vector<AlongAxes>& groups);

/// Above the distance of an exact position from a point, by less than 2^-47 of it.
double distance_above(const Position& at, Point from);

}  // namespace dymsum::planar
