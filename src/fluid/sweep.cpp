#include "fluid/sweep.hpp"

#include "fluid/sweep_rows.hpp"

namespace hemomag::fluid {

void sweep_trt(Pass pass, const SweepFields& fields, const Relaxation& relaxation,
               SimdLevel level) {
  switch (level) {
  case SimdLevel::sse2:
    return sse2::sweep_trt(pass, fields, relaxation);
  case SimdLevel::avx2:
    return avx2::sweep_trt(pass, fields, relaxation);
  case SimdLevel::avx512:
    return avx512::sweep_trt(pass, fields, relaxation);
  }
}

}  // namespace hemomag::fluid
