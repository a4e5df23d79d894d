#include "dymsum/planar_sum.h"
#include "planar/convolution.h"
#include "planar/kinetic.h"
#include "planar/lattice.h"
#include "planar/operand.h"

namespace dymsum {

using namespace planar;

// A reflex vertex turns the short way in the kinetic convolution and the long way, counter-clockwise, in the full one:
// the two half-open arcs are complements.
ConvolutionSizes convolution_sizes(const Region& p, const Region& q) {
  ConvolutionSizes sizes;
  if (p.empty() || q.empty()) return sizes;
  const EngineRegion ep = separate_touching(p.data(), p.touching_points());
  const EngineRegion eq = separate_touching(q.data(), q.touching_points());
  const std::vector<Point> vp = source_vertices(ep.data()), vq = source_vertices(eq.data());
  const std::unique_ptr<Lattice> lattice = make_lattice(vp, vq, 0);
  const Operand op = make_operand(ep, 0, *lattice), oq = make_operand(eq, 1, *lattice);
  for_each_kinetic_turn(*lattice, op, oq, [&](const KineticTurn& t) {
    sizes.kinetic += t.count;
    sizes.full += t.sign > 0 ? t.count : t.edges->size() - t.count;
  });
  sizes.reduced = ReducedConvolution(*lattice, op, oq).size();
  return sizes;
}

}  // namespace dymsum
