// Integers of any size between Python and the library, as decimal digits: in pieces, for Python converts no more of
// them at once than a limit, which programs may set as low as 640.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <string_view>

namespace dymsum::python {

/// The integer that the digits say. Throws what Python raises.
nanobind::object integer_of(std::string_view digits);
nanobind::object signed_integer_of(std::string_view digits);
/// The digits of an integer.
std::string signed_digits_of(nanobind::handle number);

}  // namespace dymsum::python
