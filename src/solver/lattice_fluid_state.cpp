#include <string>

#include "io/node_file.hpp"
#include "lattice/d3q19.hpp"
#include "solver/lattice_fluid.hpp"

// What the next step needs, to and from a file. Datasets: f00 to f18 (the populations as they will
// be collided next), ux, uy, uz, and of the exponential scheme the numbers of the sources of the
// last step, s00 to s09, and of the one before it, t00 to t09. Halos are not stored: they are
// exchanged anew.

namespace hemomag::solver {
namespace {

std::string numbered(char letter, std::size_t k) {
  const char name[] = {letter, static_cast<char>('0' + k / 10), static_cast<char>('0' + k % 10), 0};
  return name;
}

constexpr const char* velocity_names[3] = {"ux", "uy", "uz"};

/// visit(x, y, z, index) for every node of a block, x fastest.
template <class Visit> void for_each_owned(const std::array<int, 3>& n, Visit visit) {
  std::size_t index = 0;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) visit(x, y, z, index++);
}

}  // namespace

template <class Real> void LatticeFluid<Real>::save(const std::string& path) {
  if (!settled()) {  // only fills ghosts and solid nodes: the next step may do it again
    send_populations_forward();
    bounce_before_shift();
  }
  io::NodeFile file(at_.comm, path, block(), io::NodeFile::Open::create);
  std::vector<Real> values(block().owned());
  const auto write = [&](const std::string& name, auto value) {
    for_each_owned(block().size,
                   [&](int x, int y, int z, std::size_t index) { values[index] = value(x, y, z); });
    file.write(name, std::span<const Real>(values));
  };
  for (std::size_t i = 0; i < 19; ++i) {
    const auto& c = lattice::d3q19::e[i];
    const Real* stored =
        settled() ? f_[i] : f_[static_cast<std::size_t>(lattice::d3q19::opposite[i])];
    const std::ptrdiff_t from = settled() ? 0 : -f_layout_.index(c[0], c[1], c[2]);
    write(numbered('f', i),
          [&](int x, int y, int z) { return stored[f_layout_.index(x, y, z) + from]; });
  }
  for (std::size_t d = 0; d < 3; ++d)
    write(velocity_names[d], [&](int x, int y, int z) { return u_[d][n_layout_.index(x, y, z)]; });
  if (exponential())
    for (std::size_t k = 0; k < fluid::sources; ++k) {
      write(numbered('s', k),
            [&](int x, int y, int z) { return last_[k][f_layout_.index(x, y, z)]; });
      write(numbered('t', k),
            [&](int x, int y, int z) { return present_[k][f_layout_.index(x, y, z)]; });
    }
  file.close();
}

template <class Real> void LatticeFluid<Real>::load(const std::string& path) {
  io::NodeFile file(at_.comm, path, block(), io::NodeFile::Open::read);
  std::vector<Real> values(block().owned());
  const auto read = [&](const std::string& name, Real* stored, const Layout& layout) {
    file.read(name, std::span<Real>(values));
    for_each_owned(block().size, [&](int x, int y, int z, std::size_t index) {
      stored[layout.index(x, y, z)] = values[index];
    });
  };
  for (std::size_t i = 0; i < 19; ++i) read(numbered('f', i), f_[i], f_layout_);
  for (std::size_t d = 0; d < 3; ++d) read(velocity_names[d], u_[d], n_layout_);
  next_ = fluid::Pass::local;
  exchange_velocity(0);
  if (!exponential()) return;
  for (std::size_t k = 0; k < fluid::sources; ++k) {
    read(numbered('s', k), last_[k], f_layout_);
    read(numbered('t', k), present_[k], f_layout_);
  }
  exchange_sources(0);
}

template <class Real> double LatticeFluid<Real>::saved_bytes() const {
  const double scalars = 19 + 3 + (exponential() ? 2.0 * fluid::sources : 0.0);
  double bytes = scalars * sizeof(Real);
  for (const int n : block().global) bytes *= n;
  return bytes;
}

template class LatticeFluid<double>;  // the members defined here
template class LatticeFluid<float>;

}  // namespace hemomag::solver
