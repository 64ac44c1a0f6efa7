# cmake --install build --prefix P: the program finds the rest from where it lies itself (src/base/installation.h).
install(TARGETS tendril RUNTIME DESTINATION bin)

# Every module of the program, whatever folder it is made in.
function(install_modules folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "MODULE_LIBRARY")
      install(TARGETS ${target} LIBRARY DESTINATION lib/tendril)
    endif()
  endforeach()
  get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(other ${below})
    install_modules(${other})
  endforeach()
endfunction()
install_modules(${PROJECT_SOURCE_DIR}/src)

install(DIRECTORY lua/ DESTINATION share/tendril/lua FILES_MATCHING PATTERN "*.lua")
install(DIRECTORY scripts/studies/ DESTINATION share/tendril/studies FILES_MATCHING PATTERN "*.lua")
# All that the build puts there, but for what makes it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/assets/ DESTINATION share/tendril/assets
        PATTERN "CMakeFiles" EXCLUDE PATTERN "*.cmake" EXCLUDE PATTERN "*.a" EXCLUDE PATTERN "make_*" EXCLUDE)

install(FILES man/tendril.1 DESTINATION share/man/man1)
install(FILES README.md DESTINATION share/doc/tendril)
install(FILES LICENSE DESTINATION share/doc/tendril RENAME copyright)
file(GLOB pictures CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/assets/*.png ${PROJECT_SOURCE_DIR}/assets/*.svg)
install(FILES ${pictures} DESTINATION share/doc/tendril/assets)
