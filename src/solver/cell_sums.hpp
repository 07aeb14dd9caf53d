#pragma once
#include <span>
#include <vector>

#include <mpi.h>

namespace hemomag::solver {

/// Sums over whole cells whose parts lie on several ranks. Who shares which cell is found at
/// reneighbouring, by a rendezvous; in a step only the ranks that hold a part of the same cell
/// talk, and every one of them adds the parts in rank order, so that all get the same sum to the
/// last bit. Nothing is allocated in a step.
class CellSums {
public:
  /// @param cells  ids of the cells this rank holds a part of, ascending, each once. Collective.
  void rebuild(MPI_Comm comm, std::span<const int> cells, int width);

  /// values[cell][width]: this rank's parts in, sums over all ranks out.
  void reduce(std::span<double> values);

  /// True on exactly one of the ranks that share cell number `slot` of rebuild's list.
  bool mine(std::size_t slot) const { return mine_[slot]; }

private:
  struct Partner {
    int rank;
    std::vector<std::size_t> slots;  // shared cells, ascending id on both sides
    std::vector<double> send, receive;
  };
  void add_part(const Partner& partner, std::span<double> values) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  std::size_t width_ = 0;
  std::vector<Partner> partners_;  // ascending rank
  std::vector<char> mine_;
  std::vector<double> own_;
  std::vector<MPI_Request> requests_;
};

}  // namespace hemomag::solver
