// The thesis's own speed-ups over its brute force.
#pragma once

#include <string_view>

namespace dymsum::bench {

/// Table 5.2 and the two values of table 5.1 that its text repeats; 0 where the value is not known.
double thesis_rotation(std::string_view p, std::string_view q);
/// Table 6.2, p scaled; 0 for other models.
double thesis_scaling(std::string_view p, std::string_view q);

}  // namespace dymsum::bench
