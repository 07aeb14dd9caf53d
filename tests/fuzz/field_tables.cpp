// Tables of B on a grid, and the field between their points.
#include <cmath>

#include "contract.hpp"
#include "io/field_table_file.hpp"

namespace {

using namespace hemomag;

void read_table(const std::string& path) {
  const lattice::FieldTable table = io::read_field_table(path);
  fuzz::require(table.B.size() == table.n[0] * table.n[1] * table.n[2], "a value on each point");
  for (std::size_t a = 0; a < 3; ++a) {
    fuzz::require(table.n[a] >= 4, "four points along each axis");
    fuzz::require(table.spacing[a] > 0 && std::isfinite(table.spacing[a]), "spacings are lengths");
    fuzz::require(std::isfinite(table.first[a]), "places are finite");
  }
  for (const Vec3& B : table.B)
    fuzz::require(std::isfinite(B.x) && std::isfinite(B.y) && std::isfinite(B.z),
                  "values are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::directory().write("B.csv", fuzz::bytes(data, size));
  fuzz::value_or_error([&] { read_table(path); });
  return 0;
}
