#include "lammps/host.hpp"

#include "comm.h"
#include "input.h"
#include "lammps.h"
#include "lammps/ending.hpp"
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

Host::~Host() { kept_log() = nullptr; }  // LAMMPS closes it

std::array<int, 3> Host::rank_grid() const {
  const int* grid = lmp_->comm->procgrid;
  return {grid[0], grid[1], grid[2]};
}

void Host::keep_log() { kept_log() = lmp_->logfile = std::tmpfile(); }

void Host::command(const std::string& line) { lmp_->input->one(line); }

void Host::script(const std::string& path) {
  if (path.empty())
    lmp_->input->file();
  else
    lmp_->input->file(path.c_str());
}

}  // namespace hemomag::lammps
