# `cpack` in the build folder, or tools/package: a Debian package of the program, and one for programs that use the library.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clothsim)
set(CPACK_PACKAGE_VENDOR "The clothsim authors")
set(CPACK_PACKAGE_CONTACT "The clothsim authors <clothsim@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cloth simulation, bit-identical on GPU and CPU")
set(CPACK_PACKAGE_DESCRIPTION "Cloth moves in real time in a window and can be grabbed, pinned, blown at
and cut. Scenes of mass-spring assignments are there; drapes and garments
are exported to other programs, and results can be repeated to the last bit.
OpenGL 4.3 compute shaders simulate it, or the processor where there is no
graphics card.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME clothsim)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# OpenGL is opened when it is needed; the window and pictures need it.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1, libgl1-mesa-dri, fonts-roboto-unhinted, ffmpeg")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libclothsim-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The library is static: a program that uses it links what it uses (clothsimConfig.cmake.in).
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libc6-dev, clothsim (= ${PROJECT_VERSION}), libassimp-dev, libstb-dev, libtinyobjloader-dev, libzip-dev, nlohmann-json3-dev")
if(CGAL_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libcgal-dev")
endif()
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, the static library and the files for find_package(clothsim).")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# What Debian wants in each package's folder of documents.
find_program(GZIP gzip REQUIRED)
string(TIMESTAMP BUILD_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(packaging/changelog.in ${PROJECT_BINARY_DIR}/packaging/changelog @ONLY)
execute_process(COMMAND ${GZIP} -9nf ${PROJECT_BINARY_DIR}/packaging/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(component program development)
  string(TOUPPER ${component} upper)
  set(documents ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES LICENSE DESTINATION ${documents} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/packaging/changelog.gz DESTINATION ${documents} COMPONENT ${component})
endforeach()
include(CPack)
