// Checkpoints and snapshots as a run or `hemomag profiles` takes them up. The first byte of an
// input says what the others are: the manifest of a checkpoint, with its seal as it is or made
// right, so that what lies behind it is reached; an index of snapshots; or an HDF5 file, put
// together from them without an error of HDF5's own, since the readers have to notice what does not
// fit. Damaged bytes of HDF5 and of LAMMPS's restart file are for the checksum to find, before a
// library sees them.
#include <array>
#include <cstring>
#include <vector>

#include <mpi.h>
#include <nlohmann/json.hpp>

#include "contract.hpp"
#include "io/checkpoint_directory.hpp"
#include "io/checksum.hpp"
#include "io/files.hpp"
#include "io/node_file.hpp"
#include "io/read_vtkhdf.hpp"

namespace {

using namespace hemomag;

/// Makes the seal right, and the checksums of files that are there.
std::string sealed(std::string_view text) {
  auto m = nlohmann::json::parse(text, nullptr, false);
  if (!m.is_object()) return std::string(text);
  m.erase("seal");
  char digits[17];
  try {
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(io::checksum_of(m.dump())));
  } catch (const nlohmann::json::exception&) {
    return std::string(text);  // no text in UTF-8
  }
  m["seal"] = digits;
  return m.dump();
}

void find_checkpoint(const std::string& manifest) {
  std::filesystem::create_directories(fuzz::directory().path() / "checkpoint");
  fuzz::directory().write("checkpoint/fluid.h5", "fluid");
  fuzz::directory().write("checkpoint/manifest.json", manifest);
  const auto path = (fuzz::directory().path() / "checkpoint").string();
  const auto found = io::find_checkpoint(MPI_COMM_WORLD, path);
  fuzz::require(found.directory == path || (found.directory.empty() && found.refused.size() == 1),
                "a checkpoint is whole, or there is a reason");
  fuzz::require(found.refused.empty() || found.refused[0] == hemomag::on_one_line(found.refused[0]),
                "a reason is one line");
}

/// The bytes of an input as numbers; zeros when they are used up.
class Numbers {
public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes) {}
  bool any() const { return !bytes_.empty(); }
  /// From 0 to n - 1.
  std::size_t below(std::size_t n) { return next() % n; }
  double value() {
    double v = 0;
    for (std::size_t k = 0; k < sizeof v; ++k) reinterpret_cast<unsigned char*>(&v)[k] = next();
    return v;
  }

private:
  unsigned char next() {
    if (bytes_.empty()) return 0;
    const auto b = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return b;
  }
  std::string_view bytes_;
};

struct Extents {
  int rank;
  std::array<hsize_t, 4> size;
  hsize_t count() const {
    hsize_t n = 1;
    for (int d = 0; d < rank; ++d) n *= size[static_cast<std::size_t>(d)];
    return n;
  }
};

Extents extents(Numbers& numbers) {
  Extents e{static_cast<int>(numbers.below(5)), {}};
  for (auto& n : e.size) n = numbers.below(7);
  if (numbers.below(32) == 1) e.size[0] = hsize_t{1} << 40;  // of which nothing is stored
  return e;
}

hid_t file_type(Numbers& numbers) {
  switch (numbers.below(8)) {
  case 0:
    return H5T_IEEE_F32LE;
  case 1:
    return H5T_STD_I64LE;
  case 2:
    return H5T_STD_U8BE;
  case 3:
    return H5T_C_S1;
  default:
    return H5T_IEEE_F64LE;
  }
}

/// A dataset or attribute on `at` with some of its values set.
void add(hid_t at, const std::string& name, bool attribute, Numbers& numbers) {
  const Extents e = extents(numbers);
  const hid_t type = file_type(numbers);
  const io::Hdf5Handle space(e.rank == 0 ? H5Screate(numbers.below(2) == 0 ? H5S_SCALAR : H5S_NULL)
                                         : H5Screate_simple(e.rank, e.size.data(), nullptr),
                             H5Sclose, name);
  const io::Hdf5Handle made(
      attribute ? H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT)
                : H5Dcreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      attribute ? H5Aclose : H5Dclose, name);
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  if (type == H5T_C_S1 || points <= 0 || points > 10000) return;
  std::vector<double> values(e.count());
  const std::size_t kind = numbers.below(3);
  for (double& v : values)
    v = kind == 0 ? static_cast<double>(numbers.below(16)) - 4 : kind == 1 ? numbers.value() : 1.0;
  if (attribute)
    H5Awrite(made, H5T_NATIVE_DOUBLE, values.data());
  else
    H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

std::string hdf5_file(Numbers& numbers, const std::vector<const char*>& datasets,
                      const std::vector<const char*>& attributes) {
  const auto path = (fuzz::directory().path() / "a.h5").string();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const io::Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                            H5Fclose, path);
  if (attributes.empty()) {
    for (const char* name : datasets)
      if (numbers.below(8) > 0) add(file, name, false, numbers);
    return path;
  }
  if (numbers.below(16) == 1) return path;
  const io::Hdf5Handle group(H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Gclose, path),
      points(H5Gcreate2(group, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
  for (const char* name : attributes)
    if (numbers.below(8) > 0) add(group, name, true, numbers);
  for (const char* name : datasets)
    if (numbers.below(8) > 0) add(group, name, false, numbers);
  return path;
}

void read_nodes(Numbers numbers) {
  const std::string path = hdf5_file(numbers, {"f00", "ux"}, {});
  const int n = 4;
  const lattice::Block block{{n, n, n}, {0, 0, 0}, {n, n, n}};
  io::NodeFile file(MPI_COMM_WORLD, path, block, io::NodeFile::Open::read);
  std::vector<double> f(block.owned());
  std::vector<float> u(block.owned());
  file.read("f00", std::span<double>(f));
  file.read("ux", std::span<float>(u));
}

void read_fluid(Numbers numbers) {
  const auto image =
      io::read_image(hdf5_file(numbers, {"PointData/u"}, {"WholeExtent", "Spacing"}), "u");
  std::size_t count = 1;
  for (const int n : image.nodes) {
    fuzz::require(n > 0, "an image has nodes");
    count *= static_cast<std::size_t>(n);
  }
  fuzz::require(image.values.size() == count, "a vector on every node");
}

void read_cells(Numbers numbers) {
  const auto grid = io::read_triangles(hdf5_file(
      numbers, {"Points", "Connectivity", "NumberOfPoints", "NumberOfConnectivityIds"}, {"Type"}));
  for (const auto& t : grid.triangles)
    for (const auto v : t)
      fuzz::require(v >= 0 && v < static_cast<std::int64_t>(grid.points.size()),
                    "corners are points");
}

void read(char what, std::string_view input) {
  switch (what) {
  case 'm':
    return find_checkpoint(std::string(input));
  case 'i':
    io::read_series(fuzz::directory().write("a.series", input));
    return;
  case 's': {
    const std::string path = fuzz::directory().write("b.series", input);
    io::SeriesIndex index(path);
    index.resume(2);
    return;
  }
  case 'n':
    return read_nodes(Numbers(input));
  case 'f':
    return read_fluid(Numbers(input));
  case 'c':
    return read_cells(Numbers(input));
  default:
    return find_checkpoint(sealed(input));
  }
}

struct Mpi {
  Mpi() { MPI_Init(nullptr, nullptr); }
  ~Mpi() { MPI_Finalize(); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Mpi mpi;
  if (size == 0) return 0;
  const std::string_view input = fuzz::bytes(data, size);
  fuzz::value_or_error([&] { read(input.front(), input.substr(1)); });
  return 0;
}
