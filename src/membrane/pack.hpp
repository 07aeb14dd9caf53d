#pragma once
#include <cstddef>

#include <immintrin.h>

// Several doubles that are computed on at once, for the files that hemo_simd compiles once per
// instruction set: the laws are templates on the number, and take a Pack where tests give a double.
// Everything is always inlined, so that no copy of one instruction set can be linked into another.

namespace hemomag::membrane::HEMOMAG_SIMD {

struct Pack {
#if defined HEMOMAG_SIMD_avx512
  static constexpr int width = 8;
#elif defined HEMOMAG_SIMD_avx2
  static constexpr int width = 4;
#else
  static constexpr int width = 2;
#endif
  typedef double Raw __attribute__((vector_size(width * sizeof(double))));
  typedef double Unaligned
      __attribute__((vector_size(width * sizeof(double)), aligned(8), may_alias));
  Raw v;

  [[gnu::always_inline]] inline Pack() : v{} {}
  [[gnu::always_inline]] inline Pack(Raw raw) : v(raw) {}
  [[gnu::always_inline]] inline Pack(double same) : v(Raw{} + same) {}

  [[gnu::always_inline]] static inline Pack load(const double* p) {
    return Pack(static_cast<Raw>(*reinterpret_cast<const Unaligned*>(p)));
  }
  [[gnu::always_inline]] inline double operator[](int lane) const { return v[lane]; }
  [[gnu::always_inline]] inline Pack& operator+=(Pack b) { return v += b.v, *this; }

  [[gnu::always_inline]] friend inline Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  [[gnu::always_inline]] friend inline Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  [[gnu::always_inline]] friend inline Pack operator-(Pack a) { return Pack(-a.v); }
  [[gnu::always_inline]] friend inline Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  [[gnu::always_inline]] friend inline Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }

  /// Whether a < b in every lane; false where a lane is not a number.
  [[gnu::always_inline]] friend inline bool all_less(Pack a, Pack b) {
    const auto less = a.v < b.v;
    bool all = true;
    for (int lane = 0; lane < width; ++lane) all &= less[lane] != 0;
    return all;
  }
  [[gnu::always_inline]] friend inline Pack sqrt(Pack a) {
#if defined HEMOMAG_SIMD_avx512  // masked: g++ 12 warns of the other form's undefined operand
    return Pack(static_cast<Raw>(_mm512_maskz_sqrt_pd(0xff, static_cast<__m512d>(a.v))));
#elif defined HEMOMAG_SIMD_avx2
    return Pack(static_cast<Raw>(_mm256_sqrt_pd(static_cast<__m256d>(a.v))));
#else
    return Pack(static_cast<Raw>(_mm_sqrt_pd(static_cast<__m128d>(a.v))));
#endif
  }
  /// A number at a time: only springs with an exponent other than the paper's ask for it.
  [[gnu::always_inline]] friend inline Pack pow(Pack a, double exponent) {
    for (int lane = 0; lane < width; ++lane) a.v[lane] = __builtin_pow(a.v[lane], exponent);
    return a;
  }
};

/// A vector in each lane.
struct Pack3 {
  using Number = Pack;
  Pack x, y, z;

  [[gnu::always_inline]] friend inline Pack3 operator+(const Pack3& a, const Pack3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend inline Pack3 operator-(const Pack3& a, const Pack3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend inline Pack3 operator-(const Pack3& a) {
    return {-a.x, -a.y, -a.z};
  }
  [[gnu::always_inline]] friend inline Pack3 operator*(Pack s, const Pack3& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  [[gnu::always_inline]] friend inline Pack dot(const Pack3& a, const Pack3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  [[gnu::always_inline]] friend inline Pack3 cross(const Pack3& a, const Pack3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  [[gnu::always_inline]] friend inline Pack norm2(const Pack3& a) { return dot(a, a); }
  [[gnu::always_inline]] friend inline Pack norm(const Pack3& a) { return sqrt(dot(a, a)); }
};

}  // namespace hemomag::membrane::HEMOMAG_SIMD
