#include "dymsum/edit_script.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dymsum/names.h"
#include "dymsum/rational.h"
#include "io/edit/script_lines.h"

namespace dymsum {
namespace io {
namespace {

/// The coordinates up to the end of the line, or to the word that begins the next ring.
Ring ring_in(ScriptLine& line) {
  Ring ring;
  while (!line.at_end() && line.peek() != "hole") {
    const double x = line.coordinate();
    ring.push_back({x, line.coordinate()});
  }
  if (ring.empty()) line.fail("a ring is the coordinates of its vertices: X Y X Y X Y");
  return ring;
}

Point point_in(ScriptLine& line) {
  const double x = line.coordinate();
  return {x, line.coordinate()};
}

Part part_in(ScriptLine& line) {
  Part part;
  part.outer = ring_in(line);
  while (!line.at_end()) {
    line.take("the word hole");
    part.holes.push_back(ring_in(line));
  }
  return part;
}

Edit edit_in(ScriptLine& line) {
  const MovingOperand operand = line.operand();
  const EditKind kind = line.kind<EditKind>();
  switch (kind) {
    case EditKind::move: {
      const std::uint32_t vertex = line.index("a vertex");
      return Edit::move(operand, vertex, point_in(line));
    }
    case EditKind::insert: {
      const std::uint32_t after = line.index("a vertex");
      return Edit::insert(operand, after, point_in(line));
    }
    case EditKind::remove:
      return Edit::remove(operand, line.index("a vertex"));
    case EditKind::extrude: {
      const std::uint32_t first = line.index("the first vertex of a chain");
      const std::uint32_t last = line.index("the last vertex of the chain");
      return Edit::extrude(operand, first, last, point_in(line));
    }
    case EditKind::invert:
      return Edit::invert(operand, line.index("a vertex"));
    case EditKind::add_hole: {
      const std::uint32_t part = line.index("a part");
      return Edit::add_hole(operand, part, ring_in(line));
    }
    case EditKind::remove_hole: {
      const std::uint32_t part = line.index("a part");
      return Edit::remove_hole(operand, part, line.index("a hole"));
    }
    case EditKind::add_part:
      return Edit::add_part(operand, part_in(line));
    default:
      return Edit::remove_part(operand, line.index("a part"));
  }
}

void write_ring(std::string& out, const Ring& ring) {
  for (const Point& p : ring) write_numbers(out, {p.x, p.y});
}

std::string written(const Edit& edit) {
  std::string out = script_words(edit.operand, name(edit.kind));
  switch (edit.kind) {
    case EditKind::move:
    case EditKind::insert:
      write_index(out, edit.vertex);
      write_numbers(out, {edit.at.x, edit.at.y});
      break;
    case EditKind::remove:
    case EditKind::invert:
      write_index(out, edit.vertex);
      break;
    case EditKind::extrude:
      write_index(out, edit.vertex);
      write_index(out, edit.last);
      write_numbers(out, {edit.at.x, edit.at.y});
      break;
    case EditKind::add_hole:
      write_index(out, edit.part);
      write_ring(out, edit.added.outer);
      break;
    case EditKind::remove_hole:
      write_index(out, edit.part);
      write_index(out, edit.hole);
      break;
    case EditKind::add_part:
      write_ring(out, edit.added.outer);
      for (const Ring& hole : edit.added.holes) out += " hole", write_ring(out, hole);
      break;
    case EditKind::remove_part:
      write_index(out, edit.part);
      break;
  }
  return out;
}

}  // namespace
}  // namespace io

Result<std::vector<ScriptStep>> parse_script(std::string_view text, std::string_view name_for_errors) {
  return io::script_steps<ScriptStep>(text, name_for_errors, io::edit_in);
}

std::string format_script(std::span<const ScriptStep> steps) { return io::script_text(steps, io::written); }

Result<FrameChanges> make_step(EditableSum& sum, const ScriptStep& step) {
  switch (step.action) {
    case ScriptAction::undo:
      return sum.undo();
    case ScriptAction::redo:
      return sum.redo();
    default:
      return sum.edit(step.edits);
  }
}

}  // namespace dymsum
