#include "base/simd.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"

namespace hemomag {

SimdLevel simd_level() {
  static const SimdLevel level = [] {
    SimdLevel widest = SimdLevel::sse2;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) widest = SimdLevel::avx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
      widest = SimdLevel::avx512;
    const char* asked = std::getenv("HEMOMAG_SIMD");
    if (!asked) return widest;
    for (auto candidate : {SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512})
      if (std::string_view(asked) == name(candidate)) return std::min(candidate, widest);
    throw Error("HEMOMAG_SIMD=" + std::string(asked) +
                ": is unknown; accepted: sse2, avx2, avx512");
  }();
  return level;
}

const char* name(SimdLevel level) {
  switch (level) {
  case SimdLevel::sse2:
    return "sse2";
  case SimdLevel::avx2:
    return "avx2";
  case SimdLevel::avx512:
    return "avx512";
  }
  return "?";
}

}  // namespace hemomag
