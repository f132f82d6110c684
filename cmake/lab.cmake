find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
find_package(CLI11 REQUIRED)

file(GLOB lab_sources CONFIGURE_DEPENDS src/lab/*.cpp)
add_library(swirl_lab STATIC ${lab_sources})
target_link_libraries(swirl_lab PUBLIC swirl_measure swirl_simulation
  fmt::fmt nlohmann_json::nlohmann_json Threads::Threads)
foreach(floor files draw)
  if(TARGET swirl_${floor})
    target_link_libraries(swirl_lab PUBLIC swirl_${floor})
  endif()
endforeach()

# What goes into every result: the version (version.inc) and what built it.
add_dependencies(swirl_lab swirl_version_stamp)
target_include_directories(swirl_lab PRIVATE ${CMAKE_BINARY_DIR}/generated)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set_source_files_properties(src/lab/version.cpp PROPERTIES COMPILE_DEFINITIONS
  "SWIRL_BUILD=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off\"")

# The command line: one file per subcommand. CLI11 is slow to compile; each file pays for itself
# only.
file(GLOB app_sources CONFIGURE_DEPENDS src/app/*.cpp)
add_executable(swirl ${app_sources})
target_link_libraries(swirl PRIVATE swirl_lab CLI11::CLI11)
