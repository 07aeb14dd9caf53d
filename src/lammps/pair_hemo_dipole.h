// clang-format off
#ifdef PAIR_CLASS
PairStyle(hemo/dipole,PairHemoDipole)
#else
// clang-format on

#ifndef LMP_PAIR_HEMO_DIPOLE_H
#define LMP_PAIR_HEMO_DIPOLE_H

#include <cstdint>
#include <vector>

#include "pair.h"

#include "magnetic/dipole.hpp"

namespace LAMMPS_NS {

class FixHemoField;

/// `pair_style hemo/dipole`: dipole-dipole force and finite size of carriers
/// (docs/styles/pair_hemo_dipole.md).
class PairHemoDipole : public Pair {
public:
  explicit PairHemoDipole(LAMMPS*);
  ~PairHemoDipole() override;
  void compute(int, int) override;
  void settings(int, char**) override;
  void coeff(int, char**) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart(FILE*) override;
  void read_restart(FILE*) override;
  void write_restart_settings(FILE*) override;
  void read_restart_settings(FILE*) override;

  /// Add the forces of every pair of the present list, at positions x, to f of owned and ghost
  /// atoms; the caller sums ghosts.
  void accumulate(double** x, double** f);
  /// Pairs within the cut-off, over all ranks. Collective.
  long pairs();
  /// Largest contact stiffness at the present moments, over all ranks. Collective.
  double max_stiffness();

private:
  enum class Repulsion : std::int64_t { soft, paper };
  struct Pairing {  // written to restart files as it is
    double contact_distance = 0;
    Repulsion repulsion = Repulsion::soft;
    double kappa = 30;              // soft
    double epsilon = 0, sigma = 0;  // paper
    double reach2 = 0;              // square of the distance from which on there is no repulsion
  };
  static_assert(sizeof(Pairing) == 6 * sizeof(double), "padding would be bytes that nobody set");
  void allocate();
  std::size_t place(int i, int j) const {
    const int entry = i * (types_ + 1) + j;
    return static_cast<std::size_t>(entry);
  }
  Pairing& between(int i, int j) { return pairing_[place(i, j)]; }
  const Pairing& between(int i, int j) const { return pairing_[place(i, j)]; }
  hemomag::magnetic::PairForce repulsion_between(int i, int j, const hemomag::Vec3& r) const;
  double longest_reach2() const;
  template <class Visit> void for_each_pair(double** x, Visit visit) const;

  int types_ = 0;
  double cutoff_ = 0;
  bool substepped_ = false;  // fix hemo/drag takes the forces
  FixHemoField* field_ = nullptr;
  std::vector<Pairing> pairing_;
};

}  // namespace LAMMPS_NS

#endif
#endif
