// The layers of a DXF text: which are hidden, and whether they are those of a file of our own.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/region/dxf_groups.h"

namespace dymsum::io {

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

}  // namespace dymsum::io
