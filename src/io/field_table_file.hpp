#pragma once
#include <string>

#include "lattice/field_table.hpp"

namespace hemomag::io {

/// Read a field on a regular grid from a CSV file (docs/field_table.md): the header
/// `x_m,y_m,z_m,Bx_T,By_T,Bz_T`, then a line a point, x running fastest and z slowest. Blank lines
/// and what follows a # are passed over. Positions may be off their grid by 1e-6 of the spacing.
/// @throws Error of one line with the path, the line and what is accepted
lattice::FieldTable read_field_table(const std::string& path);

}  // namespace hemomag::io
