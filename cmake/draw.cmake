find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
find_package(Threads REQUIRED)

file(GLOB draw_sources CONFIGURE_DEPENDS src/draw/*.cpp)
add_library(swirl_draw STATIC ${draw_sources})
target_link_libraries(swirl_draw PUBLIC swirl_measure PkgConfig::cairo)
