#include "io/region/plane_transform.h"

namespace dymsum::io {

PlaneTransform PlaneTransform::after(const PlaneTransform& inner) const {
  if (identity()) return inner;
  if (inner.identity()) return *this;
  return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
          b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

Point PlaneTransform::apply(Point p) const {
  if (identity()) return p;
  return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
}

Point PlaneTransform::apply_vector(Point v) const {
  if (identity()) return v;
  return {a * v.x + c * v.y, b * v.x + d * v.y};
}

}  // namespace dymsum::io
