# Debian packages: `cpack -G DEB` in the build folder writes `swirl` (the program) and `libswirl-dev` (the
# library). dpkg-shlibdeps finds the shared libraries; the file `packages` lists the other dependencies.
# The Python module is the package python3-swirl:
#
#     cmake --build build/release --target swirl_python
#     cd build/release && cpack -G DEB -D CPACK_COMPONENTS_ALL=python
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS packages)
# Writes the packages in the sections `sections` of the file `packages` to `result`, without those in
# the list `excluded`.
function(listed_packages sections excluded result)
  file(STRINGS packages lines)
  set(found "")
  set(section "")
  foreach(line ${lines})
    if(line MATCHES "^\\[(.*)\\]$")
      set(section ${CMAKE_MATCH_1})
    elseif(section IN_LIST sections AND line MATCHES "^[a-z]" AND NOT line IN_LIST excluded)
      list(APPEND found ${line})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES found)
  set(${result} ${found} PARENT_SCOPE)
endfunction()
listed_packages("images" "" needed)
# Packages may not name python3-minimal; those of python3-matplotlib bring it along.
listed_packages("figures;movies;paper" "${needed};python3-minimal" recommended)
list(APPEND recommended python3-swirl)
list(JOIN needed ", " CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS)
list(JOIN recommended ", " CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL library program)
# Debian requires an address; whoever publishes the packages replaces it with theirs.
set(SWIRL_CONTACT "The swirl authors <maintainers@swirl.invalid>" CACHE STRING "Contact of the Debian packages")
set(CPACK_PACKAGE_CONTACT "${SWIRL_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
foreach(component LIBRARY PROGRAM PYTHON)
  set(CPACK_DEBIAN_${component}_FILE_NAME DEB-DEFAULT)
endforeach()

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME swirl)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "exact event-driven simulation of discs in a swirled container
It measures runs, recordings and videos, and draws figures and movies.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libswirl-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "g++ | libstdc++-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "C++20 library of swirl: engine and measurements
Programs find it by find_package(swirl).")

if(TARGET swirl_python)
  get_directory_property(major DIRECTORY bindings/python DEFINITION Python_VERSION_MAJOR)
  get_directory_property(minor DIRECTORY bindings/python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-swirl)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${major}.${minor}), python3 (<< ${major}.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib, python3-scipy, python3-jinja2, swirl")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Python module swirl: simulations, measurements and sweeps
All results are numpy arrays.")
endif()

# Debian's changelog of each package refers to CHANGELOG.md.
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component program library python)
  set(excluded "")
  if(component STREQUAL python)
    set(excluded EXCLUDE_FROM_ALL)
  endif()
  string(TOUPPER ${component} name)
  set(package ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  if(package AND EXISTS /etc/debian_version)
    set(folder ${PROJECT_BINARY_DIR}/debian/${package})
    file(WRITE ${folder}/changelog "${package} (${PROJECT_VERSION}) unstable; urgency=medium\n\n"
      "  * CHANGELOG.md in the sources and in the package swirl lists the changes.\n\n"
      " -- ${SWIRL_CONTACT}  ${today}\n")
    file(ARCHIVE_CREATE OUTPUT ${folder}/changelog.gz PATHS ${folder}/changelog FORMAT raw COMPRESSION GZip
         COMPRESSION_LEVEL 9)
    install(FILES ${folder}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component}
            ${excluded})
  endif()
endforeach()
include(CPack)
