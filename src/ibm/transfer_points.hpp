#pragma once
#include <cstddef>

// The plain-pointer face of transfer_points.cpp, which is compiled once per instruction set.

namespace hemomag::ibm {

/// @tparam Node  type of the node arrays: double or float, const when they are only read
template <class Node> struct TransferArgs {
  int kernel;     ///< DeltaKernel
  Node* node[3];  ///< at node (0, 0, 0)
  std::ptrdiff_t row, plane;
  double begin[3];
  int lowest, highest[3];  ///< first and last node index that exists, halo included
  const double* x;         ///< [n][3]
  double* value;           ///< [n][3]: velocity out or force in
  const int* mask;
  int bits, without;
  std::ptrdiff_t n;
};

namespace sse2 {
std::ptrdiff_t interpolate(const TransferArgs<const double>&);
std::ptrdiff_t interpolate(const TransferArgs<const float>&);
std::ptrdiff_t spread(const TransferArgs<double>&);
std::ptrdiff_t spread(const TransferArgs<float>&);
}  // namespace sse2
namespace avx2 {
std::ptrdiff_t interpolate(const TransferArgs<const double>&);
std::ptrdiff_t interpolate(const TransferArgs<const float>&);
std::ptrdiff_t spread(const TransferArgs<double>&);
std::ptrdiff_t spread(const TransferArgs<float>&);
}  // namespace avx2
namespace avx512 {
std::ptrdiff_t interpolate(const TransferArgs<const double>&);
std::ptrdiff_t interpolate(const TransferArgs<const float>&);
std::ptrdiff_t spread(const TransferArgs<double>&);
std::ptrdiff_t spread(const TransferArgs<float>&);
}  // namespace avx512

}  // namespace hemomag::ibm
