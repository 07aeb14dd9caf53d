#pragma once
#include "fluid/sweep.hpp"

namespace hemomag::fluid {
namespace sse2 {
void sweep_two_rate(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_two_rate(Pass, const SweepFields<float>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<float>&, const Relaxation&);
}  // namespace sse2
namespace avx2 {
void sweep_two_rate(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_two_rate(Pass, const SweepFields<float>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<float>&, const Relaxation&);
}  // namespace avx2
namespace avx512 {
void sweep_two_rate(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_two_rate(Pass, const SweepFields<float>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<double>&, const Relaxation&);
void sweep_exponential(Pass, const SweepFields<float>&, const Relaxation&);
}  // namespace avx512
}  // namespace hemomag::fluid
