# The engine and its measurements: math, physics, engine, statistics, measure. They use the standard
# library only, and no exceptions.
#
# A program that links to them compiles the functions in our headers. Multiplications and additions
# must not be fused there either, or results would differ in the last bits from ours.
add_library(swirl_physics INTERFACE)
target_compile_features(swirl_physics INTERFACE cxx_std_20)
target_compile_options(swirl_physics INTERFACE -ffp-contract=off)
target_include_directories(swirl_physics INTERFACE
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>
  $<INSTALL_INTERFACE:include/swirl/detail>)

# The undefined-behaviour sanitizer checks the baseline loop only: the other loops are the same source, and
# with this sanitizer each takes up to a minute more to compile.
set(once $<$<BOOL:${SWIRL_SANITIZE}>:-fno-sanitize=undefined>)
set_source_files_properties(src/swirl/engine/simd/event_loop_partial_friction.cpp PROPERTIES
  COMPILE_OPTIONS "${once}")

# The event loop and the averages by event are compiled once for each vector width; the program picks
# the widest that the processor has. swirl_vector_sources(VARIABLE) gives NAME_avx2.cpp and
# NAME_avx512.cpp in that list their instruction sets, and drops them on other architectures.
# All other files are compiled for baseline x86-64.
function(swirl_vector_sources variable)
  set(sources ${${variable}})
  set(avx2_sources ${sources})
  set(avx512_sources ${sources})
  list(FILTER avx2_sources INCLUDE REGEX "_avx2\\.cpp$")
  list(FILTER avx512_sources INCLUDE REGEX "_avx512\\.cpp$")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND SWIRL_WIDE_VECTORS)
    set_source_files_properties(${avx2_sources} PROPERTIES COMPILE_OPTIONS "-mavx2;${once}")
    # g++ 12 warns about its own intrinsics there.
    set_source_files_properties(${avx512_sources} PROPERTIES COMPILE_OPTIONS
      "-mavx512f;-mavx512vl;-mavx512dq;-mavx512bw;-mprefer-vector-width=512;$<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>;${once}")
    set_source_files_properties(${avx2_sources} ${avx512_sources} PROPERTIES
      SKIP_UNITY_BUILD_INCLUSION ON)
    list(FILTER sources EXCLUDE REGEX "_${omitted_width}\\.cpp$")
    if(omitted_width MATCHES "^avx[0-9]+$")
      # This processor runs the widest loop. The baseline is there for others that use the same folder.
      set_source_files_properties(src/swirl/engine/simd/event_loop_baseline.cpp PROPERTIES
        COMPILE_OPTIONS "-O1;-DSWIRL_FALLBACK=1")
    endif()
  else()
    list(FILTER sources EXCLUDE REGEX "_avx(2|512)\\.cpp$")
  endif()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE engine_sources CONFIGURE_DEPENDS src/swirl/engine/*.cpp)
file(GLOB_RECURSE statistics_sources CONFIGURE_DEPENDS src/swirl/statistics/*.cpp)
file(GLOB_RECURSE measure_sources CONFIGURE_DEPENDS src/swirl/measure/*.cpp)
swirl_vector_sources(engine_sources)
swirl_vector_sources(measure_sources)
set_source_files_properties(src/swirl/engine/simd/event_loop_baseline.cpp
  src/swirl/engine/simd/event_loop_partial_friction.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

add_library(swirl_engine STATIC ${engine_sources})
target_link_libraries(swirl_engine PUBLIC swirl_physics)
target_compile_options(swirl_engine PRIVATE -fno-exceptions)
swirl_compiled_at_once(swirl_engine)
if(SWIRL_FUZZ)
  # The fuzz targets test the readers of files. The engine has a separate suite with sanitizers; here they
  # would add minutes of compilation for each event loop.
  target_compile_options(swirl_engine PRIVATE -fno-sanitize=all)
endif()
foreach(layer statistics measure)
  add_library(swirl_${layer} STATIC ${${layer}_sources})
  target_compile_options(swirl_${layer} PRIVATE -fno-exceptions)
endforeach()
swirl_compiled_at_once(swirl_statistics)
target_link_libraries(swirl_statistics PUBLIC swirl_physics)
target_link_libraries(swirl_measure PUBLIC swirl_statistics)
swirl_compiled_at_once(swirl_measure)
# These names are valid for the installed package and for add_subdirectory.
add_library(swirl::engine ALIAS swirl_engine)
add_library(swirl::statistics ALIAS swirl_statistics)
add_library(swirl::measure ALIAS swirl_measure)
