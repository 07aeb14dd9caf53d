#pragma once
#include <string>
#include <vector>

namespace hemomag::app {

/// `hemomag bench`: speed on this machine with these ranks, medians of interleaved repetitions.
/// Collective.
/// @return 0, or 2 if a name is unknown
int bench(const std::vector<std::string>& names, bool json);

/// Bond, angle and dihedral forces of 40 cells of 3286 vertices through LAMMPS, in ms by style, a
/// line on rank 0. Collective.
void bench_membrane(bool json);

/// Dipole and contact forces of 10,000 carriers at 0.1 T with all sub-steps and their messages, in
/// ms a step, at random places and in chains, a line each on rank 0. Collective.
void bench_dipole(bool json);

/// B and its gradient at one place, in ns by kind of source. Collective.
void bench_field(bool json);

}  // namespace hemomag::app
