#include "solver/cell_sums.hpp"

#include <algorithm>
#include <map>

#include "solver/rendezvous.hpp"

namespace hemomag::solver {

void CellSums::rebuild(MPI_Comm comm, std::span<const int> cells, int width) {
  comm_ = comm;
  width_ = static_cast<std::size_t>(width);
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank_);

  // Tell the rank that keeps the books of a cell (id modulo ranks) that a part of it is here.
  const auto keeper = [&](int cell) { return static_cast<std::size_t>(cell % ranks); };
  std::vector<std::vector<int>> ask(static_cast<std::size_t>(ranks));
  for (const int cell : cells) ask[keeper(cell)].push_back(cell);
  const auto asked = exchange_by_rank(comm, ask);
  std::map<int, std::vector<int>> holders;
  for (std::size_t r = 0; r < asked.size(); ++r)
    for (const int cell : asked[r]) holders[cell].push_back(static_cast<int>(r));

  // The keeper answers every holder with pairs (cell, other holder).
  std::vector<std::vector<int>> answer(static_cast<std::size_t>(ranks));
  for (const auto& [cell, who] : holders)
    for (const int r : who)
      for (const int other : who)
        if (other != r)
          answer[static_cast<std::size_t>(r)].insert(answer[static_cast<std::size_t>(r)].end(),
                                                     {cell, other});
  const auto answered = exchange_by_rank(comm, answer);

  std::map<int, std::vector<std::size_t>> shared;
  mine_.assign(cells.size(), 1);
  for (const auto& part : answered)
    for (std::size_t k = 0; k + 1 < part.size(); k += 2) {
      const auto slot = static_cast<std::size_t>(
          std::lower_bound(cells.begin(), cells.end(), part[k]) - cells.begin());
      shared[part[k + 1]].push_back(slot);
      if (part[k + 1] < rank_) mine_[slot] = 0;
    }
  partners_.clear();
  for (auto& [rank, slots] : shared) {
    std::sort(slots.begin(), slots.end());
    const std::size_t n = slots.size() * width_;
    partners_.push_back({rank, std::move(slots), std::vector<double>(n), std::vector<double>(n)});
  }
  own_.resize(cells.size() * width_);
  requests_.resize(2 * partners_.size());
}

void CellSums::add_part(const Partner& partner, std::span<double> values) const {
  for (std::size_t k = 0; k < partner.slots.size(); ++k)
    for (std::size_t w = 0; w < width_; ++w)
      values[partner.slots[k] * width_ + w] += partner.receive[k * width_ + w];
}

void CellSums::reduce(std::span<double> values) {
  if (partners_.empty()) return;
  constexpr int tag = 7101;
  std::size_t n = 0;
  for (auto& p : partners_)
    MPI_Irecv(p.receive.data(), static_cast<int>(p.receive.size()), MPI_DOUBLE, p.rank, tag, comm_,
              &requests_[n++]);
  for (auto& p : partners_) {
    for (std::size_t k = 0; k < p.slots.size(); ++k)
      std::copy_n(&values[p.slots[k] * width_], width_, &p.send[k * width_]);
    MPI_Isend(p.send.data(), static_cast<int>(p.send.size()), MPI_DOUBLE, p.rank, tag, comm_,
              &requests_[n++]);
  }
  std::copy(values.begin(), values.end(), own_.begin());
  std::fill(values.begin(), values.end(), 0.0);
  MPI_Waitall(static_cast<int>(n), requests_.data(), MPI_STATUSES_IGNORE);
  bool own_added = false;
  const auto add_own = [&] {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += own_[k];
    own_added = true;
  };
  for (const auto& p : partners_) {
    if (!own_added && p.rank > rank_) add_own();
    add_part(p, values);
  }
  if (!own_added) add_own();
}

}  // namespace hemomag::solver
