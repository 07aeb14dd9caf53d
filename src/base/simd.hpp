#pragma once

namespace hemomag {

/// Instruction sets the vector kernels are compiled for. One binary holds all three.
enum class SimdLevel { sse2, avx2, avx512 };

/// The widest level this processor runs, or the lower one named by the environment variable
/// HEMOMAG_SIMD (sse2, avx2, avx512).
SimdLevel simd_level();

const char* name(SimdLevel level);

}  // namespace hemomag
