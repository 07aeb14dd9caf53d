#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// Add every hemo style of the table in style_table.cpp to the creator maps of one LAMMPS instance.
/// LAMMPS's `clear` command empties those maps: a script that uses it loses the hemo styles.
void register_styles(LAMMPS_NS::LAMMPS& lmp);

}  // namespace hemomag::lammps
