// Maps of grid cells as regions: occupancy maps of robots and maps of games.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/region_io.h"
#include "io/source.h"

namespace dymsum::io {

enum class GridCell : std::uint8_t { free, unknown, occupied };

struct GridMap {
  std::size_t width = 0, height = 0;
  std::vector<GridCell> cells;  ///< rows from below, each from the left
  double resolution = 1;        ///< side of a cell
  double x = 0, y = 0;          ///< the lower left corner of the lower left cell
  double yaw = 0;               ///< the map turns about that corner
};

/// Sets of whole cells. `blocked` is everything that is not free, and a border one cell wide around the map, since
/// nothing is known beyond it; the others are what they are called, without a border.
enum class GridSet : std::uint8_t { blocked, occupied, unknown, free };

/// The union of the cells of a set: parts that are connected through sides of cells, holes, vertices only where the
/// boundary turns. Cells that meet in a corner alone are joined there by a touching point. Corner (i, j) of the grid is
/// the double nearest to x + i resolution and y + j resolution, as one rounding of each; turned, within some roundings
/// of that. Every corner is rounded once, and neighbouring cells share it. O(cells).
RegionData grid_region(const GridMap& map, GridSet set);

/// A grey image, rows from above: P5 or P2.
struct GreyImage {
  std::size_t width = 0, height = 0;
  std::uint32_t most = 255;
  std::vector<std::uint16_t> pixels;
};
GreyImage read_pgm(const Source& source);

/// The YAML file of an occupancy map as ROS's map_server has it, and the image beside it.
GridMap read_ros_map(const Source& yaml);
/// `type octile`, `height`, `width`, `map` and rows of characters from above: . G and S are free, @ O T and W are not.
GridMap read_movingai(const Source& source);

/// Whether a path names a map, by its extension: .yaml, .yml or .map.
bool names_map(std::string_view path);
/// The set of that name: "blocked", "occupied", "unknown", "free"; "" is blocked. Failure malformed for others.
GridSet grid_set(const Source& source, std::string_view name);

}  // namespace dymsum::io
