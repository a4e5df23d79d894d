// A hierarchy of boxes around stretches of patches in configuration space.
#pragma once

#include <array>
#include <vector>

#include "patch_forms.h"

namespace dymsum::apps {

/// Low and high x, y, theta.
struct ConfigurationBox {
  std::array<double, 3> low{}, high{};
};

class PatchTree {
 public:
  struct Node {
    ConfigurationBox box;
    std::uint32_t first = 0, count = 0;  ///< of the pieces, for leaves; else the first child, the second one follows
    bool leaf = false;
  };

  /// `weight`: lengths per radian, for choosing where to split.
  PatchTree(const CspaceObstacle& obstacle, const PatchForms& forms, double weight);

  const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first
  const PatchPiece& piece(std::uint32_t k) const { return pieces_[k]; }
  const ConfigurationBox& box(std::uint32_t piece) const { return boxes_[piece]; }
  std::size_t bytes() const;

 private:
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, double weight);
  std::vector<PatchPiece> pieces_;
  std::vector<ConfigurationBox> boxes_;  ///< of the pieces
  std::vector<Node> nodes_;
};

/// The smallest square distance of any point of a box to (x, y, theta), angles a whole turn apart being the same.
double square_distance(const ConfigurationBox& box, Point at, double theta, double weight);

}  // namespace dymsum::apps
