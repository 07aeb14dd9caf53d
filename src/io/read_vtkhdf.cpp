#include "io/read_vtkhdf.hpp"

#include <algorithm>
#include <fstream>

#include <hdf5.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace hemomag::io {
namespace {

/// A file opened for reading; every object it opens is closed before it.
class Reader {
public:
  explicit Reader(const std::string& path) : path_(path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our own message is enough
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) throw Error(path + ": cannot be opened as HDF5");
  }
  ~Reader() { H5Fclose(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  template <class T> std::vector<T> dataset(const std::string& name, hid_t type) const {
    const hid_t data = H5Dopen2(file_, ("VTKHDF/" + name).c_str(), H5P_DEFAULT);
    if (data < 0) throw Error(path_ + ": has no " + name);
    const hid_t space = H5Dget_space(data), stored = H5Dget_type(data);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    // Memory is taken for what the file holds, not for what it says.
    const bool whole = count >= 0 && H5Dget_storage_size(data) / H5Tget_size(stored) >=
                                         static_cast<hsize_t>(count);
    std::vector<T> values(whole ? static_cast<std::size_t>(count) : 0);
    const herr_t status =
        values.empty() ? 0 : H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Tclose(stored);
    H5Sclose(space);
    H5Dclose(data);
    if (!whole || status < 0) throw Error(path_ + ": " + name + " cannot be read");
    return values;
  }

  template <class T, std::size_t N> std::array<T, N> attribute(const char* name, hid_t type) const {
    std::array<T, N> values{};
    const hid_t a = H5Aopen_by_name(file_, "VTKHDF", name, H5P_DEFAULT, H5P_DEFAULT);
    if (a < 0) throw Error(path_ + ": has no " + name);
    const hid_t space = H5Aget_space(a);
    const bool fits = H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(N);
    const herr_t status = fits ? H5Aread(a, type, values.data()) : -1;
    H5Sclose(space);
    H5Aclose(a);
    if (status < 0) throw Error(path_ + ": " + name + " cannot be read");
    return values;
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(path_ + ": " + what); }

private:
  std::string path_;
  hid_t file_;
};

}  // namespace

VectorImage read_image(const std::string& path, const std::string& array) {
  const Reader file(path);
  const auto extent = file.attribute<int, 6>("WholeExtent", H5T_NATIVE_INT);
  VectorImage image;
  image.spacing = file.attribute<double, 3>("Spacing", H5T_NATIVE_DOUBLE)[0];
  const auto values = file.dataset<double>("PointData/" + array, H5T_NATIVE_DOUBLE);
  std::size_t count = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const long nodes = long{extent[2 * d + 1]} - extent[2 * d] + 1;
    if (nodes < 1 || static_cast<std::size_t>(nodes) > values.size())
      file.fail(array + " is not a vector on every node");
    image.nodes[d] = static_cast<int>(nodes);
    count = std::min(count * static_cast<std::size_t>(nodes), values.size());
  }
  if (values.size() != 3 * count) file.fail(array + " is not a vector on every node");
  for (std::size_t k = 0; k < count; ++k)
    image.values.push_back({values[3 * k], values[3 * k + 1], values[3 * k + 2]});
  return image;
}

TriangleGrid read_triangles(const std::string& path) {
  const Reader file(path);
  const auto x = file.dataset<double>("Points", H5T_NATIVE_DOUBLE);
  const auto corners = file.dataset<std::int64_t>("Connectivity", H5T_NATIVE_INT64);
  const auto points_of = file.dataset<std::int64_t>("NumberOfPoints", H5T_NATIVE_INT64);
  const auto corners_of = file.dataset<std::int64_t>("NumberOfConnectivityIds", H5T_NATIVE_INT64);
  TriangleGrid grid;
  for (std::size_t k = 0; k + 2 < x.size(); k += 3)
    grid.points.push_back({x[k], x[k + 1], x[k + 2]});
  // Corners count from the first point of their partition.
  std::int64_t first_point = 0;
  std::size_t at = 0;
  for (std::size_t part = 0; part < points_of.size() && part < corners_of.size(); ++part) {
    if (points_of[part] < 0 ||
        points_of[part] > static_cast<std::int64_t>(grid.points.size()) - first_point)
      file.fail("counts points that it does not have");
    if (corners_of[part] < 0) file.fail("is not made of triangles");
    const std::size_t end = at + static_cast<std::size_t>(corners_of[part]);
    if (end > corners.size() || corners_of[part] % 3 != 0) file.fail("is not made of triangles");
    for (; at < end; at += 3) {
      std::array<std::int64_t, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (corners[at + k] < 0 || corners[at + k] >= points_of[part])
          file.fail("names points that it does not have");
        t[k] = first_point + corners[at + k];
      }
      grid.triangles.push_back(t);
    }
    first_point += points_of[part];
  }
  return grid;
}

std::vector<SnapshotTime> read_series(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path + ": cannot be read");
  const auto index = nlohmann::json::parse(file, nullptr, false);
  if (index.is_discarded() || !index.contains("files") || !index["files"].is_array())
    throw Error(path + ": is not an index of snapshots");
  std::vector<SnapshotTime> series;
  for (const auto& entry : index["files"]) {
    if (!entry.contains("name") || !entry.contains("time") || !entry["name"].is_string() ||
        !entry["time"].is_number())
      throw Error(path + ": is not an index of snapshots");
    series.push_back({entry["name"].get<std::string>(), entry["time"].get<double>()});
  }
  return series;
}

}  // namespace hemomag::io
