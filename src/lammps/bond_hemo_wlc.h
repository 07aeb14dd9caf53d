// clang-format off
#ifdef BOND_CLASS
BondStyle(hemo/wlc,BondHemoWLC)
#else
// clang-format on

#ifndef LMP_BOND_HEMO_WLC_H
#define LMP_BOND_HEMO_WLC_H

#include <vector>

#include "bond.h"

#include "lammps/coefficients.hpp"
#include "lammps/topology_watch.hpp"
#include "membrane/network.hpp"

namespace LAMMPS_NS {

/// `bond_style hemo/wlc`: in-plane springs of a membrane (docs/styles/bond_hemo_wlc.md).
class BondHemoWLC : public Bond {
public:
  explicit BondHemoWLC(LAMMPS*);
  ~BondHemoWLC() override;
  void init_style() override { topology_.forget(); }
  void compute(int, int) override;
  void coeff(int, char**) override;
  double equilibrium_distance(int) override;
  void write_restart(FILE*) override;
  void read_restart(FILE*) override;
  void write_data(FILE*) override;
  double single(int, double, int, int, double&) override;
  /// Largest length of an edge of this rank over its limit, at the present positions.
  double greatest_stretch() const;

private:
  enum Column { kBT, x0, l_max, mu0, exponent, gamma_c, gamma_t, columns };
  void allocate();
  void derive(int type);
  void rebuild();
  void tally(int eflag);
  void overstretched(int i, int j, double length, double limit) const;

  hemomag::lammps::Coefficients<columns> coefficients_;
  std::vector<hemomag::membrane::Spring> spring_;
  std::vector<double> exponents_;  // that occur, each once
  hemomag::membrane::EdgeList edges_;
  hemomag::lammps::TopologyWatch topology_;
};

}  // namespace LAMMPS_NS

#endif
#endif
