// Families of sums of solids: all sums of an interval of scales, or of angles, as one object. Between two events the
// structure of the sum is the same, so a sum at any parameter is that structure with its vertices at their positions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dymsum/frames.h"
#include "dymsum/progress.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

struct SolidFamilyOptions {
  MovingOperand moving = MovingOperand::p;  ///< which operand scales or rotates, about the origin of its coordinates
  Semantics semantics = Semantics::closed;
  bool tight = true;  ///< look for tight features; without them they make no events
  int threads = 1;    ///< of the making and of sums from scratch; 0: as many as there are cores
  /// Structures are kept in at most so many bytes: what was not used for longest is dropped, and made again when a
  /// parameter of its cell is requested. 0: no limit.
  std::uint64_t structure_bytes = std::uint64_t{1} << 28;
  Progress progress;  ///< of the making
};

/// The cell that a parameter lies in, or the event that it is. Cell k lies between events k - 1 and k of the family.
struct SolidFamilyLocation {
  std::uint32_t index = 0;
  bool event = false;
  friend bool operator==(const SolidFamilyLocation&, const SolidFamilyLocation&) = default;
};

/// What a lifetime of a family of solids is of.
enum class SolidFamilyFeature : std::uint8_t {
  face,   ///< a contact that bears faces
  shell,  ///< a shell, from cell to cell while it has a face of what it was
};

/// The cells in which a feature of the sum is there. A feature that goes and comes back has several lifetimes.
struct SolidLifetime {
  SolidFamilyFeature feature = SolidFamilyFeature::face;
  SolidContact contact;     ///< of a face
  std::uint64_t shell = 0;  ///< of a shell, its identity
  std::uint32_t first_cell = 0, last_cell = 0;
  friend bool operator==(const SolidLifetime&, const SolidLifetime&) = default;
};

/// What a family of solids holds now, and what it took.
struct SolidFamilyWork {
  std::uint64_t events = 0, visible = 0;  ///< events; those known to change the sum's structure
  std::uint64_t cells = 0, kept = 0;      ///< cells; those whose structure is kept
  std::uint64_t made = 0;                 ///< structures made so far, each by a sum from scratch
  std::uint64_t bytes = 0;                ///< of structures that are kept
  double ms = 0;                          ///< of the making
};

}  // namespace dymsum
