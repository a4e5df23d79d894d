#include "planar/sum/reduced_chain.h"

#include <utility>

namespace dymsum::planar {

ReducedChain::ReducedChain(const Soup& soup, const ReducedConvolution& convolution, Array<std::uint32_t> live,
                           std::uint32_t reduced)
    : Chain(soup.memory), soup_(soup), convolution_(convolution), live_(std::move(live)) {
  first_unchained_ = reduced;
  next_.resize(soup.size(), kNone);
  fill_next();
}

void ReducedChain::fill_next() {
  const std::uint32_t n = convolution_.size(), reduced = first_unchained_;
  if (live_.empty()) {
    convolution_.fill_next({next_.data(), reduced});
  } else if (reduced > n / 3) {
    Array<std::uint32_t> next(n, soup_.memory);
    convolution_.fill_next(next);
    // The first id of a segment made it; segments are in the order of these ids.
    for (std::uint32_t id = 0, s = 0; s < reduced; ++id)
      if (live_[id] == s) next_[s++] = live(next[id]);
  } else {
    for (std::uint32_t s = 0; s < reduced; ++s) {
      const SoupSegment& g = soup_.segments[s];
      next_[s] = live(convolution_.next({g.side(), g.edge(), g.vertex}));
    }
  }
}

void ReducedChain::incident(WalkPair v, Array<Incidence>& out) const {
  const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
  add(convolution_.find(0, v.p, v.q), true, out);
  add(convolution_.find(1, v.q, v.p), true, out);
  add(convolution_.find(0, p.prev[v.p], v.q), false, out);
  add(convolution_.find(1, q.prev[v.q], v.p), false, out);
  for (std::uint32_t s = first_unchained_; s < soup_.size(); ++s) {
    if (soup_.start(s) == v) out.push_back({s, true});
    if (soup_.end(s) == v) out.push_back({s, false});
  }
}

}  // namespace dymsum::planar
