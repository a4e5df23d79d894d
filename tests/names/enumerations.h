// Every enumeration of the public headers with its names.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dymsum::names {

/// What a declaration is called, without what it stands in, and its enumerators in order.
using Enumerators = std::pair<std::string, std::vector<std::string>>;

/// By names_of: a new enumeration is listed here, and nowhere else.
std::vector<Enumerators> enumerations();

}  // namespace dymsum::names
