#include "dymsum/planar_sum.h"
#include "planar/convolution.h"
#include "planar/lattice.h"
#include "planar/operand.h"

namespace dymsum {

using namespace planar;

ConvolutionSizes convolution_sizes(const Region& p, const Region& q) {
  ConvolutionSizes sizes;
  if (p.empty() || q.empty()) return sizes;
  const std::vector<Point> vp = source_vertices(p.data()), vq = source_vertices(q.data());
  const std::unique_ptr<Lattice> lattice = make_lattice(vp, vq, 0);
  const Operand op = make_operand(p.data(), 0, *lattice), oq = make_operand(q.data(), 1, *lattice);
  sizes.reduced = ReducedConvolution(*lattice, op, oq).size();
  return sizes;
}

}  // namespace dymsum
