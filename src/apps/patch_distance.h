// The distance of a configuration to one patch: a function of the angle alone, as at every angle the patch is a
// segment; and lower bounds of it over intervals of angles.
#pragma once

#include "patch_forms.h"

namespace dymsum::apps {

/// A point of a patch.
struct PatchPoint {
  double distance = 0, error = 0;  ///< its distance and how much that errs, infinite where doubles cannot place it
  Point at;             ///< relative to the forms' origin
  double theta = 0;     ///< as the patch has it
};

/// Distances in the metric dx^2 + dy^2 + weight^2 dtheta^2 from one configuration; weight 0 stands for comparing at
/// given angles only.
class PatchDistance {
 public:
  PatchDistance(const PatchForms& forms, Point from, double theta, double weight)
      : forms_(forms), from_(from), theta_(theta), weight_(weight) {}

  /// The point of a patch at an angle that is nearest; `shift` is the multiple of a whole turn that is added to angles
  /// of the patch when they are compared.
  PatchPoint nearest(std::uint32_t patch, double theta, double shift) const;

  struct Bound {
    double square = 0;    ///< no point at any of the angles has a smaller square distance, up to 2^-44 of the size
    bool at_end = false;  ///< it is that of the angle `end`, up to the error of the point there
    double end = 0;
  };
  Bound lower(std::uint32_t patch, double middle, double half, double shift) const;

 private:
  struct Slope;
  Slope to_point(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn,
                 const MovingRange& range) const;
  Slope to_line(const PatchForm& form, const Turn& turn, double half) const;

  const PatchForms& forms_;
  Point from_;
  double theta_, weight_;
};

}  // namespace dymsum::apps
