// clang-format off
#ifdef DIHEDRAL_CLASS
DihedralStyle(hemo/bend,DihedralHemoBend)
#else
// clang-format on

#ifndef LMP_DIHEDRAL_HEMO_BEND_H
#define LMP_DIHEDRAL_HEMO_BEND_H

#include <vector>

#include "dihedral.h"

#include "lammps/coefficients.hpp"
#include "lammps/topology_watch.hpp"
#include "membrane/network.hpp"

namespace LAMMPS_NS {

/// `dihedral_style hemo/bend`: bending at the hinges of a membrane
/// (docs/styles/dihedral_hemo_bend.md).
class DihedralHemoBend : public Dihedral {
public:
  explicit DihedralHemoBend(LAMMPS*);
  ~DihedralHemoBend() override;
  void init_style() override { topology_.forget(); }
  void compute(int, int) override;
  void coeff(int, char**) override;
  void write_restart(FILE*) override;
  void read_restart(FILE*) override;
  void write_data(FILE*) override;

private:
  enum Column { k_b, theta_0, columns };
  void allocate();
  void derive(int type);
  void rebuild();
  void tally(int eflag);

  hemomag::lammps::Coefficients<columns> coefficients_;
  std::vector<hemomag::membrane::Bending> bending_;
  hemomag::membrane::HingeList hinges_;
  hemomag::lammps::TopologyWatch topology_;
};

}  // namespace LAMMPS_NS

#endif
#endif
