// Structs of the library as Python classes: their public members, comparison, repr, construction by keywords, pickling.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "arguments.h"
#include "calls.h"
#include "dymsum/fields.h"
#include "dymsum/progress.h"
#include "paths.h"
#include "values.h"

namespace dymsum::python {

/// How a field is set from a Python value.
struct RecordField {
  std::string name;
  std::function<void(void* record, nb::handle value)> set;
};
using RecordFields = std::shared_ptr<std::vector<RecordField>>;

/// Sets fields by position and by name, as the aggregate's initialiser would. Raises TypeError.
void fill_record(const std::vector<RecordField>& fields, void* record, nb::args args, nb::kwargs kwargs);
nb::tuple record_state(const std::vector<RecordField>& fields, nb::handle record);
void restore_record(const std::vector<RecordField>& fields, void* record, nb::tuple state);
/// Sets the fields of `made`, whose memory is `to`, as they are in `record`, progress included: for copy.copy, and with
/// a memo for copy.deepcopy.
void copy_record(const std::vector<RecordField>& fields, nb::handle record, nb::handle made, void* to,
                 const nb::object& memo);
std::string record_repr(const std::vector<RecordField>& fields, nb::handle record);
/// What Python calls a member: "from_" where "from" is a word of the language.
std::string attribute_name(std::string_view member);
/// A text that lives for ever: names of stages are views of literals.
std::string_view interned(std::string_view text);

template <class M>
M member_of(nb::handle value) {
  if constexpr (std::is_same_v<M, std::string_view>) {
    return interned(nb::cast<std::string>(value));
  } else if constexpr (std::is_same_v<M, Scale>) {
    return nb::cast<ScaleArgument>(value).value();
  } else {
    return nb::cast<M>(value);
  }
}

template <class T>
class Record : public nb::class_<T> {
 public:
  template <class... Extra>
  Record(nb::handle scope, const char* name, const char* doc, const Extra&... extra)
      : nb::class_<T>(scope, name, doc, nb::type_slots(slots()), extra...),
        fields_(std::make_shared<std::vector<RecordField>>()) {
    const RecordFields fields = fields_;
    this->def("__repr__", [fields](nb::handle_t<T> self) { return record_repr(*fields, self); });
    if constexpr (std::equality_comparable<T>) {
      this->def(
          "__eq__", [](const T& a, const T& b) { return a == b; }, nb::is_operator());
      this->attr("__hash__") = nb::none();
    }
    if constexpr (std::is_default_constructible_v<T>) {
      this->def("__getstate__", [fields](nb::handle_t<T> self) { return record_state(*fields, self); });
      this->def("__setstate__", [fields](T& self, nb::tuple state) {
        new (&self) T{};
        restore_record(*fields, &self, state);
      });
    }
    if constexpr (kHasProgress) {  // what pickling leaves out, copying does not
      this->def("__copy__", [fields](nb::handle_t<T> self) { return copied(*fields, self, nb::none()); });
      this->def(
          "__deepcopy__",
          [fields](nb::handle_t<T> self, const nb::object& memo) { return copied(*fields, self, memo); },
          nb::arg("memo"));
    }
  }

  /// Construction by position and by keyword, for what users hand in.
  Record& constructible() {
    this->def(
        "__init__",
        [fields = fields_](T* self, nb::args args, nb::kwargs kwargs) {
          new (self) T{};
          fill_record(*fields, self, args, kwargs);
        },
        nb::sig("def __init__(self, *args: object, **kwargs: object) -> None"));
    return *this;
  }

  /// A member to be read.
  template <class M, class Base>
  requires std::derived_from<T, Base> Record& field(const char* name, M Base::*member, const char* doc = "") {
    this->def_prop_ro(
        name, [member](const T& self) -> const M& { return self.*member; }, nb::rv_policy::reference_internal, doc);
    fields_->push_back(
        {name, [member](void* self, nb::handle value) { static_cast<T*>(self)->*member = member_of<M>(value); }});
    return *this;
  }

  /// All members that are listed.
  Record& listed() {
    const auto one = [this]<auto pointer>(const names::Field<pointer>& listed) {
      field(attribute_name(listed.kName).c_str(), pointer, listed.about);
    };
    std::apply([&](const auto&... fields) { (one(fields), ...); }, names::kFields<T>);
    return *this;
  }

  /// A member of bytes that are no text.
  Record& bytes(const char* name, std::string T::*member, const char* doc = "") {
    this->def_prop_ro(
        name, [member](const T& self) { return nb::bytes((self.*member).data(), (self.*member).size()); }, doc);
    fields_->push_back({name, [member](void* self, nb::handle value) {
                          const auto given = nb::cast<nb::bytes>(value);
                          static_cast<T*>(self)->*member = std::string(given.c_str(), given.size());
                        }});
    return *this;
  }

  /// A member that is the path of a file or a folder, to be read and set.
  Record& path(const char* name, std::string T::*member, const char* doc = "") {
    const auto set = [member](T& self, const PathArgument& path) { self.*member = path.text; };
    this->def_prop_rw(
        name, [member](const T& self) { return self.*member; }, set, doc);
    fields_->push_back({name, [member](void* self, nb::handle value) {
                          static_cast<T*>(self)->*member = nb::cast<PathArgument>(value).text;
                        }});
    return *this;
  }

  /// A member to be read and set.
  template <class M>
  Record& option(const char* name, M T::*member, const char* doc = "") {
    if constexpr (std::is_same_v<M, Progress>) {
      this->def_rw(name, member, nb::for_setter(nb::arg("value").none()), doc);
    } else {
      this->def_rw(name, member, doc);
    }
    fields_->push_back(
        {name, [member](void* self, nb::handle value) { static_cast<T*>(self)->*member = member_of<M>(value); }});
    return *this;
  }

 private:
  static constexpr bool kHasProgress = requires(T & record) { record.progress = Progress(); };
  static nb::object copied(const std::vector<RecordField>& fields, nb::handle self, const nb::object& memo) {
    nb::object made = nb::inst_alloc(self.type());
    T* const to = new (nb::inst_ptr<T>(made)) T{};
    nb::inst_mark_ready(made);
    copy_record(fields, self, made, to, memo);
    return made;
  }
  static const PyType_Slot* slots() {
    static constexpr PyType_Slot kNone[] = {{0, nullptr}};
    if constexpr (kHasProgress) {
      return ProgressSlots<T>::slots;
    } else {
      return kNone;
    }
  }
  RecordFields fields_;
};

}  // namespace dymsum::python
