#include "spatial/moving/posed_sum.h"

#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

SpatialOptions stage_options(const MovingSolidOptions& options) {
  SpatialOptions stages;
  stages.semantics = options.semantics, stages.tight = options.tight;
  stages.threads = options.threads, stages.progress = options.progress;
  return stages;
}

SpatialSum sum_of_facets(const SolidPair& pair, PosedSpace space, ReducedConvolution convolution,
                         const ConvolutionHints& hints, const SpatialOptions& options) {
  SpatialSum sum;
  StageWatch watch(options, sum.stats);
  watch.begin("inner facets");
  SolidBoundary boundary =
      solid_boundary(std::move(space.space), std::move(convolution), pair.p, pair.q, hints, options, sum.stats, watch);
  watch.begin("faces");
  assemble(boundary, pair.p, pair.q, sum, watch);
  watch.begin("");
  unscale(sum, space.scale);
  return sum;
}

SpatialSum fresh_sum(const SolidPair& pair, const PosePair& poses, const SpatialOptions& options) {
  if (pair.p.vertices.empty() || pair.q.vertices.empty()) return {};
  return fresh_sum(pair, posed_space(pair, poses), options);
}

SpatialSum fresh_sum(const SolidPair& pair, PosedSpace space, const SpatialOptions& options) {
  SpatialStats stats;
  StageWatch watch(options, stats);
  watch.begin("convolution");
  ReducedConvolution convolution = reduced_convolution(*space.space, pair.p, pair.q, watch);
  return sum_of_facets(pair, std::move(space), std::move(convolution), {}, options);
}

}  // namespace dymsum::spatial
