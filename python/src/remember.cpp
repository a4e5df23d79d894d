#include "remember.h"

#include <string>

namespace dymsum::python {

nb::object made_again(nb::handle object) {
  if (!nb::hasattr(object, "_made_by")) {
    throw nb::type_error("this sum is a part of another result: pickle that one");
  }
  const nb::tuple recipe = nb::cast<nb::tuple>(object.attr("_made_by"));
  const nb::object function = nb::module_::import_("dymsum._remake").attr(nb::cast<nb::str>(recipe[0]));
  return nb::make_tuple(function, recipe[1]);
}

}  // namespace dymsum::python
