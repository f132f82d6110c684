# The files that `cmake --install` writes, relative to the prefix: the library with its headers and the
# files for find_package(swirl), and the program with its figure scripts and documents. Each is a
# component (`--component library`, `program`), and a Debian package (packaging/debian.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME library)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/swirl)
set_target_properties(swirl_engine PROPERTIES EXPORT_NAME engine)
set_target_properties(swirl_measure PROPERTIES EXPORT_NAME measure)
set_target_properties(swirl_physics PROPERTIES EXPORT_NAME physics)
set_target_properties(swirl_statistics PROPERTIES EXPORT_NAME statistics)
install(TARGETS swirl_physics swirl_engine swirl_statistics swirl_measure EXPORT swirl)
install(EXPORT swirl NAMESPACE swirl:: FILE swirlConfig.cmake DESTINATION ${package_folder})
write_basic_package_version_file(swirlConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/swirlConfigVersion.cmake DESTINATION ${package_folder})
# The public headers (docs/reference/cpp.md) have the names that they have in the source tree. All others are
# below swirl/detail, the second include folder, where the public ones find them.
set(public_headers
  swirl/physics/contact_law.hpp swirl/physics/container_path.hpp swirl/physics/event.hpp
  swirl/physics/initial_state.hpp swirl/physics/snapshot.hpp swirl/engine/own_law.hpp swirl/engine/paper_scene.hpp
  swirl/engine/placement.hpp swirl/engine/simulation.hpp swirl/engine/validate.hpp
  swirl/statistics/block_average.hpp swirl/measure/cluster_rotation.hpp swirl/measure/measurement_list.hpp)
foreach(layer math physics engine statistics measure)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/src src/swirl/${layer}/*.hpp)
  foreach(header ${headers})
    get_filename_component(folder ${header} DIRECTORY)
    if(NOT header IN_LIST public_headers)
      set(folder swirl/detail/${folder})
    endif()
    install(FILES src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
  endforeach()
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libswirl-dev RENAME copyright)

if(NOT SWIRL_PROGRAM)
  return()
endif()
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
# `swirl` finds the commands there (src/swirl/run/programs.hpp).
install(TARGETS swirl)
install(TARGETS swirl-commands RUNTIME DESTINATION libexec/swirl)
install(DIRECTORY paper DESTINATION ${CMAKE_INSTALL_DATADIR}/swirl FILES_MATCHING
  PATTERN *.py PATTERN *.j2 PATTERN tests EXCLUDE)
if(has_documents)
  install(FILES ${compressed_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${documents_folder}/swirl.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME swirl)
  install(FILES ${documents_folder}/_swirl DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES ${documents_folder}/swirl.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
  PATTERN conf.py EXCLUDE PATTERN site.css EXCLUDE)
if(SKBUILD)
  # Component of the Python wheel: the module, the program with its figure scripts, and the library of both.
  set_target_properties(swirl_python PROPERTIES INSTALL_RPATH $ORIGIN)
  set_target_properties(swirl-commands PROPERTIES INSTALL_RPATH $ORIGIN/../../..)
  install(TARGETS swirl_python swirl_shared LIBRARY DESTINATION swirl COMPONENT wheel)
  install(TARGETS swirl RUNTIME DESTINATION swirl/_program/bin COMPONENT wheel)
  install(TARGETS swirl-commands RUNTIME DESTINATION swirl/_program/libexec/swirl COMPONENT wheel)
  install(DIRECTORY paper DESTINATION swirl/_program/share/swirl COMPONENT wheel
          FILES_MATCHING PATTERN *.py PATTERN *.j2 PATTERN tests EXCLUDE)
elseif(TARGET swirl_python)
  # `cmake --install BUILD --component python` installs the module for the system's Python.
  install(TARGETS swirl_python LIBRARY DESTINATION lib/python3/dist-packages/swirl
          COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY bindings/python/swirl DESTINATION lib/python3/dist-packages
          COMPONENT python EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(packaging/debian.cmake)
