#include <mpi.h>

#include "lammps/host.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    hemomag::lammps::Host host({argv + 1, argv + argc}, MPI_COMM_WORLD);
    host.script();
  }
  MPI_Finalize();
}
