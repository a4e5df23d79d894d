// The pairs of regions that are measured: generated ones, and real ones where a data folder is at hand.
#pragma once

#include <string>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/region.h"

namespace dymsum::bench {

enum class Group {
  thesis,  ///< all pairs of the thesis-like set
  stars,   ///< random stars
  holes,   ///< grates and pockets
  real,    ///< the thesis's own polygons
  swim,    ///< no-fit polygons of a nesting instance
  shirts,
};

const char* name(Group group);

struct Pair {
  std::string name;
  Group group = Group::thesis;
  Region p, q;
  bool no_fit = false;  ///< P (+) -Q instead of P (+) Q
  bool large = false;   ///< both from the larger models of the thesis (figures 3.6 and 3.7)
};

struct Pairs {
  std::vector<Pair> list;
  std::vector<std::string> notes;  ///< what was repaired or left out, and why
};

/// Everything, or the few pairs of the demo. `data` is the folder with planar/ and nesting/, or empty.
Pairs all_pairs(const std::string& data);
Pairs demo_pairs(const std::string& data);
/// The same pairs in coordinates of a kind. What rounding spoils is left out, with a note.
void set_coordinates(Pairs& pairs, Kind kind);

/// $DYMSUM_DATA, or ../shared/data beside the checkout, or nothing when neither is a folder.
std::string data_folder();

}  // namespace dymsum::bench
