# cpack -G DEB --config build/CPackConfig.cmake: a Debian package. What the program and its modules are linked with is read
# from the files (dpkg-shlibdeps, of dpkg-dev); what they run or open is named here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tendril)
set(CPACK_PACKAGE_VENDOR "tendril")
set(CPACK_PACKAGE_CONTACT "tendril developers <developers@tendril.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "Static equilibria of cables, hoses and harnesses among geometry, with tolerances, routes,
installations and robots' dress packs; scripted in Lua, with pictures and charts.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, gnuplot-nox | gnuplot")
include(CPack)
