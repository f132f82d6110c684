# One library per floor of the house; the arrows go down only (docs/design.md, tests/floors).
find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(Threads REQUIRED)
find_package(CLI11 REQUIRED)
# Debian keeps HDF5's serial build in a folder of its own.
find_path(hdf5_include hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_library hdf5 PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_hl_library hdf5_hl PATH_SUFFIXES hdf5/serial REQUIRED)

include(cmake/engine.cmake)

function(swirl_floor floor)
  file(GLOB sources CONFIGURE_DEPENDS src/${floor}/*.cpp)
  add_library(swirl_${floor} STATIC ${sources})
  target_link_libraries(swirl_${floor} ${ARGN})
endfunction()

swirl_floor(files
  PUBLIC swirl_measure swirl_simulation nlohmann_json::nlohmann_json
  PRIVATE fmt::fmt tomlplusplus::tomlplusplus ${hdf5_library} ${hdf5_hl_library})
target_include_directories(swirl_files SYSTEM PRIVATE ${hdf5_include})
swirl_floor(draw PUBLIC swirl_measure PkgConfig::cairo)
swirl_floor(run PUBLIC swirl_files fmt::fmt)
swirl_floor(study PUBLIC swirl_run swirl_rival Threads::Threads)
swirl_floor(film PUBLIC swirl_run swirl_draw)
swirl_floor(paper PUBLIC swirl_study swirl_film)

# What goes into every result: the version (version.inc) and what built it.
add_dependencies(swirl_run swirl_version_stamp)
target_include_directories(swirl_run PRIVATE ${CMAKE_BINARY_DIR}/generated)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set_source_files_properties(src/run/version.cpp PROPERTIES COMPILE_DEFINITIONS
  "SWIRL_BUILD=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off\"")

# The command line: one file per subcommand. CLI11 is slow to compile; each file pays for itself
# only.
file(GLOB app_sources CONFIGURE_DEPENDS src/app/*.cpp)
add_executable(swirl ${app_sources})
target_link_libraries(swirl PRIVATE swirl_paper CLI11::CLI11)
