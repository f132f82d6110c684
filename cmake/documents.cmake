# Manual pages of the commands, and their completions for bash, zsh and fish. The build writes them to the folder
# `documents` from the tables of the help (src/swirl/cli/documents.cpp), and installs them with the program.
set(has_documents OFF)
find_program(gzip_program gzip)
if(CMAKE_CROSSCOMPILING OR SKBUILD OR SWIRL_FUZZ OR SWIRL_THREAD_SANITIZE)
  # The build cannot run the program that writes them, or no package installs them.
elseif(NOT gzip_program)
  message(STATUS "gzip was not found: this build has no manual pages and completions")
else()
  set(has_documents ON)
endif()
if(NOT has_documents)
  return()
endif()

add_executable(swirl-documents src/swirl/cli/documents.cpp ${command_objects})
target_link_libraries(swirl-documents PRIVATE ${command_libraries})
swirl_settings(swirl-documents -O1)

set(documents_folder ${PROJECT_BINARY_DIR}/documents)
set(manual_pages)
foreach(program swirl ${documented_programs})
  list(APPEND manual_pages ${documents_folder}/${program}.1)
endforeach()
list(TRANSFORM manual_pages APPEND .gz OUTPUT_VARIABLE compressed_pages)
set(completions ${documents_folder}/swirl.bash ${documents_folder}/_swirl ${documents_folder}/swirl.fish)
add_custom_command(OUTPUT ${compressed_pages} ${completions}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${documents_folder}
  COMMAND swirl-documents ${documents_folder}
  # Debian's rules ask for level 9 and no date.
  COMMAND ${gzip_program} -9nf ${manual_pages}
  DEPENDS swirl-documents COMMENT "Writing manual pages and completions" VERBATIM)
add_custom_target(documents ALL DEPENDS ${compressed_pages} ${completions})
