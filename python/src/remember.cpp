#include "remember.h"

#include <string>

namespace dymsum::python {

void remember(nb::handle object, const char* function, nb::tuple arguments) {
  static const nb::handle kName = nb::steal(PyUnicode_InternFromString("_made_by")).release();
  nb::setattr(object, kName, nb::make_tuple(nb::steal(PyUnicode_InternFromString(function)), arguments));
}

nb::object kept(const SumOptions& options) {
  const bool plain = options.engine == Engine::fast && options.semantics == Semantics::closed && !options.trace;
  return plain ? nb::none() : nb::cast(without_progress(options));
}

nb::object made_again(nb::handle object) {
  if (!nb::hasattr(object, "_made_by")) {
    throw nb::type_error("this sum is a part of another result: pickle that one");
  }
  const nb::tuple recipe = nb::cast<nb::tuple>(object.attr("_made_by"));
  const nb::object function = nb::module_::import_("dymsum._remake").attr(nb::cast<nb::str>(recipe[0]));
  return nb::make_tuple(function, recipe[1]);
}

}  // namespace dymsum::python
