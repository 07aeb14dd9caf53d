#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// The bonded forces of a LAMMPS that has been set up, style by style and without a time step: for
/// measuring them. Forces add up on owned and ghost atoms.
class BondedForces {
public:
  explicit BondedForces(LAMMPS_NS::LAMMPS& lmp) : lmp_(lmp) {}
  void clear() const;  ///< set all forces to zero
  void bonds() const;
  void angles() const;
  void dihedrals() const;
  long atoms() const;  ///< on all ranks

private:
  LAMMPS_NS::LAMMPS& lmp_;
};

}  // namespace hemomag::lammps
