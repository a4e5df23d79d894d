// The groups of a DXF text: a code on one line, its value on the next.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "io/source.h"

namespace dymsum::io {

struct DxfGroup {
  int code = 0;
  std::string_view value;  ///< without blanks around it
  std::size_t offset = 0;  ///< of the value
};

/// All groups up to the one that ends the file. Errors: malformed for a code that is none, and for binary files;
/// truncated where the text ends before that.
std::vector<DxfGroup> dxf_groups(const Source& source);

/// An entity: its kind, and its groups.
struct DxfEntity {
  std::string_view kind;
  std::size_t offset = 0;
  const DxfGroup* first = nullptr;
  const DxfGroup* last = nullptr;  ///< after the last one

  const DxfGroup* begin() const { return first; }
  const DxfGroup* end() const { return last; }
  /// The first group with that code.
  const DxfGroup* find(int code) const;
};

/// Those of the section with that name, in their order. Errors: malformed, for sections that do not end.
std::vector<DxfEntity> dxf_entities(const Source& source, const std::vector<DxfGroup>& groups, std::string_view name);

/// The value of a variable of the section HEADER, such as $INSUNITS; nothing where there is none.
const DxfGroup* dxf_variable(const std::vector<DxfGroup>& groups, std::string_view name);

/// The finite number, or the whole number, of a group. Errors: malformed, not_finite.
double dxf_number(const Source& source, const DxfGroup& group);
int dxf_flags(const Source& source, const DxfGroup& group);

}  // namespace dymsum::io
