# Files: HDF5 through its C library. Debian keeps the serial build in a folder of its own.
find_path(hdf5_include hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_library hdf5 PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_hl_library hdf5_hl PATH_SUFFIXES hdf5/serial REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)

file(GLOB files_sources CONFIGURE_DEPENDS src/files/*.cpp)
add_library(swirl_files STATIC ${files_sources})
target_link_libraries(swirl_files
  PUBLIC swirl_measure swirl_simulation nlohmann_json::nlohmann_json
  PRIVATE fmt::fmt tomlplusplus::tomlplusplus ${hdf5_library} ${hdf5_hl_library})
target_include_directories(swirl_files SYSTEM PRIVATE ${hdf5_include})
