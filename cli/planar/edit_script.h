// Scripts of edits: a step a line, as a person writes them and as --record does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/editable_sum.h"

namespace dymsum::cli {

/// A line of a script: edits that are made as one step, or a step back or forward; and the hash that the sum has to
/// have after it, where it says one.
struct ScriptStep {
  enum class Kind : std::uint8_t { edits, undo, redo };
  Kind kind = Kind::edits;
  std::vector<Edit> edits;
  std::optional<std::uint64_t> hash;
  std::string text;  ///< of the line, without its hash
  std::int64_t line = 0;
};

/// The steps of a file; stops with file and line at what is none.
///
///   p move 3 1.5,2              a vertex of P to a position; q: of Q
///   p insert 3 1.5,2            a vertex after vertex 3
///   p remove 3
///   p extrude 3 5 0,1           the chain of edges from vertex 3 to vertex 5 by a vector
///   p invert 3                  to the other side of its neighbours
///   p add_hole 0 1,1 1,2 2,1    a hole of part 0, clockwise
///   p remove_hole 0 1
///   p add_part 5,5 6,5 5,6      counter-clockwise
///   p remove_part 0
///   p move 3 1,1; q remove 2    one step
///   undo
///   redo
///   p remove 3 hash 00c0ffee00c0ffee
std::vector<ScriptStep> read_script(const std::string& file);

/// A hash as scripts write it.
std::string hash_text(std::uint64_t hash);

}  // namespace dymsum::cli
