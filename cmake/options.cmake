# Compiler flags for everything in this tree; programs that link to it do not get them. There is no
# -ffast-math and no -march=native, so that results are bitwise identical on all machines
# (docs/explanation/determinism.md). -fno-math-errno and -fno-trapping-math change no value; they let the
# compiler use the square-root instruction and masked vectors. Our headers need one flag wherever they
# are compiled, -ffp-contract=off; it belongs to the targets (engine.cmake).
add_compile_options(
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  -fno-math-errno -fno-trapping-math)
# The Python module is a shared object made of the same libraries. Hidden functions are called directly,
# as in a program, so these flags do not slow the event loop down (docs/tutorials/python.md).
if(SWIRL_PROGRAM)
  set(visibility -fvisibility=hidden)
  if(SKBUILD)
    # A wheel has these libraries once, in a shared object of the program and the module.
    set(visibility -fno-semantic-interposition)
  endif()
  add_compile_options(-fPIC "$<$<COMPILE_LANGUAGE:CXX>:${visibility};-fvisibility-inlines-hidden>")
endif()
if(SWIRL_WERROR)
  add_compile_options(-Werror)
  # These warnings depend on what the optimiser inlines. Newer versions of g++ report some that are false.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    foreach(warning array-bounds free-nonheap-object maybe-uninitialized stringop-overflow)
      add_compile_options(-Wno-error=${warning})
    endforeach()
  endif()
endif()
if(SWIRL_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
# Of the wide vectors, this processor needs the widest that it has. A processor without them runs the baseline.
set(omitted_width none)
if(SWIRL_ONLY_WIDEST AND EXISTS /proc/cpuinfo)
  file(READ /proc/cpuinfo processor)
  set(omitted_width "avx(2|512)")
  if(processor MATCHES " avx2 ")
    set(omitted_width avx512)
  endif()
  if(processor MATCHES " avx512f " AND processor MATCHES " avx512dq " AND processor MATCHES " avx512bw "
     AND processor MATCHES " avx512vl ")
    set(omitted_width avx2)
  endif()
endif()
if(NOT SWIRL_WIDE_VECTORS OR omitted_width STREQUAL "avx(2|512)")
  add_compile_definitions(SWIRL_BASELINE_ONLY=1)
elseif(omitted_width STREQUAL avx2)
  add_compile_definitions(SWIRL_WITHOUT_AVX2=1)
elseif(omitted_width STREQUAL avx512)
  add_compile_definitions(SWIRL_WITHOUT_AVX512=1)
endif()
if(SWIRL_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(SWIRL_THREAD_SANITIZE)
  add_compile_options(-fsanitize=thread)
  add_link_options(-fsanitize=thread)
endif()
if(SWIRL_INTERNAL_CHECKS)
  add_compile_definitions(SWIRL_INTERNAL_CHECKS=1)
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
find_program(ccache_program ccache)
if(ccache_program)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache_program})
endif()

# The compiler gets several files of a layer at once, because headers and their templates are most of
# the work. So names in unnamed namespaces must be unique within a layer (tests/layers). Every batch
# reads the headers again. So the first ./swirl compiles each layer at once, in up to 1.3 GB of memory.
set(batch 16)
if(SWIRL_ONLY_WIDEST)
  set(batch 0)
endif()
function(swirl_compiled_at_once target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A local name may equal the name of a constant in another file of the batch. Files compiled alone have the same
    # warnings, so that every preset accepts the same code.
    target_compile_options(${target} PRIVATE -Wno-shadow -Wshadow=local)
    if(SWIRL_UNITY)
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    endif()
  endif()
endfunction()
