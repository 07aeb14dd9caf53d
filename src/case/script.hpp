#pragma once
#include <string>

#include "case/case.hpp"
#include "case/placement.hpp"

namespace hemomag::case_ {

/// Of the neighbour lists, in nodes; flow carries atoms past half of it every dozen steps.
inline constexpr double skin = 1.2;

/// The whole run as a plain script for `hemomag lmp`, in lattice units, without checkpoints. File
/// names are relative to the run directory.
std::string lammps_script(const Case& c, const System& system);

/// in.lammps: the same with checkpoints, for which the directory must hold case.toml.
std::string saving_script(const Case& c, const System& system);

/// The same run from a checkpoint on: atoms and the state of every fix from there. Of the case it
/// needs the models alone.
/// @param checkpoint  directory of the checkpoint
/// @param wall_s      what the run has taken until then
std::string resumed_script(const Case& c, const System& models, const std::string& checkpoint,
                           double wall_s);

/// Cut-off of the dipole forces, in nodes.
double dipole_cutoff(const Case& c);
/// sigma of the cell-cell repulsion [m]: the case's, or 0.6 times the longest rest edge, at least
/// 0.25 um.
double cell_sigma(const Case& c, const CellModel& a, const CellModel& b);

}  // namespace hemomag::case_
