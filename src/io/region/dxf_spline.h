// The entity SPLINE.
#pragma once

#include <vector>

#include "io/region/curves.h"
#include "io/region/dxf_groups.h"

namespace dymsum::io {

struct DxfSpline {
  std::size_t degree = 0;
  std::vector<double> knots;  ///< ascending; as many as points and degree + 1
  BezierCurve control;        ///< more points than the degree; no weights, or positive ones
};

/// Errors: malformed where it is none of these, and where it has points that it passes through and no control points.
DxfSpline dxf_spline(const Source& source, const DxfEntity& entity);

}  // namespace dymsum::io
