#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "lattice/node_layout.hpp"
#include "solver/neighbourhood.hpp"

namespace hemomag::solver {

/// Some component arrays and the box of nodes of them that is sent or received.
template <class Real> struct Slab {
  std::array<Real*, 10> fields{};  ///< at node (0, 0, 0)
  std::size_t count = 0;           ///< of fields
  lattice::NodeBox box;

  Slab() = default;
  template <std::size_t n>
  Slab(const std::array<Real*, n>& all, const lattice::NodeBox& box_) : count(n), box(box_) {
    static_assert(n <= 10);
    std::copy(all.begin(), all.end(), fields.begin());
  }
  std::size_t values() const { return count * box.count(); }
};

enum class Combine { copy, add };

/// Moves slabs of node values between the two face neighbours along an axis. A rank that is its own
/// neighbour (periodic, one rank along the axis) goes the same way without MPI. Buffers grow once
/// and are kept.
template <class Real> class HaloExchange {
public:
  explicit HaloExchange(const Neighbourhood& at) : at_(at) {}

  /// Send `to_low` to the low neighbour, where it arrives as its `from_high`, and `to_high` to the
  /// high neighbour, where it arrives as `from_low`. Sides without a neighbour are skipped. Between
  /// start and finish other nodes may be worked on.
  void start(int axis, const lattice::NodeLayout& layout, const Slab<Real>& to_low,
             const Slab<Real>& from_high, const Slab<Real>& to_high, const Slab<Real>& from_low,
             Combine combine) {
    layout_ = layout, combine_ = combine;
    incoming_[0] = from_low, incoming_[1] = from_high;
    partner_[0] = at_.neighbour[axis][0], partner_[1] = at_.neighbour[axis][1];
    const Slab<Real>* outgoing[2] = {&to_low, &to_high};
    requests_ = 0;
    self_ = partner_[0] == at_.rank && partner_[1] == at_.rank;
    for (int side = 0; side < 2; ++side) {
      if (partner_[side] == MPI_PROC_NULL) continue;
      fit(receive_[side], incoming_[side]);
      // What comes from the low side was sent towards high, and the other way round: the tag is the
      // sense.
      if (!self_)
        MPI_Irecv(receive_[side].data(), static_cast<int>(incoming_[side].values()), mpi_type(),
                  partner_[side], 1 - side, at_.comm, &request_[requests_++]);
    }
    for (int side = 0; side < 2; ++side) {
      if (partner_[side] == MPI_PROC_NULL) continue;
      if (self_) {
        pack(*outgoing[side], receive_[1 - side]);
        continue;
      }
      fit(send_[side], *outgoing[side]);
      pack(*outgoing[side], send_[side]);
      MPI_Isend(send_[side].data(), static_cast<int>(outgoing[side]->values()), mpi_type(),
                partner_[side], side, at_.comm, &request_[requests_++]);
    }
  }

  void finish() {
    MPI_Waitall(requests_, request_, MPI_STATUSES_IGNORE);
    // Low before high, always: sums come out the same however the messages arrived.
    for (int side = 0; side < 2; ++side)
      if (partner_[side] != MPI_PROC_NULL) unpack(incoming_[side], receive_[side]);
  }

  /// True when an exchange along the axis needs another rank.
  bool remote(int axis) const {
    for (const int other : at_.neighbour[axis])
      if (other != MPI_PROC_NULL && other != at_.rank) return true;
    return false;
  }

private:
  static MPI_Datatype mpi_type() { return std::is_same_v<Real, float> ? MPI_FLOAT : MPI_DOUBLE; }

  static void fit(std::vector<Real>& buffer, const Slab<Real>& slab) {
    if (buffer.size() < slab.values()) buffer.resize(slab.values());
  }

  void pack(const Slab<Real>& slab, std::vector<Real>& buffer) const {
    Real* out = buffer.data();
    for (std::size_t k = 0; k < slab.count; ++k)
      for_each_row(slab.box, layout_, [&](std::ptrdiff_t row, int n) {
        for (int x = 0; x < n; ++x) *out++ = slab.fields[k][row + x];
      });
  }

  void unpack(const Slab<Real>& slab, const std::vector<Real>& buffer) const {
    const Real* in = buffer.data();
    for (std::size_t k = 0; k < slab.count; ++k)
      for_each_row(slab.box, layout_, [&](std::ptrdiff_t row, int n) {
        if (combine_ == Combine::copy)
          for (int x = 0; x < n; ++x) slab.fields[k][row + x] = *in++;
        else
          for (int x = 0; x < n; ++x) slab.fields[k][row + x] += *in++;
      });
  }

  const Neighbourhood& at_;
  std::vector<Real> send_[2], receive_[2];
  lattice::NodeLayout layout_;
  Combine combine_ = Combine::copy;
  Slab<Real> incoming_[2];
  int partner_[2] = {MPI_PROC_NULL, MPI_PROC_NULL};
  MPI_Request request_[4];
  int requests_ = 0;
  bool self_ = false;
};

}  // namespace hemomag::solver
