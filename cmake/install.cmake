# What `cmake --install` writes, all of it relative to the prefix: the library with its headers and
# the files for find_package(swirl), and the program with the scripts that draw and its documents.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/swirl)
set_target_properties(swirl_engine PROPERTIES EXPORT_NAME engine)
set_target_properties(swirl_measure PROPERTIES EXPORT_NAME measure)
set_target_properties(swirl_physics PROPERTIES EXPORT_NAME physics)
set_target_properties(swirl_statistics PROPERTIES EXPORT_NAME statistics)
install(TARGETS swirl_physics swirl_engine swirl_statistics swirl_measure EXPORT swirl)
install(EXPORT swirl NAMESPACE swirl:: FILE swirlConfig.cmake DESTINATION ${package_folder})
write_basic_package_version_file(swirlConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/swirlConfigVersion.cmake DESTINATION ${package_folder})
foreach(layer math physics engine statistics measure)
  install(DIRECTORY src/swirl/${layer} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swirl
          FILES_MATCHING PATTERN *.hpp)
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

if(NOT SWIRL_PROGRAM)
  return()
endif()
install(TARGETS swirl)
install(DIRECTORY figures DESTINATION ${CMAKE_INSTALL_DATADIR}/swirl FILES_MATCHING PATTERN *.py)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

# `cpack -G DEB` packs what is built. dpkg-shlibdeps finds the shared libraries that the program
# needs; the file `packages` names the rest.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS packages)
function(listed_packages section result)
  file(STRINGS packages lines)
  set(found "")
  set(here FALSE)
  foreach(line ${lines})
    if(line MATCHES "^\\[(.*)\\]$")
      string(COMPARE EQUAL "${CMAKE_MATCH_1}" ${section} here)
    elseif(here AND line MATCHES "^[a-z]")
      list(APPEND found ${line})
    endif()
  endforeach()
  list(JOIN found ", " found)
  set(${result} ${found} PARENT_SCOPE)
endfunction()
listed_packages(figures CPACK_DEBIAN_PACKAGE_DEPENDS)
listed_packages(movies CPACK_DEBIAN_PACKAGE_RECOMMENDS)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The swirl authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The Python module is a package of its own, python3-swirl:
#
#     cmake --build build/release --target swirl_python && cd build/release &&
#         cpack -G DEB -D CPACK_DEB_COMPONENT_INSTALL=ON -D CPACK_COMPONENTS_ALL=python
#
# `cmake --install --component python` installs it; nothing else does.
if(TARGET swirl_python)
  install(TARGETS swirl_python LIBRARY DESTINATION lib/python3/dist-packages/swirl
          COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY bindings/python/swirl DESTINATION lib/python3/dist-packages
          COMPONENT python EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-swirl)
  set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "import swirl: simulations, measurements and sweeps as numpy has them.")
endif()
set(CPACK_PACKAGE_DESCRIPTION
  "Discs in a swirled dish, simulated event by event; measurements, figures, movies, and a library.")
include(CPack)
