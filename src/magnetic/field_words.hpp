#pragma once
#include <span>
#include <string>

#include "magnetic/field.hpp"

// The one grammar of fields, in lattice units: what `fix hemo/field` takes and what a case writes
// into its script. docs/styles/fix_hemo_field.md lists it.

namespace hemomag::magnetic {

/// Read one source with its time factor from the words that begin at `at`, which moves behind it.
///   none | uniform BX BY BZ | gradient AXIS SLOPE ZERO | quadrupole PLANE SLOPE X Y Z |
///   rotating PLANE B0 FREQUENCY
/// each followed by any of: sine FREQUENCY | ramp START LENGTH | pulse START LENGTH
/// @throws Error that names the word and what is accepted
void read_source(std::span<const std::string> words, std::size_t& at, Field& field);

}  // namespace hemomag::magnetic
