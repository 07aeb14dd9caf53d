#pragma once
#include <string>

#include <hdf5.h>

#include "base/error.hpp"

namespace hemomag::io {

/// An HDF5 handle that closes itself.
class Hdf5Handle {
public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw FileError(what + ": HDF5 could not create or open it");
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }

  /// Close now: what was buffered reaches the file, or the reader learns that it did not.
  void close(const std::string& what) {
    const hid_t id = id_;
    id_ = -1;
    if (close_(id) < 0) throw FileError(what + ": HDF5 could not write it (disk full?)");
  }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace hemomag::io
