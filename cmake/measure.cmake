file(GLOB measure_sources CONFIGURE_DEPENDS src/measure/*.cpp)
add_library(swirl_measure STATIC ${measure_sources})
target_link_libraries(swirl_measure PUBLIC swirl_physics)
target_compile_options(swirl_measure PRIVATE -fno-exceptions)

# The kernel that looks after every event, once for each width of vector registers; chosen when the
# program runs.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(src/measure/cluster_rotation_avx2.cpp PROPERTIES
                              COMPILE_OPTIONS "-mavx2")
  set_source_files_properties(src/measure/cluster_rotation_avx512.cpp PROPERTIES
                              COMPILE_OPTIONS "-mavx512f;-mavx512dq;-mavx512vl")
endif()
