#include "dymsum/result.h"

#include "base/double_text.h"
#include "dymsum/names.h"

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

std::string_view name(ErrorCode code) { return name<ErrorCode>(code); }

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
