# Third-party libraries, all from the distribution's packages (scripts/install_packages.sh).
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_path(FLOATFRAME_SPECTRA_INCLUDE Spectra/SymGEigsShiftSolver.h REQUIRED)
find_path(FLOATFRAME_METIS_INCLUDE metis.h REQUIRED)
find_library(FLOATFRAME_METIS_LIBRARY metis REQUIRED)

# yaml-cpp calls its target `yaml-cpp` up to 0.7 (Debian 12) and `yaml-cpp::yaml-cpp` from 0.8 (Ubuntu 24.04).
find_package(yaml-cpp REQUIRED)
add_library(floatframe_yaml INTERFACE)
if(TARGET yaml-cpp::yaml-cpp)
  target_link_libraries(floatframe_yaml INTERFACE yaml-cpp::yaml-cpp)
else()
  target_link_libraries(floatframe_yaml INTERFACE yaml-cpp)
endif()


# What the library and the tests use inside, never in an installed header. CLI11 is for the command line alone.
add_library(floatframe_private_dependencies INTERFACE)
target_link_libraries(floatframe_private_dependencies INTERFACE
  floatframe_yaml fmt::fmt nlohmann_json::nlohmann_json ZLIB::ZLIB ${FLOATFRAME_METIS_LIBRARY})
target_include_directories(floatframe_private_dependencies SYSTEM INTERFACE
  ${FLOATFRAME_SPECTRA_INCLUDE} ${FLOATFRAME_METIS_INCLUDE})

# MPI is for the module that `floatframe sweep` loads under mpirun; nothing else is linked against it.
if(FLOATFRAME_MPI)
  set(MPI_CXX_SKIP_MPICXX ON)  # the C interface is used
  find_package(MPI COMPONENTS CXX)
  if(NOT MPI_CXX_FOUND)
    message(STATUS "MPI was not found: `floatframe sweep` will not run on several processes")
  endif()
endif()

# MUMPS (sequential, CeCILL-C) factors large sparse matrices; in a module of its own, too, whose symbols nobody else
# sees. Without it Eigen does.
if(FLOATFRAME_MUMPS)
  find_path(FLOATFRAME_MUMPS_INCLUDE dmumps_c.h)
  find_library(FLOATFRAME_MUMPS_LIBRARY dmumps_seq)
  if(NOT FLOATFRAME_MUMPS_INCLUDE OR NOT FLOATFRAME_MUMPS_LIBRARY)
    message(STATUS "MUMPS was not found: large finite-element parts will be reduced with Eigen, which takes longer")
  endif()
endif()
