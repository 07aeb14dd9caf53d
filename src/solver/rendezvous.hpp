#pragma once
#include <vector>

#include <mpi.h>

namespace hemomag::solver {

/// Send outgoing[r] to rank r and return what each rank sent here, in rank order. Collective: for
/// set-up and reneighbouring, not for every step.
template <class T>
std::vector<std::vector<T>> exchange_by_rank(MPI_Comm comm,
                                             const std::vector<std::vector<T>>& outgoing) {
  const auto ranks = outgoing.size();
  std::vector<int> send_count(ranks), send_at(ranks), receive_count(ranks), receive_at(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    send_count[r] = static_cast<int>(outgoing[r].size() * sizeof(T));
  MPI_Alltoall(send_count.data(), 1, MPI_INT, receive_count.data(), 1, MPI_INT, comm);
  int sent = 0, received = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    send_at[r] = sent;
    receive_at[r] = received;
    sent += send_count[r];
    received += receive_count[r];
  }
  std::vector<T> send, receive(static_cast<std::size_t>(received) / sizeof(T));
  send.reserve(static_cast<std::size_t>(sent) / sizeof(T));
  for (const auto& part : outgoing) send.insert(send.end(), part.begin(), part.end());
  MPI_Alltoallv(send.data(), send_count.data(), send_at.data(), MPI_BYTE, receive.data(),
                receive_count.data(), receive_at.data(), MPI_BYTE, comm);
  std::vector<std::vector<T>> incoming(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto first = receive.begin() + receive_at[r] / static_cast<int>(sizeof(T));
    incoming[r].assign(first, first + receive_count[r] / static_cast<int>(sizeof(T)));
  }
  return incoming;
}

}  // namespace hemomag::solver
