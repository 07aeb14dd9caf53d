#include "io/shared_file.hpp"

#include <functional>
#include <numeric>

namespace hemomag::io {
namespace {

constexpr const char* not_opened = "HDF5 could not create or open it";
constexpr const char* not_written = "HDF5 could not write it (disk full?)";

hsize_t volume(const std::vector<hsize_t>& extent) {
  return std::accumulate(extent.begin(), extent.end(), hsize_t{1}, std::multiplies<>());
}

/// Select this rank's box of a dataset, or nothing of either.
void select(const Box& box, hid_t in_file, hid_t in_memory) {
  if (volume(box.count) > 0) {
    H5Sselect_hyperslab(in_file, H5S_SELECT_SET, box.start.data(), nullptr, box.count.data(),
                        nullptr);
  } else {
    H5Sselect_none(in_file);
    H5Sselect_none(in_memory);
  }
}

hid_t simple(const std::vector<hsize_t>& extent) {
  return H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
}

}  // namespace

SharedFile::SharedFile(MPI_Comm comm, const std::string& path, Open how)
    : comm_(comm), path_(path), access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path),
      transfer_(H5Pcreate(H5P_DATASET_XFER), H5Pclose, path), file_(open(how)),
      written_(how == Open::create) {
  H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
  agree(file_ >= 0, not_opened);
}

hid_t SharedFile::open(Open how) const {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our own message is enough
  H5Pset_fapl_mpio(access_, comm_, MPI_INFO_NULL);
  return how == Open::create ? H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_)
                             : H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access_);
}

SharedFile::~SharedFile() {
  if (file_ >= 0 && !(failed_ && written_)) H5Fclose(file_);
}

/// Every rank learns whether all are well.
void SharedFile::agree(bool good, const char* failure) {
  int mine = good, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, comm_);
  if (all) return;
  failed_ = true;
  throw FileError(path_ + ": " + failure);
}

void SharedFile::write(hid_t where, const std::string& name, hid_t stored, hid_t given,
                       const Box& box, const void* values) {
  const Hdf5Handle space(simple(box.whole), H5Sclose, path_),
      memory(simple(box.count), H5Sclose, path_),
      creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path_);
  H5Pset_obj_track_times(creation, false);  // equal states make equal files
  const hid_t data =
      H5Dcreate2(where, name.c_str(), stored, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  agree(data >= 0, not_written);
  select(box, space, memory);
  // Where there is nothing to write at all, MPI-IO refuses to.
  const bool good =
      volume(box.whole) == 0 || H5Dwrite(data, given, memory, space, transfer_, values) >= 0;
  agree(good, not_written);
  agree(H5Dclose(data) >= 0, not_written);
}

void SharedFile::read(hid_t dataset, hid_t given, const Box& box, void* values) {
  const Hdf5Handle space(simple(box.whole), H5Sclose, path_),
      memory(simple(box.count), H5Sclose, path_);
  select(box, space, memory);
  agree(H5Dread(dataset, given, memory, space, transfer_, values) >= 0, "could not be read");
}

void SharedFile::close() {
  const hid_t file = file_;
  file_ = -1;
  agree(H5Fclose(file) >= 0, not_written);
}

}  // namespace hemomag::io
