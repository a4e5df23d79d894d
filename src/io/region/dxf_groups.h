// The groups of a DXF text: a code on one line, its value on the next.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/region/curves.h"
#include "io/source.h"

namespace dymsum::io {

// What tells DXF files of our own from others, and the layers in them.

inline constexpr std::string_view kDxfOwn = "dymsum region", kDxfOuter = "outer", kDxfHole = "hole", kDxfLine = "line",
                                  kDxfPoint = "point";

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

// The layers of a DXF text: which are hidden, and whether they are those of a file of our own.

/// A name of a layer or a block, which has no case.
std::string without_case(std::string_view name);

/// The layer that an entity is on: "0" where it names none.
std::string_view dxf_layer(const DxfEntity& entity);

/// The layers that the section TABLES says are off or frozen. Their names have no case.
class DxfHiddenLayers {
 public:
  /// Errors: malformed, not_finite.
  DxfHiddenLayers(const Source& source, const std::vector<DxfGroup>& groups);
  bool contains(std::string_view layer) const;

 private:
  std::set<std::string> names_;
};

/// Whether a text begins with our comment and has only such entities as we write: others may have edited it.
bool is_own_dxf(const Source& source, const std::vector<DxfGroup>& groups, const std::vector<DxfEntity>& entities);

// The blocks of a DXF text, which INSERT draws.

struct DxfBlock {
  Point base;
  std::vector<DxfEntity> entities;
};

/// The blocks by their names without case. Errors: malformed, not_finite.
std::map<std::string, DxfBlock> dxf_blocks(const Source& source, const std::vector<DxfGroup>& groups);

/// The positions in which an INSERT puts its block: one map for each of its rows and columns. Errors: malformed,
/// not_finite.
std::vector<PlaneTransform> dxf_placements(const Source& source, const DxfEntity& insert, const DxfBlock& block);

}  // namespace dymsum::io
