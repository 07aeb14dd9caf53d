#include "io/node_file.hpp"

#include <array>
#include <type_traits>

namespace hemomag::io {
namespace {

/// z, y, x: x is fastest in the file as in memory.
std::vector<hsize_t> extent(const std::array<int, 3>& n) {
  return {static_cast<hsize_t>(n[2]), static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[0])};
}

template <class Real> hid_t stored() {
  return std::is_same_v<Real, float> ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}
template <class Real> hid_t native() {
  return std::is_same_v<Real, float> ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
}

}  // namespace

Box NodeFile::mine() const {
  return {extent(block_.global), extent(block_.begin), extent(block_.size)};
}

template <class Real> void NodeFile::write(const std::string& name, std::span<const Real> values) {
  file_.write(file_, name, stored<Real>(), native<Real>(), mine(), values.data());
}

template <class Real> void NodeFile::read(const std::string& name, std::span<Real> values) {
  const std::string what = file_.path() + ": " + name;
  const Hdf5Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what),
      space(H5Dget_space(data), H5Sclose, what), type(H5Dget_type(data), H5Tclose, what);
  const Box box = mine();
  std::vector<hsize_t> found(3);
  if (H5Sget_simple_extent_ndims(space) != 3 ||
      H5Sget_simple_extent_dims(space, found.data(), nullptr) != 3 || found != box.whole ||
      H5Tequal(type, stored<Real>()) <= 0)
    throw FileError(what + " is of another grid or precision than this fluid");
  file_.read(data, native<Real>(), box, values.data());
}

template void NodeFile::write(const std::string&, std::span<const double>);
template void NodeFile::write(const std::string&, std::span<const float>);
template void NodeFile::read(const std::string&, std::span<double>);
template void NodeFile::read(const std::string&, std::span<float>);

}  // namespace hemomag::io
