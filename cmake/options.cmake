# Compiler flags for everything we ship. No -ffast-math, no -march=native, no fused multiply-add:
# the same bits on every machine (docs/determinism.md). -fno-math-errno and -fno-trapping-math
# change no value; they let the compiler use the square-root instruction and masked vectors.
add_library(swirl_options INTERFACE)
target_compile_options(swirl_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi -Werror
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(SWIRL_SANITIZE)
  target_compile_options(swirl_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(swirl_options INTERFACE -fsanitize=address,undefined)
endif()
if(SWIRL_INTERNAL_CHECKS)
  target_compile_definitions(swirl_options INTERFACE SWIRL_INTERNAL_CHECKS=1)
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
find_program(ccache_program ccache)
if(ccache_program)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache_program})
endif()
