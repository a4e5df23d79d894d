#include "io/region/dxf_spline.h"

#include <algorithm>
#include <string>

namespace dymsum::io {
namespace {

constexpr int kMostDegree = 25;

/// The knots that count are those from the degree on: between them there has to be something.
void require_sound(const Source& source, const DxfEntity& entity, const DxfSpline& spline) {
  const auto fail = [&](const std::string& what) {
    source.fail(ErrorCode::malformed, "the spline " + what, entity.offset);
  };
  const std::size_t points = spline.control.points.size();
  if (points <= spline.degree) fail("has too few control points for its degree");
  if (spline.knots.size() != points + spline.degree + 1)
    fail("has " + std::to_string(spline.knots.size()) + " knots, not " + std::to_string(points + spline.degree + 1));
  if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) fail("has knots that do not ascend");
  if (!(spline.knots[spline.degree] < spline.knots[points])) fail("has no length between its knots");
  const std::vector<double>& weights = spline.control.weights;
  if (!weights.empty() && weights.size() != points) fail("has weights for some of its control points only");
  if (!std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; }))
    fail("has a weight that is not positive");
}

}  // namespace

DxfSpline dxf_spline(const Source& source, const DxfEntity& entity) {
  DxfSpline spline;
  bool passes = false, y_missing = false;
  for (const DxfGroup& group : entity) {
    if (group.code == 71) {
      const int degree = dxf_flags(source, group);
      if (degree < 1 || degree > kMostDegree)
        source.fail(ErrorCode::malformed, "the degree of a spline is from 1 to " + std::to_string(kMostDegree),
                    group.offset);
      spline.degree = static_cast<std::size_t>(degree);
    }
    if (group.code == 40) spline.knots.push_back(dxf_number(source, group));
    if (group.code == 41) spline.control.weights.push_back(dxf_number(source, group));
    if (group.code == 10) spline.control.points.push_back({dxf_number(source, group), 0});
    if (group.code == 20 && y_missing) spline.control.points.back().y = dxf_number(source, group);
    if (group.code == 10 || group.code == 20) y_missing = group.code == 10;
    passes = passes || group.code == 11;
  }
  if (spline.control.points.empty() && passes)
    source.fail(ErrorCode::malformed, "the spline has points that it passes through, and no control points",
                entity.offset);
  if (spline.degree == 0) source.fail(ErrorCode::malformed, "the spline has no degree", entity.offset);
  require_sound(source, entity, spline);
  return spline;
}

}  // namespace dymsum::io
