// When the facets of a window exist. At masses of parallel faces most facets exist on one side of an angle only, and
// meet those of the other side there alone.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "spatial/events/window_facets.h"
#include "spatial/events/window_roots.h"

namespace dymsum::spatial {

/// The sign of a triangle's normal times a way, on which facets of a window hang.
struct WindowSlant {
  SlantCondition of;  ///< the first condition with these features
  int sign = 0;       ///< of its number before its first root in the window; 0 where that is zero at all angles
  std::vector<FormRoot> roots;
};

/// All slants that are open for some facet, each once, in the order of facets.
class WindowSlants {
 public:
  /// The sign of a slant in the whole window, or 0 where that is not proved.
  using ProvedSign = std::function<int(const SlantCondition&)>;
  /// `again` is called now and then and may throw.
  WindowSlants(const RotatingPair& pair, const std::vector<WindowFacet>& facets, const ProvedSign& proved_sign,
               const RotationRange& range, WindowRoots& roots, const std::function<void()>& again);
  const std::vector<WindowSlant>& all() const { return all_; }
  const WindowSlant& of(const SlantCondition& c) const { return all_[index_.at(key(c))]; }

 private:
  using Key = std::array<std::uint32_t, 4>;
  static Key key(const SlantCondition& c);
  void find_signs(const RotationRange& range, const RootOrder& angles, const std::vector<exact::Polynomial>& forms);

  std::vector<WindowSlant> all_;
  std::map<Key, std::size_t> index_;
};

/// The parameters inside a window at which it is to be divided, ascending; none where it does as a whole. Masses that
/// are parallel but for rounding have hundreds of slants that vanish at angles some 1e-16 apart, and meet there and
/// nowhere else: such a crowd has a window of its own, and that is divided into windows of few slants each.
std::vector<exact::BigRational> parts_of(const WindowSlants& slants, const RootOrder& angles,
                                         const RotationRange& range);

/// Cells of a window divided at some angles: bit k is the open interval before the k-th of them.
using RotationCells = std::uint64_t;

struct FacetCells {
  /// Rational angles at which so many slants vanish that they crowd, ascending, as indices.
  std::vector<std::uint32_t> crowded;
  /// At least the cells in which each facet exists at some angle. Of facets that exist at crowded angles alone none.
  std::vector<RotationCells> of;

  FacetCells() = default;
  FacetCells(const std::vector<WindowFacet>& facets, const WindowSlants& slants, const RootOrder& angles);
  bool is_crowded(std::uint32_t angle) const;
};

}  // namespace dymsum::spatial
