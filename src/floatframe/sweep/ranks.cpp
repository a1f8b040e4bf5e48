#include "floatframe/sweep/ranks.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "floatframe/core/library_path.hpp"

namespace floatframe {
namespace {

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

}  // namespace

// The variable of OpenMPI, and those of launchers that start OpenMPI programs directly (Slurm).
bool started_on_ranks() {
  return number_in("OMPI_COMM_WORLD_SIZE") > 1 ||
         (std::getenv("PMIX_RANK") && number_in("SLURM_NTASKS") > 1);
}

int ranks_on_this_machine() { return std::max(1, number_in("OMPI_COMM_WORLD_LOCAL_SIZE")); }

std::unique_ptr<Ranks> open_ranks() {
  const std::string module = module_path("libfloatframe_mpi.so");
  if (module.empty()) {
    throw std::runtime_error(
        "started by mpirun, but this Floatframe was built without MPI (libfloatframe_mpi.so): "
        "install the packages libopenmpi-dev and openmpi-bin and build again");
  }
  // RTLD_GLOBAL: OpenMPI loads plugins that need its symbols.
  void* handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!handle) {
    const char* why = ::dlerror();
    throw std::runtime_error(std::string("the MPI module cannot be loaded: ") +
                             (why ? why : "no reason given"));
  }
  const auto open = reinterpret_cast<OpenRanksFunction>(::dlsym(handle, open_ranks_symbol));
  if (!open) throw std::runtime_error("'" + module + "' is not the MPI module");
  return std::unique_ptr<Ranks>(open());
}

}  // namespace floatframe
