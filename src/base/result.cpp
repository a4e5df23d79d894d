#include "dymsum/result.h"

#include "base/double_text.h"

namespace dymsum {

namespace {

std::string to_text(double v) {
  char buffer[32];
  const char* const end = base::shortest_text(buffer, buffer + sizeof buffer, v);
  return std::string(static_cast<const char*>(buffer), end);
}

void append(std::string& text, std::string_view label, std::optional<std::int64_t> value) {
  if (!value) return;
  if (!text.empty()) text += ", ";
  text.append(label).append(" ").append(std::to_string(*value));
}

}  // namespace

std::string_view name(ErrorCode code) {
  switch (code) {
    case ErrorCode::cannot_open:
      return "cannot_open";
    case ErrorCode::cannot_write:
      return "cannot_write";
    case ErrorCode::unsupported_format:
      return "unsupported_format";
    case ErrorCode::malformed:
      return "malformed";
    case ErrorCode::truncated:
      return "truncated";
    case ErrorCode::not_finite:
      return "not_finite";
    case ErrorCode::too_few_vertices:
      return "too_few_vertices";
    case ErrorCode::repeated_vertex:
      return "repeated_vertex";
    case ErrorCode::no_area:
      return "no_area";
    case ErrorCode::wrong_orientation:
      return "wrong_orientation";
    case ErrorCode::self_crossing:
      return "self_crossing";
    case ErrorCode::rings_cross:
      return "rings_cross";
    case ErrorCode::hole_outside:
      return "hole_outside";
    case ErrorCode::parts_overlap:
      return "parts_overlap";
    case ErrorCode::bad_index:
      return "bad_index";
    case ErrorCode::not_planar:
      return "not_planar";
    case ErrorCode::not_closed:
      return "not_closed";
    case ErrorCode::not_manifold:
      return "not_manifold";
    case ErrorCode::faces_cross:
      return "faces_cross";
    case ErrorCode::not_convex:
      return "not_convex";
    case ErrorCode::unsupported_operand:
      return "unsupported_operand";
    case ErrorCode::rounding_changed_topology:
      return "rounding_changed_topology";
    case ErrorCode::bad_scale:
      return "bad_scale";
    case ErrorCode::bad_rotation:
      return "bad_rotation";
    case ErrorCode::out_of_range:
      return "out_of_range";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::out_of_memory:
      return "out_of_memory";
  }
  throw std::logic_error("name(ErrorCode): not a code");
}

std::string Error::to_string() const {
  std::string text = evidence.file;
  if (evidence.line) text += (text.empty() ? "line " : ":") + std::to_string(*evidence.line);
  if (!text.empty()) text += ": ";

  std::string where;
  append(where, "part", evidence.part);
  append(where, "ring", evidence.ring);
  append(where, "face", evidence.face);
  append(where, "vertex", evidence.vertex);
  if (!where.empty()) text += where + ": ";
  text += message;

  std::string other;
  append(other, "part", evidence.other_part);
  append(other, "ring", evidence.other_ring);
  append(other, "face", evidence.other_face);
  append(other, "vertex", evidence.other_vertex);
  if (!other.empty()) text += " (the other: " + other + ")";

  if (evidence.x && evidence.y && evidence.z)
    text += " at (" + to_text(*evidence.x) + ", " + to_text(*evidence.y) + ", " + to_text(*evidence.z) + ")";
  else if (evidence.x && evidence.y) text += " at (" + to_text(*evidence.x) + ", " + to_text(*evidence.y) + ")";
  else if (evidence.x) text += " at x = " + to_text(*evidence.x);
  else if (evidence.y) text += " at y = " + to_text(*evidence.y);
  return text;
}

}  // namespace dymsum
