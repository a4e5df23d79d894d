// From which cell to which one the faces and shells of a family's sums are there.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "dymsum/solid_family.h"
#include "spatial/family/sum_structure.h"

namespace dymsum::spatial {

/// What touches on the faces of every shell: of each the contacts, sorted, each once.
using ShellContacts = std::vector<std::vector<SolidContact>>;
ShellContacts contacts_of(const SpatialSum& sum);
/// The same, of all that touches beside edges of the faces.
ShellContacts contacts_of(const SumStructure& structure);

class SolidLifetimes {
 public:
  /// The next cell, in order.
  void add(std::uint32_t cell, const ShellContacts& shells);
  /// By feature, then as they first come, faces of one cell by their contacts.
  std::vector<SolidLifetime> all() &&;

 private:
  std::vector<SolidLifetime> faces_, shells_;
  std::map<SolidContact, std::size_t> face_;                   // its last lifetime
  std::map<SolidContact, std::vector<std::size_t>> shell_of_;  // of the cell before: the lifetimes of shells with it
};

}  // namespace dymsum::spatial
