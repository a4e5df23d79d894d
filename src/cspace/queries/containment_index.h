// The containment of configurations, by counting the patches that a ray meets.
#pragma once

#include <optional>
#include <vector>

#include "cspace/queries/patch_forms.h"

namespace dymsum::cspace {

/// Angles are cut into bins, positions in every bin into rows; each cell lists the patches that pass through it. Relies
/// on this: between event angles every position without freedom lies on a patch.
class ContainmentIndex {
 public:
  ContainmentIndex(const CspaceObstacle& obstacle, const PatchForms& forms);

  /// Whether the configuration lies in the obstacle; nothing where doubles do not prove it: on the boundary, near it,
  /// or near an event angle. `theta` in [-pi, pi] is within 2^-49 of the exact angle.
  std::optional<bool> contains(double x, double y, double theta) const;

  std::size_t bytes() const;

 private:
  struct Entry {
    std::uint32_t patch = 0;
    float farthest = 0;  ///< no x of it is larger
  };
  struct Bounds {
    std::uint32_t begin = 0, end = 0;
  };

  std::size_t bin_of(double theta) const;
  std::optional<std::uint32_t> slab(std::size_t bin, double theta) const;
  bool alive(std::uint32_t patch, std::uint32_t slab) const;
  std::optional<bool> meets_ray(std::uint32_t patch, const Turn& turn, Point q) const;
  void build(const CspaceObstacle& obstacle);

  const PatchForms& forms_;
  std::vector<double> angles_;              ///< of the events
  std::vector<std::uint32_t> first_angle_;  ///< per bin: the first event angle in it or after it
  std::vector<Bounds> alive_;               ///< slabs of the patches
  std::size_t bins_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< per cell: its first entry
  std::vector<Entry> entries_;
};

}  // namespace dymsum::cspace
