#pragma once
#include "fluid/sweep.hpp"

namespace hemomag::fluid {
namespace sse2 {
void sweep_trt(Pass, const SweepFields&, const Relaxation&);
}
namespace avx2 {
void sweep_trt(Pass, const SweepFields&, const Relaxation&);
}
namespace avx512 {
void sweep_trt(Pass, const SweepFields&, const Relaxation&);
}
}  // namespace hemomag::fluid
