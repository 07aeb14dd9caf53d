// clang-format off
#ifdef PAIR_CLASS
PairStyle(hemo/contact,PairHemoContact)
#else
// clang-format on

#ifndef LMP_PAIR_HEMO_CONTACT_H
#define LMP_PAIR_HEMO_CONTACT_H

#include <vector>

#include "pair.h"

#include "contact/lennard_jones.hpp"
#include "contact/morse.hpp"

namespace LAMMPS_NS {

/// `pair_style hemo/contact`: Morse attraction and short LJ repulsion between membranes, and
/// between membranes and carriers (docs/styles/pair_hemo_contact.md).
class PairHemoContact : public Pair {
public:
  explicit PairHemoContact(LAMMPS*);
  ~PairHemoContact() override;
  void compute(int, int) override;
  void settings(int, char**) override;
  void coeff(int, char**) override;
  double init_one(int, int) override;
  void write_restart(FILE*) override;
  void read_restart(FILE*) override;
  double single(int, int, int, int, double, double, double, double&) override;

private:
  struct Contact {
    hemomag::contact::Morse morse;
    hemomag::contact::LennardJones lj;
    double morse_cut2 = 0, lj_cut2 = 0;
  };
  static_assert(sizeof(Contact) == 8 * sizeof(double), "it is written to restart files as it is");
  void allocate();
  std::size_t place(int i, int j) const {
    const int entry = i * (types_ + 1) + j;
    return static_cast<std::size_t>(entry);
  }
  Contact& between(int i, int j) { return contact_[place(i, j)]; }
  void set(int i, int j, const Contact& contact);
  /// -dU/dr over r at the squared distance r2.
  static double force_over_r(const Contact& c, double r2);
  static double energy(const Contact& c, double r2);

  int types_ = 0;
  std::vector<Contact> contact_;  // [i][j], symmetric
};

}  // namespace LAMMPS_NS

#endif
#endif
