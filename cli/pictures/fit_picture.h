// Pictures of two regions and of what of them meets first.
#pragma once

#include <string>
#include <vector>

#include "dymsum/robustness.h"

namespace dymsum::cli {

/// Stops with wrong usage for what is no picture.
void check_fit_pictures(const std::vector<std::string>& files);
/// P, Q moved by `at`, and for each contact the positions of both that meet, joined.
std::string robustness_picture(const Region& p, const Region& q, const RationalPoint& at, const Robustness& robustness);
/// The container, the part moved by `at`, and the two features of the first row.
std::string stack_picture(const Region& container, const Region& part, const RationalPoint& at, const FitStack& stack);

}  // namespace dymsum::cli
