#include "lammps/fix_hemo_contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "utils.h"

#include "lammps/angle_hemo_membrane.h"
#include "lattice/near_points.hpp"
#include "lattice/triangle_distance.hpp"

using namespace LAMMPS_NS;
namespace contact = hemomag::contact;
namespace lattice = hemomag::lattice;
using hemomag::Vec3;

FixHemoContact::FixHemoContact(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  for (int at = 3; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    const double value = utils::numeric(FLERR, arg[at + 1], false, lmp);
    if (key == "range")
      barrier_.range = value;
    else if (key == "stiffness")
      barrier_.stiffness = value;
    else
      error->all(FLERR, "fix hemo/contact: " + key + " is unknown; accepted: range, stiffness");
  }
  if (!(barrier_.range > 0 && barrier_.stiffness > 0))
    error->all(FLERR, std::string("fix hemo/contact needs range R and stiffness K, both > 0"));
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
}

int FixHemoContact::setmask() { return FixConst::PRE_REVERSE; }

void FixHemoContact::init() {
  membrane_ = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
  if (!membrane_)
    error->all(FLERR, std::string("fix hemo/contact needs angle_style hemo/membrane"));
  if (!force->newton_bond) error->all(FLERR, std::string("fix hemo/contact needs `newton on`"));
  topology_.forget();
}

void FixHemoContact::setup_pre_reverse(int eflag, int vflag) { pre_reverse(eflag, vflag); }

/// Every triangle is one rank's own, every carrier near it is there, owned or as a ghost: each pair
/// is found once. A distance changes by at most the skin before the next list.
void FixHemoContact::list_meetings() {
  const double reach = barrier_.range + neighbor->skin;
  const double reach2 = reach * reach;
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  const Vec3 origin{domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]};
  std::vector<int> carriers;
  std::vector<Vec3> at;
  for (int i = 0; i < atom->nlocal + atom->nghost; ++i)
    if (atom->mask[i] & groupbit) {
      carriers.push_back(i);
      at.push_back(x[i] - origin);
    }
  meetings_.clear();
  if (carriers.empty()) return;

  const auto triangles = membrane_->triangle_atoms();
  double widest = 0;
  for (const auto& t : triangles)
    for (const int corner : t)
      widest = std::max(widest, norm2(x[corner] - (1. / 3) * (x[t[0]] + x[t[1]] + x[t[2]])));
  // Ghosts are images of their own: nothing is periodic here.
  const lattice::PeriodicBox box{{domain->xprd, domain->yprd, domain->zprd}, {false, false, false}};
  const lattice::NearPoints near(at, box, std::sqrt(widest) + reach);
  for (const auto& t : triangles) {
    const lattice::Triangle corners{x[t[0]] - origin, x[t[1]] - origin, x[t[2]] - origin};
    near.visit_near((1. / 3) * (corners[0] + corners[1] + corners[2]), [&](int k) {
      const auto c = static_cast<std::size_t>(k);
      if (norm2(at[c] - lattice::nearest_point(at[c], corners).x) < reach2)
        meetings_.push_back({{t[0], t[1], t[2]}, carriers[c]});
    });
  }
}

/// Before LAMMPS sends the forces of ghosts home.
void FixHemoContact::pre_reverse(int, int) {
  if (topology_.changed(*neighbor)) list_meetings();
  energy_ = 0;
  if (meetings_.empty()) return;
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  auto* f = reinterpret_cast<Vec3*>(atom->f[0]);
  for (const Meeting& m : meetings_) {
    const auto& [a, b, c] = m.corner;
    const auto forces = contact::barrier_forces(barrier_, x[m.carrier], {x[a], x[b], x[c]});
    if (forces.energy == 0) continue;
    energy_ += forces.energy;
    f[m.carrier] += forces.point;
    for (std::size_t k = 0; k < 3; ++k) f[m.corner[k]] += forces.corner[k];
  }
}

/// Energy of all contacts.
double FixHemoContact::compute_scalar() {
  double all = 0;
  MPI_Allreduce(&energy_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHemoContact::memory_usage() {
  return static_cast<double>(meetings_.capacity() * sizeof(Meeting));
}
