# Installs the build into PREFIX and runs SCRIPT there.
file(REMOVE_RECURSE ${PREFIX})
set(out ${PREFIX}/out)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} RESULT_VARIABLE result OUTPUT_QUIET)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "cmake --install ended with ${result}")
endif()

# Nothing that runs knows the source or the build.
file(GLOB_RECURSE files ${PREFIX}/bin/* ${PREFIX}/lib/tendril/* ${PREFIX}/share/tendril/lua/*)
foreach(file ${files})
  foreach(tree ${SOURCE}/src ${SOURCE}/lua ${BUILD}/modules ${BUILD}/assets)
    file(STRINGS ${file} found LIMIT_COUNT 1 REGEX "${tree}")
    if(found)
      message(FATAL_ERROR "${file} names ${tree}: ${found}")
    endif()
  endforeach()
endforeach()

file(MAKE_DIRECTORY ${out})
file(WRITE ${PREFIX}/share/tendril/lua/probe.lua "return 'found'")
execute_process(COMMAND env -i PATH=/usr/bin:/bin ${PREFIX}/bin/tendril ${SCRIPT} ${out}
                WORKING_DIRECTORY / RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
message(STATUS "${output}${errors}")
if(NOT result EQUAL 0 OR NOT output MATCHES "installed: all parts found")
  message(FATAL_ERROR "the installed program ended with ${result}")
endif()
foreach(name hose.png sag.png pipe.glb outcomes.sqlite)
  file(SIZE ${out}/${name} size)
  if(size LESS 500)
    message(FATAL_ERROR "${name} holds ${size} bytes")
  endif()
endforeach()

# Models and no more of the build than these.
file(GLOB_RECURSE files RELATIVE ${PREFIX}/share/tendril/assets ${PREFIX}/share/tendril/assets/*)
foreach(file ${files})
  if(NOT file MATCHES "\\.(ply|parts|kbl|vec|urdf|xml|stl)$")
    message(FATAL_ERROR "share/tendril/assets holds ${file}")
  endif()
endforeach()

# Every study that was installed can be read, and the manual page is where man looks for it.
file(GLOB studies ${PREFIX}/share/tendril/studies/*.lua)
list(LENGTH studies count)
if(count LESS 5 OR NOT EXISTS ${PREFIX}/share/man/man1/tendril.1 OR NOT EXISTS ${PREFIX}/share/doc/tendril/README.md)
  message(FATAL_ERROR "studies, manual page or README are missing from ${PREFIX}/share")
endif()
file(REMOVE_RECURSE ${PREFIX})
