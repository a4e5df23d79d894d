// Which room may include which: read from the include lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dymsum::layering {

struct Violation {
  std::string file;  ///< below the root
  int line = 0;
  std::string include;  ///< as written, with its quotes or brackets
  std::string why;
};

struct Reading {
  std::size_t files = 0;  ///< files read
  std::vector<Violation> violations;
};

/// The rooms of src/ in their order, below src/; and the folders of the other trees, below the root.
const std::vector<std::string>& rooms();
const std::vector<std::string>& other_rooms();

/// Everything in include/, src/, cli/ and examples/ below `root` that breaks the order of the rooms: public headers
/// include the standard library and each other; a room in src/ includes public headers, itself, the rooms before it and
/// its own foreign headers; cli and examples include public headers and themselves; every folder is a room.
Reading read_tree(const std::filesystem::path& root);

}  // namespace dymsum::layering
