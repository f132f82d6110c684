# One library per layer; a layer uses only the layers below it (tests/layers).
find_package(PkgConfig)
if(PkgConfig_FOUND)
  pkg_check_modules(cairo IMPORTED_TARGET cairo)
endif()
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(Threads REQUIRED)
find_package(CLI11 REQUIRED)
# Debian has HDF5's serial build in a separate folder.
find_path(hdf5_include hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_library hdf5 PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_hl_library hdf5_hl PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(hdf5_static libhdf5.a PATH_SUFFIXES hdf5/serial)
find_library(hdf5_hl_static libhdf5_hl.a PATH_SUFFIXES hdf5/serial)
find_library(szip_library sz)
set(hdf5_libraries ${hdf5_hl_library} ${hdf5_library})
if(hdf5_library MATCHES "\\.a$")  # that of a wheel
  find_package(ZLIB REQUIRED)
  list(APPEND hdf5_libraries ZLIB::ZLIB ${CMAKE_DL_LIBS} m)
elseif(hdf5_static AND hdf5_hl_static AND szip_library)
  # Debian's shared HDF5 can read files from Amazon S3. So it loads 35 libraries for TLS, LDAP and Kerberos, which take
  # half of the time of a short call. A program that is linked to the static one of Debian 12 does not contain that
  # part; the one of Debian 13 needs these libraries, too, so the shared one is used there. The Python module is a
  # shared object, for which the static library is not compiled.
  find_package(ZLIB REQUIRED)
  set(static ${hdf5_hl_static} ${hdf5_static} ${szip_library} ZLIB::ZLIB ${CMAKE_DL_LIBS} m)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${hdf5_include})
  set(CMAKE_REQUIRED_LIBRARIES ${static})
  check_cxx_source_compiles("#include <hdf5.h>
    int main() { return H5Fcreate(\"file\", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT) < 0; }"
    hdf5_static_needs_no_network)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(hdf5_static_needs_no_network)
    set(hdf5_libraries
      "$<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,${static},${hdf5_libraries}>")
  endif()
endif()

# Layers above the engine are optimised less, to compile faster: -O2 for the work at every frame, -O1
# for the rest. The level does not change results.
function(swirl_settings target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

function(swirl_part target folder level)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  add_library(${target} STATIC ${sources})
  target_link_libraries(${target} ${ARGN})
  swirl_compiled_at_once(${target})
  swirl_settings(${target} ${level})
endfunction()
# The headers of track/ are "track/video/lens.hpp", so their include root is the repository.
function(swirl_track_part part level)
  swirl_part(swirl_track_${part} track/${part} ${level} ${ARGN})
  target_include_directories(swirl_track_${part} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()
function(swirl_layer layer level)
  swirl_part(swirl_${layer} src/swirl/${layer} ${level} ${ARGN})
endfunction()

swirl_layer(io -O2
  PUBLIC swirl_measure swirl_engine nlohmann_json::nlohmann_json fmt::fmt
  PRIVATE tomlplusplus::tomlplusplus ${hdf5_libraries})
target_include_directories(swirl_io SYSTEM PRIVATE ${hdf5_include})
# Classes have members of types in unnamed namespaces. In a batch, g++ warns about them.
target_compile_options(swirl_io PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
swirl_layer(run -O1 PUBLIC swirl_io)
swirl_layer(study -O1 PUBLIC swirl_run Threads::Threads)
# Without this part, `swirl sweep`, `collect`, `map` and `crossing` are listed in the help, and report what is missing.
option(SWIRL_STUDY "Build the subcommands that make many runs" ON)
if(NOT SWIRL_STUDY)  # `swirl experiment` and the Python module may still need it
  set_target_properties(swirl_study PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
# The program in the build tree finds the scripts as an installed program does.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/swirl)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/paper ${PROJECT_BINARY_DIR}/share/swirl/paper SYMBOLIC)
# Tracking (track/). Only track/video needs OpenCV; without it (section [camera] of `packages`), `swirl track`
# reports what is missing.
# Without this part, `swirl image`, `movie` and `synthetic-video` are listed in the help, and report what is missing.
option(SWIRL_DRAWING "Build the subcommands that draw, if cairo is found" ON)
if(NOT cairo_FOUND)
  message(STATUS "cairo was not found: this build has no image, movie and synthetic-video")
  set(SWIRL_DRAWING OFF)
endif()
if(SWIRL_DRAWING)
  swirl_layer(render -O2 PUBLIC swirl_run PkgConfig::cairo)
  swirl_track_part(synthetic -O2 PUBLIC swirl_render)
endif()
# Without this part, `swirl experiment` is listed in the help, and reports what is missing.
option(SWIRL_EXPERIMENT "Build `swirl experiment`" ON)
if(SWIRL_EXPERIMENT)
  swirl_track_part(experiment -O1 PUBLIC swirl_study)
endif()
cmake_dependent_option(SWIRL_CAMERA "Build `swirl track` if OpenCV is found" ON
                       "SWIRL_EXPERIMENT;SWIRL_DRAWING" OFF)
# Debian's package with the CMake files of OpenCV depends on all of OpenCV, so they are not used.
find_path(opencv_include opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
find_library(opencv_core_library opencv_core)
find_library(opencv_imgproc_library opencv_imgproc)
if(NOT (opencv_include AND opencv_core_library AND opencv_imgproc_library))
  message(STATUS "OpenCV was not found: this build has no track")
  set(SWIRL_CAMERA OFF)
endif()
if(SWIRL_CAMERA)
  swirl_track_part(video -O3 PUBLIC swirl_track_synthetic Threads::Threads
    PRIVATE ${opencv_imgproc_library} ${opencv_core_library})
  target_include_directories(swirl_track_video SYSTEM PUBLIC ${opencv_include})
endif()

# The module and the program of a wheel share one copy of the layers that both need. It is the first library that
# they are linked with, so the static ones add nothing. HDF5 is not exported: another module may contain another one.
set(shared_layers)
if(SKBUILD)
  set(shared_layers swirl_shared)
  set(layers engine statistics measure io run study)
  list(TRANSFORM layers REPLACE "(.+)" "$<TARGET_OBJECTS:swirl_\\1>" OUTPUT_VARIABLE objects)
  add_library(swirl_shared SHARED ${objects})
  target_link_libraries(swirl_shared PRIVATE swirl_study)
  set(exported_symbols ${PROJECT_SOURCE_DIR}/packaging/wheels/exported_symbols)
  target_link_options(swirl_shared PRIVATE -Wl,--exclude-libs,ALL -Wl,-Bsymbolic -Wl,--gc-sections
    -Wl,--version-script=${exported_symbols})
  set_target_properties(swirl_shared PROPERTIES OUTPUT_NAME swirl LINK_DEPENDS ${exported_symbols})
endif()

# Every result contains the version (version.inc), the compiler and its flags.
add_dependencies(swirl_run swirl_version_stamp)
target_include_directories(swirl_run PRIVATE ${PROJECT_BINARY_DIR}/generated)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set_source_files_properties(src/swirl/run/version.cpp PROPERTIES COMPILE_DEFINITIONS
  "SWIRL_BUILD=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off\"")

# The command line: one file per subcommand.
file(GLOB app_sources CONFIGURE_DEPENDS src/swirl/cli/*.cpp track/cli/*.cpp)
# The commands of a part are a library, so that adding the part later compiles nothing else of the command line again.
function(swirl_commands part option library files)
  set(sources ${app_sources})
  list(FILTER sources INCLUDE REGEX "/(${files}).cpp$")
  list(REMOVE_ITEM app_sources ${sources})
  add_library(swirl_${part}_commands OBJECT ${sources})
  target_link_libraries(swirl_${part}_commands PRIVATE swirl_run)
  target_include_directories(swirl_${part}_commands PRIVATE ${PROJECT_SOURCE_DIR})
  swirl_settings(swirl_${part}_commands -O1)
  swirl_compiled_at_once(swirl_${part}_commands)
  if(${option})
    target_link_libraries(swirl_${part}_commands PUBLIC ${library})
    target_compile_definitions(swirl_${part}_commands PRIVATE ${option}=1)
  endif()
  set(app_sources ${app_sources} PARENT_SCOPE)
  set(${part}_sources ${sources} PARENT_SCOPE)
endfunction()
swirl_commands(study SWIRL_STUDY swirl_study "command_(crossing|dish|map|sweep)")
swirl_commands(drawing SWIRL_DRAWING swirl_track_synthetic
  "appearance_options|source_options|command_(image|movie|synthetic_video)")
swirl_commands(experiment SWIRL_EXPERIMENT swirl_track_experiment "command_experiment")
add_executable(swirl ${app_sources})
target_include_directories(swirl PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(swirl PRIVATE ${shared_layers} swirl_run swirl_study_commands swirl_drawing_commands
  swirl_experiment_commands CLI11::CLI11)
if(SWIRL_CAMERA)
  foreach(target swirl swirl_experiment_commands)
    target_link_libraries(${target} PRIVATE swirl_track_video)
    target_compile_definitions(${target} PRIVATE SWIRL_CAMERA=1)
  endforeach()
endif()
swirl_settings(swirl -O1)
swirl_compiled_at_once(swirl)
