// What functions take besides the library's own classes: anything that is a region or a mesh to Python's other
// packages, scales as numbers, and arrays of rows of doubles.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "dymsum/scale.h"
#include "errors.h"
#include "lists.h"
#include "values.h"

namespace dymsum::python {

/// Whether dymsum._convert makes a value of this kind, "region" or "mesh", of an object.
bool is_like(nb::handle object, std::string_view kind);
/// What its function `maker` makes of the object; raises what is wrong with that.
nb::object converted(nb::handle object, const char* maker);

/// A Region, a Mesh or their data (T), kept alive; made of the object that was handed in where that is none.
template <class T>
struct Argument {
  nb::object object;
  const T& operator*() const { return *nb::inst_ptr<T>(object); }
  const T* operator->() const { return nb::inst_ptr<T>(object); }
};
using RegionArgument = Argument<Region>;
using MeshArgument = Argument<Mesh>;
using RegionDataArgument = Argument<RegionData>;
using MeshDataArgument = Argument<MeshData>;

/// A sequence of these, or of pairs of them: read first, converted when the function is called.
template <class T>
struct Many {
  std::vector<Argument<T>> items;
};
struct RegionPairs {
  std::vector<std::pair<RegionArgument, RegionArgument>> items;
};

/// A Scale, or a number that is taken exactly.
struct ScaleArgument {
  Result<Scale> given = Scale();
  /// Raises what is wrong with the number.
  Scale value() const { return take(Result<Scale>(given)); }
};

/// An array of shape (n, K) of doubles in rows, kept alive: the caller's own where it is one, without a copy.
template <std::size_t K>
struct Rows {
  nb::object kept;
  const double* data = nullptr;
  std::size_t size = 0;
  const double* row(std::size_t n) const { return data + n * K; }
};

/// Positions in a plane, or in space: doubles in rows, or where not all of them are doubles exact numbers.
template <std::size_t K>
struct Positions {
  using Exact = std::conditional_t<K == 2, RationalPoint, RationalPoint3>;
  Rows<K> doubles;
  std::vector<Exact> exact;  ///< where not empty; the origin where a coordinate is not finite
  std::vector<std::size_t> not_finite;
};

/// One position: exactly, but where a coordinate is not finite; and as doubles, where these hold it.
template <std::size_t K>
struct Position {
  std::optional<std::conditional_t<K == 2, RationalPoint, RationalPoint3>> exact;
  std::optional<std::conditional_t<K == 2, Point, Point3>> doubles;
};

/// A contiguous array of the doubles that the object holds; raises where one would have to be rounded.
nb::object contiguous(nb::handle object);
/// Whether an exception says that numbers are no doubles: of Error, TypeError or ValueError.
bool tells_of_numbers(const nb::python_error& error);
/// Whether it is an array of numpy that hides some of its items.
bool is_masked(nb::handle object);

/// A numpy array of T; truth values are bool.
template <class T>
struct Array {
  nb::object object;
};

/// An array of its own memory, of shape (values.size() / columns, columns), or (values.size()) where columns is 0.
template <class T>
Array<T> array_of(std::vector<T> values, std::size_t columns = 0) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  const std::size_t shape[] = {columns ? kept->size() / columns : kept->size(), columns};
  return {nb::cast(nb::ndarray<nb::numpy, T>(kept->data(), columns ? 2 : 1, shape, owner))};
}
inline Array<bool> truths_of(std::vector<std::uint8_t> values) {
  return {array_of(std::move(values)).object.attr("view")("bool")};
}

using PointsView = nb::ndarray<nb::numpy, const double, nb::shape<-1, 2>>;
using Points3View = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>>;

/// The doubles of an array of structs that begin with K of them, by reference: `owner` is the Python object that they
/// live in.
template <std::size_t K, class T>
nb::ndarray<nb::numpy, const double, nb::shape<-1, static_cast<nb::ssize_t>(K)>> view_of(std::span<const T> items,
                                                                                         nb::handle owner) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  static const double kNothing[K] = {};
  const std::size_t shape[] = {items.size(), K};
  const std::int64_t strides[] = {sizeof(T) / sizeof(double), 1};
  const double* data = items.empty() ? kNothing : reinterpret_cast<const double*>(items.data());
  return {data, 2, shape, owner, strides};
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// What an object has to be like, and the function of dymsum._convert that makes a T of it.
template <class T>
struct argument_caster {
  using Value = dymsum::python::Argument<T>;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  static constexpr bool kPlanar = std::is_same_v<T, dymsum::Region> || std::is_same_v<T, dymsum::RegionData>;
  static constexpr bool kData = std::is_same_v<T, dymsum::RegionData> || std::is_same_v<T, dymsum::MeshData>;
  static constexpr const char* kKind = kPlanar ? "region" : "mesh";
  static constexpr const char* kMaker = kPlanar ? kData ? "region_data" : "region" : kData ? "mesh_data" : "mesh";
  bool from_python(handle src, uint32_t flags, cleanup_list*) {
    ready_ = isinstance<T>(src);
    if (!ready_ && !((flags & cast_flags::convert) && dymsum::python::is_like(src, kKind))) return false;
    object_ = borrow(src);
    return true;
  }
  /// Converts here and not above: which overload is meant does not depend on whether the object is valid.
  explicit operator Value() { return {ready_ ? object_ : dymsum::python::converted(object_, kMaker)}; }

 private:
  object object_;
  bool ready_ = false;
};

template <>
struct type_caster<dymsum::python::RegionArgument> : argument_caster<dymsum::Region> {
  static constexpr auto Name = const_name("dymsum.RegionLike");
};
template <>
struct type_caster<dymsum::python::MeshArgument> : argument_caster<dymsum::Mesh> {
  static constexpr auto Name = const_name("dymsum.MeshLike");
};
template <>
struct type_caster<dymsum::python::RegionDataArgument> : argument_caster<dymsum::RegionData> {
  static constexpr auto Name = const_name("dymsum.RegionLike");
};
template <>
struct type_caster<dymsum::python::MeshDataArgument> : argument_caster<dymsum::MeshData> {
  static constexpr auto Name = const_name("dymsum.MeshLike");
};

template <class T>
struct type_caster<dymsum::python::Many<T>> {
  using Item = argument_caster<T>;
  using Value = dymsum::python::Many<T>;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  static constexpr auto Name =
      const_name("collections.abc.Sequence[") + make_caster<dymsum::python::Argument<T>>::Name + const_name("]");
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    items_.clear();
    return dymsum::python::each_item(src,
                                     [&](handle item) { return items_.emplace_back().from_python(item, flags, list); });
  }
  explicit operator Value() {
    Value all;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      all.items.push_back(dymsum::python::of_item(i, [&] { return items_[i].operator dymsum::python::Argument<T>(); }));
    }
    return all;
  }

 private:
  std::vector<Item> items_;
};

template <>
struct type_caster<dymsum::python::RegionPairs> {
  using Item = argument_caster<dymsum::Region>;
  using Value = dymsum::python::RegionPairs;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  static constexpr auto Name = const_name("collections.abc.Sequence[tuple[dymsum.RegionLike, dymsum.RegionLike]]");
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    items_.clear();
    const auto read = [&](handle item) { return items_.emplace_back().from_python(item, flags, list); };
    return dymsum::python::each_item(src, [&](handle pair) {
      const std::size_t before = items_.size();
      if (dymsum::python::each_item(pair, read) && items_.size() == before + 2) return true;
      if (!(flags & cast_flags::convert)) return false;
      throw type_error(("item " + std::to_string(before / 2) + " is no pair of regions").c_str());
    });
  }
  explicit operator Value() {
    Value all;
    for (std::size_t i = 0; i < items_.size(); i += 2) {
      const auto taken = [&](std::size_t k) {
        return dymsum::python::of_item(i / 2, [&] { return items_[k].operator dymsum::python::RegionArgument(); });
      };
      dymsum::python::RegionArgument first = taken(i);
      all.items.emplace_back(std::move(first), taken(i + 1));
    }
    return all;
  }

 private:
  std::vector<Item> items_;
};

template <>
struct type_caster<dymsum::python::ScaleArgument> {
  NB_TYPE_CASTER(dymsum::python::ScaleArgument, const_name("Scale | fractions.Fraction | float"))
  bool from_python(handle src, uint32_t flags, cleanup_list* list);
};

template <class T>
struct type_caster<dymsum::python::Array<T>> {
  using Value = dymsum::python::Array<T>;
  static constexpr auto Name = const_name("numpy.typing.NDArray[numpy.") + dtype_traits<T>::name + const_name("]");
  static handle from_cpp(const Value& of, rv_policy, cleanup_list*) noexcept { return handle(of.object).inc_ref(); }
};

template <std::size_t K>
struct type_caster<dymsum::python::Rows<K>> : list_reader<dymsum::python::Rows<K>> {
  static constexpr auto Name = const_name("numpy.typing.ArrayLike");
  using Array = ndarray<const double, shape<-1, static_cast<ssize_t>(K)>, c_contig, device::cpu>;
  bool from_python(handle src, uint32_t flags, cleanup_list*) {
    if (!dymsum::python::is_masked(src) && take(src)) return true;
    if (!(flags & cast_flags::convert)) return false;
    const object array = dymsum::python::contiguous(src);
    if (len(array) != 0) return take(array);
    this->value_ = {array, nullptr, 0};  // of an empty list numpy tells no columns
    return true;
  }

 private:
  bool take(handle src) {
    Array array;
    if (!try_cast(src, array, false)) return false;
    this->value_ = {nanobind::cast(array, rv_policy::reference), array.data(), array.shape(0)};
    return true;
  }
};

template <std::size_t K>
struct type_caster<dymsum::python::Positions<K>> : list_reader<dymsum::python::Positions<K>> {
  static constexpr auto Name = const_name("numpy.typing.ArrayLike");
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    type_caster<dymsum::python::Rows<K>> rows;
    if (!(flags & cast_flags::convert)) return rows.from_python(src, flags, list) && keep(rows);
    try {
      if (rows.from_python(src, flags, list)) return keep(rows);
    } catch (const python_error& error) {
      if (!dymsum::python::tells_of_numbers(error)) throw;
      if (dymsum::python::is_masked(src) || !read_exactly(src)) throw;
      return true;
    }
    return false;
  }

 private:
  bool keep(type_caster<dymsum::python::Rows<K>>& rows) {
    this->value_.doubles = rows.operator dymsum::python::Rows<K>();
    return true;
  }
  bool read_exactly(handle src) {
    return dymsum::python::each_item(src, [&](handle item) { return add(item); });
  }
  bool add(handle item) {
    using Exact = typename dymsum::python::Positions<K>::Exact;
    type_caster<Exact> one;
    if (!one.from_python(item, 0, nullptr)) return false;
    if (!one.is_finite()) this->value_.not_finite.push_back(this->value_.exact.size());
    this->value_.exact.push_back(one.is_finite() ? one.operator Exact() : Exact());
    return true;
  }
};

template <std::size_t K>
struct type_caster<dymsum::python::Position<K>> : rational_caster<dymsum::python::Position<K>, K> {
  static constexpr auto Name = type_caster<dymsum::RationalPoint>::Name;
  using Position = dymsum::python::Position<K>;
  bool from_python(handle src, uint32_t, cleanup_list*) { return dymsum::python::read_rationals(src, this->numbers_); }
  explicit operator Position() {
    if (!this->is_finite()) return {};
    std::array<double, K> near;
    bool held = true;
    for (std::size_t k = 0; k < K; ++k) {
      near[k] = this->numbers_[k] ? this->numbers_[k]->to_double() : 0;
      const dymsum::Result<dymsum::Rational> back = dymsum::Rational::of(near[k]);
      held = held && this->numbers_[k] && back && *back == *this->numbers_[k];
    }
    Position position;
    if constexpr (K == 2) {
      if (held) position.doubles = {near[0], near[1]};
      position.exact = {this->template take<0>(), this->template take<1>()};
    } else {
      if (held) position.doubles = {near[0], near[1], near[2]};
      position.exact = {this->template take<0>(), this->template take<1>(), this->template take<2>()};
    }
    return position;
  }
};

}  // namespace nanobind::detail
