// A complex checked against what its words mean, exactly.
#pragma once

#include <string>

#include "shape/complex/complex.h"

namespace dymsum::testing {

/// "" or what is wrong: every node's disc touches its contacts and no site reaches into it; spokes, ranks and radii
/// agree; edges ascend; Euler's relation.
std::string check_complex(const shape::Complex& complex);

/// Nodes and edges as text that does not depend on their order among equal radii.
std::string summary(const shape::Complex& complex);

}  // namespace dymsum::testing
