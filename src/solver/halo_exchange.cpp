#include "solver/halo_exchange.hpp"

namespace hemomag::solver {
namespace {

std::size_t values(const Slab& slab) { return slab.fields.size() * slab.box.count(); }

void pack(const Slab& slab, const lattice::NodeLayout& layout, std::vector<double>& buffer) {
  if (buffer.size() < values(slab)) buffer.resize(values(slab));
  double* out = buffer.data();
  for (const double* field : slab.fields)
    for_each_row(slab.box, layout, [&](std::ptrdiff_t row, int n) {
      for (int x = 0; x < n; ++x) *out++ = field[row + x];
    });
}

void unpack(const Slab& slab, const lattice::NodeLayout& layout, const std::vector<double>& buffer,
            Combine combine) {
  const double* in = buffer.data();
  for (double* field : slab.fields)
    for_each_row(slab.box, layout, [&](std::ptrdiff_t row, int n) {
      if (combine == Combine::copy)
        for (int x = 0; x < n; ++x) field[row + x] = *in++;
      else
        for (int x = 0; x < n; ++x) field[row + x] += *in++;
    });
}

}  // namespace

void HaloExchange::exchange(int axis, const lattice::NodeLayout& layout, const Slab& to_low,
                            const Slab& from_high, const Slab& to_high, const Slab& from_low,
                            Combine combine) {
  const int low = at_.neighbour[axis][0], high = at_.neighbour[axis][1];
  if (low == at_.rank && high == at_.rank) {
    pack(to_low, layout, send_[0]);
    pack(to_high, layout, send_[1]);
    unpack(from_high, layout, send_[0], combine);
    unpack(from_low, layout, send_[1], combine);
    return;
  }
  const Slab* outgoing[2] = {&to_low, &to_high};
  const Slab* incoming[2] = {&from_low, &from_high};
  const int partner[2] = {low, high};
  MPI_Request requests[4];
  int n = 0;
  for (int side = 0; side < 2; ++side) {
    if (partner[side] == MPI_PROC_NULL) continue;
    if (receive_[side].size() < values(*incoming[side]))
      receive_[side].resize(values(*incoming[side]));
    // What comes from the low side was sent towards high, and the other way round: the tag is the
    // sense.
    MPI_Irecv(receive_[side].data(), static_cast<int>(values(*incoming[side])), MPI_DOUBLE,
              partner[side], 1 - side, at_.comm, &requests[n++]);
  }
  for (int side = 0; side < 2; ++side) {
    if (partner[side] == MPI_PROC_NULL) continue;
    pack(*outgoing[side], layout, send_[side]);
    MPI_Isend(send_[side].data(), static_cast<int>(values(*outgoing[side])), MPI_DOUBLE,
              partner[side], side, at_.comm, &requests[n++]);
  }
  MPI_Waitall(n, requests, MPI_STATUSES_IGNORE);
  // Low before high, always: sums come out the same however the messages arrived.
  for (int side = 0; side < 2; ++side)
    if (partner[side] != MPI_PROC_NULL) unpack(*incoming[side], layout, receive_[side], combine);
}

}  // namespace hemomag::solver
