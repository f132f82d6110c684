file(GLOB simulation_sources CONFIGURE_DEPENDS src/simulation/*.cpp)
add_library(swirl_simulation STATIC ${simulation_sources})
target_link_libraries(swirl_simulation PUBLIC swirl_physics)
target_compile_options(swirl_simulation PRIVATE -fno-exceptions)
