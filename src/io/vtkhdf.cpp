#include "io/vtkhdf.hpp"

#include <hdf5.h>

#include "base/error.hpp"
#include "io/hdf5_handle.hpp"
#include "io/shared_file.hpp"

namespace hemomag::io {
namespace {

using Handle = Hdf5Handle;

void check(herr_t status, const std::string& what) {
  if (status < 0) throw FileError(what + ": HDF5 could not write it (disk full?)");
}

/// The file being written and the few things VTKHDF needs of HDF5.
class File {
public:
  File(MPI_Comm comm, const std::string& path, const char* type)
      : path_(path), file_(comm, path, SharedFile::Open::create),
        root_(H5Gcreate2(file_, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path) {
    attribute("Version", H5T_NATIVE_INT, std::array{1, 0});
    const std::string text = type;
    const Handle string(H5Tcopy(H5T_C_S1), H5Tclose, path_);
    H5Tset_size(string, text.size());
    H5Tset_strpad(string, H5T_STR_NULLPAD);
    const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, path_);
    const Handle a(H5Acreate2(root_, "Type", string, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                   path_);
    check(H5Awrite(a, string, text.data()), path_);
  }

  template <class T, std::size_t N>
  void attribute(const char* name, hid_t type, const std::array<T, N>& values) {
    const hsize_t n = N;
    const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose, path_);
    const Handle a(H5Acreate2(root_, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path_);
    check(H5Awrite(a, type, values.data()), path_);
  }

  void group(const char* name) {
    Handle(H5Gcreate2(root_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path_);
  }

  void dataset(const std::string& name, hid_t stored, hid_t given, const Box& box,
               const void* values) {
    file_.write(root_, name, stored, given, box, values);
  }

  void close() {
    root_.close(path_);
    file_.close();
  }

private:
  std::string path_;
  SharedFile file_;
  Handle root_;
};

/// Where this rank's `mine` items stand among those of all ranks.
struct Share {
  hsize_t before = 0, all = 0, mine = 0;
  Share(MPI_Comm comm, std::size_t n) : mine(n) {
    unsigned long long m = n, b = 0, a = 0;
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Exscan(&m, &b, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
    MPI_Allreduce(&m, &a, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
    before = rank == 0 ? 0 : b;
    all = a;
  }
};

/// Vectors have their components as the last extent.
void add_components(Box& box, int components) {
  if (components == 1) return;
  box.whole.push_back(static_cast<hsize_t>(components));
  box.start.push_back(0);
  box.count.push_back(static_cast<hsize_t>(components));
}

void write_array(File& file, const std::string& group, const DataArray& array, const Share& share) {
  Box box{{share.all}, {share.before}, {share.mine}};
  add_components(box, array.components);
  file.dataset(group + "/" + array.name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, box,
               array.values.data());
}

}  // namespace

void write_image(MPI_Comm comm, const std::string& path, const lattice::Block& block, double dx,
                 const std::vector<DataArray>& arrays) {
  File file(comm, path, "ImageData");
  file.attribute(
      "WholeExtent", H5T_NATIVE_INT,
      std::array{0, block.global[0] - 1, 0, block.global[1] - 1, 0, block.global[2] - 1});
  file.attribute("Origin", H5T_NATIVE_DOUBLE, std::array{dx / 2, dx / 2, dx / 2});
  file.attribute("Spacing", H5T_NATIVE_DOUBLE, std::array{dx, dx, dx});
  file.attribute("Direction", H5T_NATIVE_DOUBLE, std::array{1., 0., 0., 0., 1., 0., 0., 0., 1.});
  file.group("PointData");
  for (const DataArray& array : arrays) {
    Box box;
    for (const std::size_t d : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
      box.whole.push_back(static_cast<hsize_t>(block.global[d]));
      box.start.push_back(static_cast<hsize_t>(block.begin[d]));
      box.count.push_back(static_cast<hsize_t>(block.size[d]));
    }
    add_components(box, array.components);
    file.dataset("PointData/" + array.name, H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, box,
                 array.values.data());
  }
  file.close();
}

void write_grid(MPI_Comm comm, const std::string& path, Shape shape, std::span<const double> points,
                std::span<const std::int64_t> connectivity,
                const std::vector<DataArray>& point_arrays,
                const std::vector<DataArray>& cell_arrays) {
  const std::size_t corners = shape == Shape::triangle ? 3 : 1;
  const std::size_t cells = connectivity.size() / corners;
  const Share at_points(comm, points.size() / 3), at_cells(comm, cells),
      at_corners(comm, connectivity.size());
  // A rank without points makes no partition, except that an empty file needs one.
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const bool part = at_points.mine > 0 || (at_points.all == 0 && rank == 0);
  const Share at_parts(comm, part ? 1 : 0);

  File file(comm, path, "UnstructuredGrid");
  file.group("PointData");
  file.group("CellData");
  const auto count_of = [&](const char* name, std::int64_t n) {
    file.dataset(name, H5T_STD_I64LE, H5T_NATIVE_INT64,
                 {{at_parts.all}, {at_parts.before}, {at_parts.mine}}, &n);
  };
  count_of("NumberOfPoints", static_cast<std::int64_t>(at_points.mine));
  count_of("NumberOfCells", static_cast<std::int64_t>(cells));
  count_of("NumberOfConnectivityIds", static_cast<std::int64_t>(connectivity.size()));
  file.dataset("Points", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
               {{at_points.all, 3}, {at_points.before, 0}, {at_points.mine, 3}}, points.data());
  file.dataset("Connectivity", H5T_STD_I64LE, H5T_NATIVE_INT64,
               {{at_corners.all}, {at_corners.before}, {at_corners.mine}}, connectivity.data());
  std::vector<std::int64_t> offsets(part ? cells + 1 : 0);
  for (std::size_t k = 0; k < offsets.size(); ++k)
    offsets[k] = static_cast<std::int64_t>(k * corners);
  const Share at_offsets(comm, offsets.size());
  file.dataset("Offsets", H5T_STD_I64LE, H5T_NATIVE_INT64,
               {{at_offsets.all}, {at_offsets.before}, {at_offsets.mine}}, offsets.data());
  const std::vector<std::uint8_t> types(cells, static_cast<std::uint8_t>(shape));
  file.dataset("Types", H5T_STD_U8LE, H5T_NATIVE_UINT8,
               {{at_cells.all}, {at_cells.before}, {at_cells.mine}}, types.data());
  for (const auto& array : point_arrays) write_array(file, "PointData", array, at_points);
  for (const auto& array : cell_arrays) write_array(file, "CellData", array, at_cells);
  file.close();
}

}  // namespace hemomag::io
