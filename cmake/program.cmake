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
# The program in the build tree finds the scripts as an installed program does.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/swirl)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/paper ${PROJECT_BINARY_DIR}/share/swirl/paper SYMBOLIC)
# Tracking (track/). Only track/video needs OpenCV (section [camera] of `packages`).
set(has_drawing ${cairo_FOUND})
if(has_drawing)
  swirl_layer(render -O2 PUBLIC swirl_run PkgConfig::cairo)
  swirl_track_part(synthetic -O2 PUBLIC swirl_render)
else()
  message(STATUS "cairo was not found: this build has no image, movie and synthetic-video")
endif()
swirl_track_part(experiment -O1 PUBLIC swirl_study)
# Debian's package with the CMake files of OpenCV depends on all of OpenCV, so they are not used.
option(SWIRL_CAMERA "Use OpenCV, if it is found, for `swirl track`" ON)
find_path(opencv_include opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
find_library(opencv_core_library opencv_core)
find_library(opencv_imgproc_library opencv_imgproc)
set(has_camera OFF)
if(NOT (opencv_include AND opencv_core_library AND opencv_imgproc_library))
  message(STATUS "OpenCV was not found: this build has no track")
elseif(SWIRL_CAMERA AND has_drawing)
  set(has_camera ON)
endif()
if(has_camera)
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

# The commands. Each is a program swirl-NAME, which links only the layers that it needs, and `swirl` runs it.
# The rows of this file describe them. A command whose library is missing has a target without a program,
# and `swirl NAME` reports the library.
set(command_list ${PROJECT_SOURCE_DIR}/src/swirl/cli/command_list.hpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${command_list})

# What commands share: all files except those of the commands, of the three libraries below, and those with a main().
file(GLOB cli_sources CONFIGURE_DEPENDS src/swirl/cli/*.cpp)
file(GLOB command_sources CONFIGURE_DEPENDS src/swirl/cli/command_*.cpp track/cli/command_*.cpp)
list(FILTER command_sources EXCLUDE REGEX "/command_line.cpp$")
set(study_sources src/swirl/cli/sweep_tables.cpp)
set(drawing_sources src/swirl/cli/appearance_options.cpp src/swirl/cli/source_options.cpp)
set(camera_sources track/cli/recorded_path.cpp track/cli/tracked_video.cpp)
list(FILTER cli_sources EXCLUDE REGEX
  "/(swirl|main|documents|sweep_tables|appearance_options|source_options).cpp$")
list(REMOVE_ITEM cli_sources ${command_sources})

# swirl_cli_library(NAME LINKED_LIBRARIES SOURCES...)
function(swirl_cli_library name libraries)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC ${libraries})
  swirl_settings(${name} -O1)
  swirl_compiled_at_once(${name})
endfunction()
swirl_cli_library(swirl_cli "swirl_run;CLI11::CLI11" ${cli_sources})
swirl_cli_library(swirl_cli_study "swirl_cli;swirl_study" ${study_sources})
if(has_drawing)
  swirl_cli_library(swirl_cli_drawing "swirl_cli;swirl_track_synthetic" ${drawing_sources})
endif()
if(has_camera)
  swirl_cli_library(swirl_cli_camera "swirl_cli_drawing;swirl_track_video" ${camera_sources})
endif()
add_library(swirl_cli_experiment INTERFACE)
target_link_libraries(swirl_cli_experiment INTERFACE swirl_cli swirl_track_experiment)

# main() of every command.
add_library(swirl_main OBJECT src/swirl/cli/main.cpp)
target_link_libraries(swirl_main PRIVATE swirl_cli)
swirl_settings(swirl_main -O1)

# `swirl` uses the standard library only.
add_executable(swirl src/swirl/cli/swirl.cpp src/swirl/run/version.cpp src/swirl/run/programs.cpp
  src/swirl/run/names.cpp src/swirl/io/short_values.cpp src/swirl/io/system_calls.cpp)
add_dependencies(swirl swirl_version_stamp)
target_include_directories(swirl PRIVATE src ${PROJECT_BINARY_DIR}/generated)
target_compile_definitions(swirl PRIVATE SWIRL_HAS_DRAWING=$<BOOL:${has_drawing}>
  SWIRL_HAS_CAMERA=$<BOOL:${has_camera}>)
swirl_settings(swirl -O1)
swirl_compiled_at_once(swirl)

set(command_programs)
set(documented_programs) # of those
set(command_objects)
set(command_libraries ${shared_layers})
file(STRINGS ${command_list} rows REGEX "^    {\"")
foreach(row ${rows})
  string(REGEX MATCH "{\"([^\"]*)\", \"([^\"]*)\", \"([^\"]*)\"" matched ${row})
  set(program swirl-${CMAKE_MATCH_1})
  string(REPLACE "-" "_" name ${CMAKE_MATCH_1})
  set(group ${CMAKE_MATCH_2})
  string(REPLACE " " ";" libraries "${CMAKE_MATCH_3}")
  if(libraries STREQUAL script)
    continue()
  endif()
  set(source ${command_sources})
  list(FILTER source INCLUDE REGEX "/command_${name}.cpp$")
  list(TRANSFORM libraries PREPEND swirl_cli_)
  set(missing ${libraries})
  foreach(library ${libraries})
    if(TARGET ${library})
      list(REMOVE_ITEM missing ${library})
    endif()
  endforeach()
  if(missing)
    add_custom_target(${program})
    continue()
  endif()
  add_library(swirl_command_${name} OBJECT ${source})
  target_link_libraries(swirl_command_${name} PRIVATE swirl_cli ${libraries})
  swirl_settings(swirl_command_${name} -O1)
  add_executable(${program} $<TARGET_OBJECTS:swirl_main> $<TARGET_OBJECTS:swirl_command_${name}>)
  target_link_libraries(${program} PRIVATE ${libraries} swirl_cli)
  list(APPEND command_programs ${program})
  if(NOT group STREQUAL hidden)
    list(APPEND documented_programs ${program})
  endif()
  list(APPEND command_objects $<TARGET_OBJECTS:swirl_command_${name}>)
  list(APPEND command_libraries ${libraries} swirl_cli)
endforeach()
# In packages, one program contains all commands, so that they contain the layers once.
add_executable(swirl-commands $<TARGET_OBJECTS:swirl_main> ${command_objects})
target_link_libraries(swirl-commands PRIVATE ${command_libraries})
if(SWIRL_TESTS)
  # The tests call every command through `swirl`.
  add_dependencies(swirl ${command_programs})
endif()
