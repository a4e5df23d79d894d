#include "dymsum/solid_edit_script.h"

#include "dymsum/names.h"
#include "io/edit/script_lines.h"

namespace dymsum {
namespace io {
namespace {

Point3 position_in(ScriptLine& line) {
  const double x = line.coordinate(), y = line.coordinate();
  return {x, y, line.coordinate()};
}

MeshData shell_in(ScriptLine& line) {
  MeshData shell;
  while (!line.at_end() && line.peek() != "face") shell.vertices.push_back(position_in(line));
  while (!line.at_end()) {
    line.take("the word face");
    Face& face = shell.faces.emplace_back();
    while (!line.at_end() && line.peek() != "face") face.push_back(line.index("a vertex of the shell"));
  }
  if (shell.vertices.empty() || shell.faces.empty())
    line.fail(
        "a shell is the coordinates of its vertices, and its faces by their indices: X Y Z ... face 0 1 2 face ...");
  return shell;
}

std::vector<std::uint32_t> faces_in(ScriptLine& line) {
  std::vector<std::uint32_t> faces;
  while (!line.at_end() && line.peek() != "by") faces.push_back(line.index("a face"));
  line.take("the word by and a vector");
  return faces;
}

SolidEdit solid_edit_in(ScriptLine& line) {
  const MovingOperand operand = line.operand();
  const SolidEditKind kind = line.kind<SolidEditKind>();
  switch (kind) {
    case SolidEditKind::move: {
      const std::uint32_t vertex = line.index("a vertex");
      return SolidEdit::move(operand, vertex, position_in(line));
    }
    case SolidEditKind::extrude: {
      std::vector<std::uint32_t> faces = faces_in(line);
      return SolidEdit::extrude(operand, std::move(faces), position_in(line));
    }
    case SolidEditKind::invert: {
      const std::uint32_t vertex = line.index("an end of an edge");
      return SolidEdit::invert(operand, vertex, line.index("its other end"));
    }
    case SolidEditKind::insert_in_face: {
      const std::uint32_t face = line.index("a face");
      return SolidEdit::insert_in_face(operand, face, position_in(line));
    }
    case SolidEditKind::insert_in_edge: {
      const std::uint32_t vertex = line.index("an end of an edge"), other = line.index("its other end");
      return SolidEdit::insert_in_edge(operand, vertex, other, position_in(line));
    }
    case SolidEditKind::remove:
      return SolidEdit::remove(operand, line.index("a vertex"));
    case SolidEditKind::add_shell:
      return SolidEdit::add_shell(operand, shell_in(line));
    default:
      return SolidEdit::remove_shell(operand, line.index("a face"));
  }
}

void write_position(std::string& out, const Point3& p) { write_numbers(out, {p.x, p.y, p.z}); }

void write_shell(std::string& out, const MeshData& shell) {
  for (const Point3& v : shell.vertices) write_position(out, v);
  for (const Face& face : shell.faces) {
    out += " face";
    for (const std::uint32_t v : face) write_index(out, v);
  }
}

std::string solid_edit_text(const SolidEdit& edit) {
  std::string out = script_words(edit.operand, name(edit.kind));
  switch (edit.kind) {
    case SolidEditKind::move:
      write_index(out, edit.vertex);
      write_position(out, edit.at);
      break;
    case SolidEditKind::extrude:
      for (const std::uint32_t f : edit.faces) write_index(out, f);
      out += " by";
      write_position(out, edit.at);
      break;
    case SolidEditKind::invert:
      write_index(out, edit.vertex);
      write_index(out, edit.other);
      break;
    case SolidEditKind::insert_in_face:
      write_index(out, edit.face);
      write_position(out, edit.at);
      break;
    case SolidEditKind::insert_in_edge:
      write_index(out, edit.vertex);
      write_index(out, edit.other);
      write_position(out, edit.at);
      break;
    case SolidEditKind::remove:
      write_index(out, edit.vertex);
      break;
    case SolidEditKind::add_shell:
      write_shell(out, edit.added);
      break;
    case SolidEditKind::remove_shell:
      write_index(out, edit.face);
      break;
  }
  return out;
}

}  // namespace
}  // namespace io

Result<std::vector<SolidScriptStep>> parse_solid_script(std::string_view text, std::string_view name_for_errors) {
  return io::script_steps<SolidScriptStep>(text, name_for_errors, io::solid_edit_in);
}

std::string format_solid_script(std::span<const SolidScriptStep> steps) {
  return io::script_text(steps, io::solid_edit_text);
}

Result<SolidEditWork> make_step(EditableSolidSum& sum, const SolidScriptStep& step) {
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
