# The event loop is compiled once for each vector width, and the widest that the processor has is
# chosen at run time; so is the plain loop's scan. These files get wider instructions; everything
# else is baseline x86-64.
file(GLOB simulation_sources CONFIGURE_DEPENDS src/simulation/*.cpp)
list(FILTER simulation_sources EXCLUDE REGEX "_avx(2|512)\\.cpp$")
add_library(swirl_simulation STATIC ${simulation_sources})
target_link_libraries(swirl_simulation PUBLIC swirl_physics)
target_compile_options(swirl_simulation PRIVATE -fno-exceptions)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_sources(swirl_simulation PRIVATE
    src/simulation/event_loop_avx2.cpp src/simulation/event_loop_avx512.cpp
    src/simulation/reference_scan_avx2.cpp src/simulation/reference_scan_avx512.cpp)
  set_source_files_properties(src/simulation/event_loop_avx2.cpp
    src/simulation/reference_scan_avx2.cpp PROPERTIES
    COMPILE_OPTIONS "-mavx2")
  # g++ 12 warns about its own intrinsics there.
  set_source_files_properties(src/simulation/event_loop_avx512.cpp
    src/simulation/reference_scan_avx512.cpp PROPERTIES
    COMPILE_OPTIONS "-mavx512f;-mavx512vl;-mavx512dq;-mavx512bw;-mprefer-vector-width=512;$<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>")
  # The same text three times; undefined behaviour is looked for once, as that takes the compiler a
  # minute and more.
  if(SWIRL_SANITIZE)
    set_property(SOURCE src/simulation/event_loop_avx2.cpp src/simulation/event_loop_avx512.cpp
      APPEND PROPERTY COMPILE_OPTIONS "-fno-sanitize=undefined")
  endif()
endif()
