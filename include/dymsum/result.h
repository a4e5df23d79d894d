// Results and errors.
//
// Bad values are treated in one way everywhere. A function that returns a Result reports whatever it cannot use, be it
// a file, a coordinate, a number or an option, as an Error with code, sentence and evidence, and changes nothing. A
// function that returns no Result states under "Requires" what it needs and throws std::invalid_argument where that is
// violated. value() on an error and error() on a value throw std::logic_error, and so does a defect of the library.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace dymsum {

/// What went wrong. Each code has a test that provokes it and checks the evidence.
enum class ErrorCode {
  // files
  cannot_open,         ///< the file does not exist or cannot be read
  cannot_write,        ///< the output could not be written completely; any older file is untouched
  unsupported_format,  ///< the file extension names no format that can be read or written
  malformed,           ///< the text does not follow its format: bad number, missing keyword, wrong nesting
  truncated,           ///< the file ends before what it announces
  // regions
  not_finite,         ///< a coordinate is NaN or infinite
  too_few_vertices,   ///< a ring with fewer than three, or a polyline with fewer than two vertices
  repeated_vertex,    ///< two consecutive vertices are equal
  no_area,            ///< a ring that encloses no area
  wrong_orientation,  ///< an outer ring runs clockwise, or a hole counter-clockwise
  self_crossing,      ///< a ring crosses itself or runs along itself
  rings_cross,        ///< two rings cross or run along each other
  hole_outside,       ///< a hole is not inside its outer ring, or lies inside another hole
  parts_overlap,      ///< two parts share interior points
  // meshes
  bad_index,     ///< a face names a vertex that does not exist
  not_planar,    ///< the vertices of a face do not lie in one plane
  not_closed,    ///< an edge with a face on one side only
  not_manifold,  ///< an edge whose faces do not bound inside and outside by turns, such as three faces
  faces_cross,   ///< two faces have a point in common that belongs to no common vertex or edge
  not_convex,    ///< the operation is defined for convex solids only, and an edge or a vertex of this one is not
  // sums
  unsupported_operand,        ///< the operation is not defined for such an operand
  rounding_changed_topology,  ///< rounding the exact result to doubles would change its topology
  bad_scale,                  ///< a scale that is not a positive number, or beyond the supported range
  bad_rotation,               ///< a quaternion of zeros, a zero axis, or components beyond 2^30
  out_of_range,               ///< a number or an option outside of the range that is stated with it
  cancelled,                  ///< the progress callback requested a stop
  out_of_memory,              ///< more memory is needed than the options or the machine give
};

/// The name of a code as it is written in code, for messages and JSON.
std::string_view name(ErrorCode code);

/// The position of a fault, and what is there: every field is set only where it applies. Indices count from 0, lines
/// from 1. Rings of a part: 0 is the outer ring, 1, 2, ... its holes.
struct Evidence {
  std::string file;
  std::optional<std::int64_t> line;
  std::optional<std::int64_t> part, ring, vertex;
  std::optional<std::int64_t> other_part, other_ring, other_vertex;
  std::optional<std::int64_t> face, other_face;  ///< of a mesh; an edge is named by vertex and other_vertex
  std::optional<double> x, y, z;                 ///< a position, in the input's coordinates

  friend bool operator==(const Evidence&, const Evidence&) = default;
};

struct Error {
  ErrorCode code = ErrorCode::malformed;
  std::string message;  ///< one sentence, without the evidence
  Evidence evidence;

  /// File, line, part, ring, vertex and position in front of and behind the sentence: "a.poly:12: ring 1, vertex 3:
  /// ...".
  std::string to_string() const;
  friend bool operator==(const Error&, const Error&) = default;
};

/// A value or an Error. `value()` on an error throws std::logic_error carrying the error's text.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    require();
    return std::get<0>(state_);
  }
  T value() && {
    require();
    return std::get<0>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  T operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const {
    if (ok()) throw std::logic_error("error() called on a value");
    return std::get<1>(state_);
  }

 private:
  void require() const {
    if (!ok()) throw std::logic_error("value() called on an error: " + std::get<1>(state_).to_string());
  }
  std::variant<T, Error> state_;
};

/// Done, or an Error: of functions that have nothing to return.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  void value() const {
    if (error_) throw std::logic_error("value() called on an error: " + error_->to_string());
  }
  const Error& error() const {
    if (!error_) throw std::logic_error("error() called on a value");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace dymsum
