#pragma once
#include <span>
#include <vector>

#include "lattice/node_layout.hpp"
#include "solver/neighbourhood.hpp"

namespace hemomag::solver {

/// Some component arrays and the box of nodes of them that is sent or received.
struct Slab {
  std::span<double* const> fields;  ///< at node (0, 0, 0)
  lattice::NodeBox box;
};

enum class Combine { copy, add };

/// Moves slabs of node values between the two face neighbours along an axis. A rank that is its own
/// neighbour (periodic, one rank along the axis) goes the same way without MPI. Buffers grow once
/// and are kept.
class HaloExchange {
public:
  explicit HaloExchange(const Neighbourhood& at) : at_(at) {}

  /// Send `to_low` to the low neighbour, where it arrives as its `from_high`, and `to_high` to the
  /// high neighbour, where it arrives as `from_low`. Sides without a neighbour are skipped.
  void exchange(int axis, const lattice::NodeLayout& layout, const Slab& to_low,
                const Slab& from_high, const Slab& to_high, const Slab& from_low, Combine combine);

private:
  const Neighbourhood& at_;
  std::vector<double> send_[2], receive_[2];
};

}  // namespace hemomag::solver
