#pragma once

namespace hemomag::lammps {

/// While one exists, SIGTERM, SIGINT and SIGUSR1 are noted and not obeyed, but for a second SIGINT;
/// after it they do what they did before.
class SignalsNoted {
public:
  SignalsNoted();
  ~SignalsNoted();
  SignalsNoted(const SignalsNoted&) = delete;
  SignalsNoted& operator=(const SignalsNoted&) = delete;

  /// Bits of what has come to this process.
  enum Bits { terminate = 1, interrupt = 2, save = 4 };
  int seen() const;
  /// Forget a request to save, which may come again.
  void served();
};

/// Signal that stopped this process's run after a checkpoint, or 0.
int& stopped_by();

}  // namespace hemomag::lammps
