#include "io/node_file.hpp"

#include <array>
#include <type_traits>

namespace hemomag::io {
namespace {

using Extent = std::array<hsize_t, 3>;

/// z, y, x: x is fastest in the file as in memory.
Extent extent(const std::array<int, 3>& n) {
  return {static_cast<hsize_t>(n[2]), static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[0])};
}

template <class Real> hid_t stored() {
  return std::is_same_v<Real, float> ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}
template <class Real> hid_t native() {
  return std::is_same_v<Real, float> ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
}

}  // namespace

NodeFile::NodeFile(MPI_Comm comm, const std::string& path, const lattice::Block& block, Open how)
    : path_(path), block_(block), access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path),
      transfer_(H5Pcreate(H5P_DATASET_XFER), H5Pclose, path),
      file_(open(comm, how), H5Fclose, path) {
  H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
}

hid_t NodeFile::open(MPI_Comm comm, Open how) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our own message is enough
  H5Pset_fapl_mpio(access_, comm, MPI_INFO_NULL);
  return how == Open::create ? H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_)
                             : H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access_);
}

void NodeFile::select_mine(hid_t space) const {
  const Extent start = extent(block_.begin), count = extent(block_.size);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
}

template <class Real> void NodeFile::write(const std::string& name, std::span<const Real> values) {
  const Extent whole = extent(block_.global), mine = extent(block_.size);
  const Hdf5Handle space(H5Screate_simple(3, whole.data(), nullptr), H5Sclose, path_),
      memory(H5Screate_simple(3, mine.data(), nullptr), H5Sclose, path_);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path_);
  H5Pset_obj_track_times(creation, false);  // equal states make equal files
  Hdf5Handle data(
      H5Dcreate2(file_, name.c_str(), stored<Real>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose, path_);
  select_mine(space);
  if (H5Dwrite(data, native<Real>(), memory, space, transfer_, values.data()) < 0)
    throw FileError(path_ + ": HDF5 could not write it (disk full?)");
  data.close(path_);
}

template <class Real> void NodeFile::read(const std::string& name, std::span<Real> values) {
  const Extent whole = extent(block_.global), mine = extent(block_.size);
  const Hdf5Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, path_ + ": " + name),
      space(H5Dget_space(data), H5Sclose, path_), type(H5Dget_type(data), H5Tclose, path_),
      memory(H5Screate_simple(3, mine.data(), nullptr), H5Sclose, path_);
  Extent found{};
  if (H5Sget_simple_extent_ndims(space) != 3 ||
      H5Sget_simple_extent_dims(space, found.data(), nullptr) != 3 || found != whole ||
      H5Tequal(type, stored<Real>()) <= 0)
    throw FileError(path_ + ": " + name + " is of another grid or precision than this fluid");
  select_mine(space);
  if (H5Dread(data, native<Real>(), memory, space, transfer_, values.data()) < 0)
    throw FileError(path_ + ": " + name + " could not be read");
}

template void NodeFile::write(const std::string&, std::span<const double>);
template void NodeFile::write(const std::string&, std::span<const float>);
template void NodeFile::read(const std::string&, std::span<double>);
template void NodeFile::read(const std::string&, std::span<float>);

}  // namespace hemomag::io
