#include "lammps/signals.hpp"

#include <csignal>
#include <cstddef>

namespace hemomag::lammps {
namespace {

constexpr int numbers[3] = {SIGTERM, SIGINT, SIGUSR1};  // in the order of the bits
volatile std::sig_atomic_t came[3];
struct sigaction before[3];

extern "C" void note_signal(int signal) {
  if (signal == SIGINT && came[1]) {  // somebody who does not want to wait
    std::signal(SIGINT, SIG_DFL);
    raise(SIGINT);
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (numbers[k] == signal) came[k] = 1;
}

}  // namespace

SignalsNoted::SignalsNoted() {
  struct sigaction note = {};
  note.sa_handler = note_signal;
  note.sa_flags = SA_RESTART;
  sigemptyset(&note.sa_mask);
  for (std::size_t k = 0; k < 3; ++k) {
    came[k] = 0;
    sigaction(numbers[k], &note, &before[k]);
  }
}

SignalsNoted::~SignalsNoted() {
  for (std::size_t k = 0; k < 3; ++k) sigaction(numbers[k], &before[k], nullptr);
}

int SignalsNoted::seen() const {
  return (came[0] ? terminate : 0) | (came[1] ? interrupt : 0) | (came[2] ? save : 0);
}

void SignalsNoted::served() { came[2] = 0; }

int& stopped_by() {
  static int signal = 0;
  return signal;
}

}  // namespace hemomag::lammps
