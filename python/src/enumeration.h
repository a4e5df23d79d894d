// Enumerations of the library as Python's, with the same names.
#pragma once

#include <nanobind/nanobind.h>

#include <initializer_list>
#include <stdexcept>
#include <string>

#include "dymsum/names.h"

namespace dymsum::python {

/// Binds an enumeration. `means` says what each value stands for, in their order, or nothing of any.
template <class E>
nanobind::enum_<E> enumeration(nanobind::handle scope, const char* type, const char* doc,
                               std::initializer_list<const char*> means = {}) {
  const auto& names = names_of<E>();
  if (means.size() != 0 && means.size() != names.size())
    throw std::logic_error(std::string(type) + " has other values");
  nanobind::enum_<E> bound(scope, type, doc);
  for (std::size_t k = 0; k < names.size(); ++k)
    bound.value(std::string(names[k]).c_str(), static_cast<E>(k), means.size() == 0 ? nullptr : means.begin()[k]);
  return bound;
}

}  // namespace dymsum::python
