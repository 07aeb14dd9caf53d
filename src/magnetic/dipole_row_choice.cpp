#include "base/simd.hpp"
#include "magnetic/dipole_rows.hpp"

namespace hemomag::magnetic {

std::ptrdiff_t dipole_row(const DipoleRow& row) {
  switch (simd_level()) {
  case SimdLevel::avx512:
    return avx512::dipole_row(row);
  case SimdLevel::avx2:
    return avx2::dipole_row(row);
  default:
    return sse2::dipole_row(row);
  }
}

}  // namespace hemomag::magnetic
