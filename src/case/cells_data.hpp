#pragma once
#include <string>

#include "case/case.hpp"
#include "case/placement.hpp"

namespace hemomag::case_ {

/// cells.data of a starting state: atoms wrapped into the box with image flags, one bond, angle and
/// dihedral type an edge, triangle and hinge of each mesh, shared by all its cells, in lattice
/// units. Atom types: the [[cell]] entries, then the [[carrier]] entries. Molecules: cells from 1,
/// then worms; free particles are molecule 0.
std::string cells_data(const Case& c, const System& system);

/// The coefficients of cells.data as commands, for a run that takes its atoms from elsewhere. Needs
/// the models alone.
std::string coefficient_commands(const Case& c, const System& models);

}  // namespace hemomag::case_
