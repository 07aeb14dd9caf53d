#include "lammps/host.hpp"

#include <exception>

#include "input.h"
#include "lammps.h"
#include "lammps/style_table.hpp"

namespace hemomag::lammps {

Host::Host(std::vector<std::string> arguments, MPI_Comm comm) : arguments_(std::move(arguments)) {
  arguments_.insert(arguments_.begin(), "hemomag");
  std::vector<char*> argv;
  for (auto& a : arguments_) argv.push_back(a.data());
  argv.push_back(nullptr);
  lmp_ =
      std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(arguments_.size()), argv.data(), comm);
  register_styles(*lmp_);
}

Host::~Host() = default;

/// LAMMPS was built with exceptions, whose type its package does not ship.
template <class Work> void Host::guarded(Work work) {
  try {
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    std::string message = e.what();
    while (!message.empty() && message.back() == '\n') message.pop_back();
    throw Error(message);
  }
}

void Host::command(const std::string& line) {
  guarded([&] { lmp_->input->one(line); });
}

void Host::script(const std::string& path) {
  guarded([&] {
    if (path.empty())
      lmp_->input->file();
    else
      lmp_->input->file(path.c_str());
  });
}

}  // namespace hemomag::lammps
