#include "lammps/angle_hemo_membrane.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "utils.h"

#include "lammps/compat.hpp"
#include "lammps/orient_triangles.hpp"
#include "membrane/area_volume.hpp"

using namespace LAMMPS_NS;
namespace membrane = hemomag::membrane;
using hemomag::Vec3;

AngleHemoMembrane::AngleHemoMembrane(LAMMPS* lmp) : Angle(lmp) { writedata = 1; }

AngleHemoMembrane::~AngleHemoMembrane() {
  if (allocated) memory->destroy(setflag);
}

void AngleHemoMembrane::allocate() {
  allocated = 1;
  memory->create(setflag, atom->nangletypes + 1, "angle:setflag");
  for (int type = 1; type <= atom->nangletypes; ++type) setflag[type] = 0;
  coefficients_.resize(atom->nangletypes);
}

void AngleHemoMembrane::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  if (narg != 1 + columns)
    error->all(
        FLERR,
        std::string("angle_style hemo/membrane: a type needs Cq q k_a A_t0 k_v V_0 k_d A_k0"));
  int lo = 0, hi = 0;
  utils::bounds(FLERR, std::string(arg[0]), 1, atom->nangletypes, lo, hi, error);
  for (int type = lo; type <= hi; ++type) {
    for (std::size_t c = 0; c < columns; ++c)
      coefficients_[type][c] = utils::numeric(FLERR, arg[c + 1], false, lmp);
    check(type);
    setflag[type] = 1;
  }
}

void AngleHemoMembrane::check(int type) const {
  const auto& c = coefficients_[type];
  if (c[Cq] != 0)
    error->all(FLERR, "angle_style hemo/membrane: type " + std::to_string(type) + " has Cq = " +
                          std::to_string(c[Cq]) + ", an older term that is not available; need 0");
  if (!(c[A_t0] > 0) || !(c[V_0] > 0) || !(c[A_k0] > 0))
    error->all(FLERR, "angle_style hemo/membrane: type " + std::to_string(type) +
                          " needs A_t0, V_0 and A_k0 > 0");
}

void AngleHemoMembrane::init_style() {
  if (domain->triclinic)
    error->all(FLERR, std::string("angle_style hemo/membrane needs an orthogonal box"));
  if (!force->newton_bond)
    error->all(FLERR, std::string("angle_style hemo/membrane needs `newton on`"));
  if (!oriented_) {
    const bigint turned = hemomag::lammps::orient_triangles(*lmp, setflag);
    if (turned > 0 && comm->me == 0)
      utils::logmesg(lmp, "angle_style hemo/membrane: turned " + std::to_string(turned) +
                              " triangles that were listed inside out\n");
  }
  oriented_ = true;
  topology_.forget();
}

/// Local triangles, grouped by the cells this rank holds a part of. With every new neighbour list.
void AngleHemoMembrane::rebuild() {
  const int n = neighbor->nanglelist;
  int** list = neighbor->anglelist;
  std::vector<int> ids(static_cast<std::size_t>(n));
  for (int t = 0; t < n; ++t)
    ids[static_cast<std::size_t>(t)] = static_cast<int>(atom->molecule[list[t][1]]);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());

  cells_.assign(ids.size(), {});
  cell_type_.assign(ids.size(), 0);
  sums_.assign(2 * ids.size(), 0.0);
  triangles_.resize(static_cast<std::size_t>(n));
  for (int t = 0; t < n; ++t) {
    const int molecule = static_cast<int>(atom->molecule[list[t][1]]);
    const auto cell =
        static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), molecule) - ids.begin());
    triangles_[static_cast<std::size_t>(t)] = {list[t][0], list[t][1], list[t][2],
                                               list[t][3], cell,       {}};
    cell_type_[cell] = list[t][3];
  }
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [](const Triangle& a, const Triangle& b) { return a.cell < b.cell; });
  check_constants();
  // The images are agreed on with the same plan, with a width of four; the sums of a step have two.
  exchange_.rebuild(world, ids, 4);
  agree_on_images();
  exchange_.rebuild(world, ids, 2);
  for (std::size_t c = 0; c < ids.size(); ++c) {
    const auto& k = coefficients_[cell_type_[c]];
    cells_[c] = {ids[c], 0, 0, k[A_t0], k[V_0], exchange_.mine(c)};
  }
  fill_list();
}

/// A cell has one area and one volume: its triangles must agree on what these cost.
void AngleHemoMembrane::check_constants() const {
  for (const auto& t : triangles_)
    for (const Column column : {k_a, A_t0, k_v, V_0}) {
      const int first = cell_type_[t.cell];
      if (coefficients_[t.type][column] == coefficients_[first][column]) continue;
      hemomag::lammps::fail_here(lmp, FLERR,
                                 "angle_style hemo/membrane: types " + std::to_string(first) +
                                     " and " + std::to_string(t.type) +
                                     " are of one cell, and need the same k_a, A_t0, k_v and V_0");
    }
}

void AngleHemoMembrane::fill_list() {
  list_.clear();
  for (std::size_t n = 0; n < triangles_.size(); ++n) {
    const auto& t = triangles_[n];
    if (n == 0 || t.cell != triangles_[n - 1].cell) list_.start_cell();
    list_.add({t.i, t.j, t.k}, t.unwrap, coefficients_[t.type][k_d], coefficients_[t.type][A_k0]);
  }
  list_.finish();
}

/// The shift that puts a triangle into its cell's own image, from the image flags of its owned
/// atom. Flags have ten bits and wrap, so that only differences within a cell mean anything: they
/// are taken from one image that all ranks sharing the cell agree on, that of a triangle of the
/// lowest rank.
void AngleHemoMembrane::agree_on_images() {
  constexpr int wrap = 1 << IMGBITS;
  const auto flag = [&](imageint image, int d) {
    const int bits = d == 0 ? 0 : d == 1 ? IMGBITS : IMG2BITS;
    return static_cast<int>((image >> bits) & IMGMASK);
  };
  // Only the rank that counts the cell as its own contributes.
  std::vector<double> reference(4 * cells_.size(), 0.0);
  for (const auto& t : triangles_) {
    double* r = &reference[4 * t.cell];
    if (!exchange_.mine(t.cell) || r[3] != 0) continue;
    for (int d = 0; d < 3; ++d) r[d] = flag(atom->image[t.j], d);
    r[3] = 1;
  }
  exchange_.reduce(reference);
  const double period[3] = {domain->xprd, domain->yprd, domain->zprd};
  for (auto& t : triangles_)
    for (int d = 0; d < 3; ++d) {
      const int difference = flag(atom->image[t.j], d) -
                             static_cast<int>(reference[4 * t.cell + static_cast<std::size_t>(d)]);
      const int images = (difference % wrap + wrap + wrap / 2) % wrap - wrap / 2;
      t.unwrap[static_cast<std::size_t>(d)] = images * period[d];
    }
}

/// Area and volume of every cell, summed over ranks.
void AngleHemoMembrane::sum_cells() {
  const std::span<const Vec3> x{reinterpret_cast<const Vec3*>(atom->x[0]),
                                static_cast<std::size_t>(atom->nlocal + atom->nghost)};
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto part = list_.geometry(c, x);
    sums_[2 * c] = part.area;
    sums_[2 * c + 1] = part.volume;
  }
  exchange_.reduce(sums_);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c].area = sums_[2 * c];
    cells_[c].volume = sums_[2 * c + 1];
  }
}

membrane::TriangleList::Pull AngleHemoMembrane::pull(std::size_t cell) const {
  const auto& k = coefficients_[cell_type_[cell]];
  return {membrane::restoring(k[k_a], cells_[cell].area, k[A_t0]),
          membrane::restoring(k[k_v], cells_[cell].volume, k[V_0])};
}

void AngleHemoMembrane::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (topology_.changed(*neighbor)) rebuild();
  sum_cells();
  const int all = atom->nlocal + atom->nghost;
  const auto atoms = static_cast<std::size_t>(all);
  for (std::size_t c = 0; c < cells_.size(); ++c)
    list_.add_forces(c, pull(c), {reinterpret_cast<const Vec3*>(atom->x[0]), atoms},
                     {reinterpret_cast<Vec3*>(atom->f[0]), atoms});
  if (evflag) tally();
  if (vflag_global) tally_volume();
}

/// Energy of each triangle and its rest-area share of the cell's; virial of the area forces. In the
/// steps that ask for them: the forces of a step do not depend on it.
void AngleHemoMembrane::tally() {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  for (const auto& t : triangles_) {
    const auto& k = coefficients_[t.type];
    const auto& cell = cells_[t.cell];
    const Vec3 twice_area = membrane::twice_area_vector(x[t.i], x[t.j], x[t.k]);
    const double length = norm(twice_area), area = 0.5 * length;
    const double whole = membrane::quadratic(k[k_a], cell.area, k[A_t0]) +
                         membrane::quadratic(k[k_v], cell.volume, k[V_0]);
    const double energy_here =
        membrane::quadratic(k[k_d], area, k[A_k0]) + whole * k[A_k0] / k[A_t0];
    auto A = membrane::area_forces(x[t.i], x[t.j], x[t.k], twice_area / length,
                                   membrane::restoring(k[k_d], area, k[A_k0]) + pull(t.cell).area);
    const Vec3 d1 = x[t.i] - x[t.j], d2 = x[t.k] - x[t.j];
    ev_tally(t.i, t.j, t.k, atom->nlocal, force->newton_bond, energy_here, &A.a.x, &A.c.x, d1.x,
             d1.y, d1.z, d2.x, d2.y, d2.z);
  }
}

/// The volume forces of a closed surface have the virial -E'(V) V in every direction.
void AngleHemoMembrane::tally_volume() {
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].mine)
      for (int d = 0; d < 3; ++d) virial[d] -= pull(c).volume * cells_[c].volume;
}

AngleHemoMembrane::Surface AngleHemoMembrane::surface() const {
  Surface s;
  if (triangles_.empty()) return s;
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  for (const auto& t : triangles_) {
    s.triangles.push_back({{x[t.i] + t.unwrap, x[t.j] + t.unwrap, x[t.k] + t.unwrap},
                           {atom->tag[t.i], atom->tag[t.j], atom->tag[t.k]}});
    s.molecule.push_back(cells_[t.cell].molecule);
  }
  return s;
}

std::vector<std::array<int, 3>> AngleHemoMembrane::triangle_atoms() const {
  std::vector<std::array<int, 3>> corners;
  for (const auto& t : triangles_) corners.push_back({t.i, t.j, t.k});
  return corners;
}

void AngleHemoMembrane::write_restart(FILE* file) { coefficients_.write(file); }

void AngleHemoMembrane::read_restart(FILE* file) {
  allocate();
  coefficients_.read(file, comm->me, world, error);
  for (int type = 1; type <= atom->nangletypes; ++type) setflag[type] = 1;
}

void AngleHemoMembrane::write_data(FILE* file) { coefficients_.write_data(file); }

double AngleHemoMembrane::memory_usage() {
  return Angle::memory_usage() + static_cast<double>(triangles_.capacity() * sizeof(Triangle)) +
         list_.bytes();
}
