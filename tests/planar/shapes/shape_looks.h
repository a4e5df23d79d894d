// What is asked of generated shapes.
#pragma once

#include <cstdint>
#include <cstring>

#include "planar/shapes/shapes.h"

namespace dymsum::shapes {

/// FNV-1a over the bits of all coordinates: what "the same coordinates everywhere" means.
inline std::uint64_t fingerprint(const Region& region) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](double x) {
    unsigned char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    for (int i = 0; i < 8; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
  };
  const auto add_ring = [&](const Ring& ring) {
    for (const Point& p : ring) {
      add(p.x);
      add(p.y);
    }
  };
  for (const Part& part : region.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  return hash;
}

inline int reflex_count(const Ring& ring) {
  int count = 0;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
    count += (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) < 0;
  }
  return count;
}

/// Whether all coordinates are multiples of 2^-bits.
inline bool lies_on_grid(const Region& region, int bits) {
  for (const Point& p : region.parts().at(0).outer) {
    if (on_grid(p.x, bits) != p.x || on_grid(p.y, bits) != p.y) return false;
  }
  return true;
}

}  // namespace dymsum::shapes
