// The distance to the boundary of a configuration-space obstacle as Behar 2016, section 4.4.2, estimates it: the
// patches of the ten nearest of uniformly distributed samples, each of them searched by gradient descent from 36 seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/obstacle_queries.h"

namespace dymsum::bench {

struct SampledAnswer {
  double distance = 0;  ///< without sign
  std::uint32_t patch = Patch::kNone;
};

class SampledDepth {
 public:
  static constexpr std::size_t kNeighbours = 10;

  /// The patches that are nearest to the samples come from `exact`, so that the estimate starts from what its own
  /// search through all patches could find at best.
  SampledDepth(const CspaceObstacle& obstacle, const ObstacleQueries& exact, double weight,
               const std::vector<Configuration>& samples);

  SampledAnswer clearance(const Configuration& from) const;
  /// The least distance to one patch that 36 descents find.
  double distance(std::uint32_t patch, const Configuration& from) const;

 private:
  double square(const Patch& patch, const Configuration& from, double fraction, double theta) const;
  double descend(const Patch& patch, const Configuration& from, double fraction, double theta, double low,
                 double high) const;

  const CspaceObstacle& obstacle_;
  double weight_;
  std::vector<Configuration> samples_;
  std::vector<std::uint32_t> nearest_;  ///< patch of every sample
};

}  // namespace dymsum::bench
