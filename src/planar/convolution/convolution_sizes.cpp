#include "dymsum/planar_sum.h"
#include "planar/convolution/convolution.h"
#include "planar/convolution/kinetic.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/operand/prepared_region.h"

namespace dymsum {

using namespace planar;

// A reflex vertex turns the short way in the kinetic convolution and the long way, counter-clockwise, in the full one:
// the two half-open arcs are complements.
ConvolutionSizes convolution_sizes(const Region& p, const Region& q) {
  ConvolutionSizes sizes;
  if (p.empty() || q.empty()) return sizes;
  std::shared_ptr<const Operand> kept_p = prepared_operand(p, 0), kept_q = prepared_operand(q, 1);
  const std::shared_ptr<const Lattice> lattice = make_lattice(kept_p->points, kept_q->points, 0);
  kept_p = placed_on(*lattice, std::move(kept_p));
  kept_q = placed_on(*lattice, std::move(kept_q));
  const Operand &op = *kept_p, &oq = *kept_q;
  for_each_kinetic_turn(*lattice, op, oq, [&](const KineticTurn& t) {
    sizes.kinetic += t.count;
    sizes.full += t.sign > 0 ? t.count : t.edges->size() - t.count;
  });
  sizes.reduced = ReducedConvolution(*lattice, op, oq).size();
  return sizes;
}

}  // namespace dymsum
