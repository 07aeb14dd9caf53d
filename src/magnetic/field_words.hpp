#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "magnetic/field.hpp"

// The one grammar of fields, in lattice units: what `fix hemo/field` takes and what a case writes
// into its script. docs/styles/fix_hemo_field.md lists it.

namespace hemomag::magnetic {

using TableReader =
    std::function<std::shared_ptr<const lattice::FieldTable>(const std::string& file)>;

/// Read one source with its time factor from the words that begin at `at`, which moves behind it.
///   none | uniform BX BY BZ | gradient AXIS SLOPE ZERO | quadrupole PLANE SLOPE X Y Z |
///   rotating PLANE B0 FREQUENCY |
///   block JX JY JZ LX LY LZ X Y Z AX AY AZ CX CY CZ | cylinder J DIAMETER LENGTH X Y Z AX AY AZ |
///   coil CURRENT DIAMETER X Y Z AX AY AZ | coil_pair CURRENT1 CURRENT2 DIAMETER DISTANCE X Y Z AX
///   AY AZ | wire CURRENT X Y Z AX AY AZ | table FILE PER_METRE PER_TESLA X Y Z
/// each followed by any of: sine FREQUENCY | ramp START LENGTH | pulse START LENGTH
/// @param read_table  opens the file of a table
/// @throws Error that names the word and what is accepted
void read_source(std::span<const std::string> words, std::size_t& at, Field& field,
                 const TableReader& read_table);

}  // namespace hemomag::magnetic
