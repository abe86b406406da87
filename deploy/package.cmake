# The content of `cmake --install` and the Debian packages: `lockstep` to run machines, `lockstep-dev` to build on core.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS lockstep lockstep-coordinator lockstep-axis lockstep-board lockstep-fpga lockstep-grbl lockstep-web
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT lockstep)
install(DIRECTORY deploy/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep/examples COMPONENT lockstep
  USE_SOURCE_PERMISSIONS)
install(FILES ${PROJECT_BINARY_DIR}/share/lockstep/firmware/lockstep-board.uf2
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep/firmware COMPONENT lockstep OPTIONAL)
install(DIRECTORY deploy/grbl/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep/grbl COMPONENT lockstep)
install(DIRECTORY deploy/subroutines/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep/subroutines COMPONENT lockstep)
install(DIRECTORY deploy/scenarios/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep/scenarios COMPONENT lockstep)
# Documents, and the files that they link to, keep their relative paths, so that the links work.
set(DOCUMENTS README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md LICENSE NOTICE)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT lockstep
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")
file(GLOB_RECURSE DOCS CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} docs/*.md)
execute_process(COMMAND deploy/linked-files . ${DOCUMENTS} ${DOCS} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  OUTPUT_VARIABLE LINKED COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REPLACE "\n" ";" LINKED "${LINKED}")
list(FILTER LINKED EXCLUDE REGEX "^(docs|deploy/(examples|scenarios|grbl))/")
foreach(FILE ${LINKED})
  cmake_path(GET FILE PARENT_PATH FOLDER)
  install(FILES ${FILE} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${FOLDER} COMPONENT lockstep)
endforeach()
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links)
foreach(FOLDER examples scenarios grbl)
  file(CREATE_LINK ../../../lockstep/${FOLDER} ${PROJECT_BINARY_DIR}/links/${FOLDER} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/links/${FOLDER} DESTINATION ${CMAKE_INSTALL_DOCDIR}/deploy COMPONENT lockstep)
endforeach()
install(FILES deploy/completion/lockstep.bash RENAME lockstep
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT lockstep)
install(FILES deploy/completion/_lockstep
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT lockstep)

# The manual consists of the programs' own --help, which is the same for every processor. Programs built for another
# processor cannot run here. In that case it uses the pages of this machine's own build, if that exists.
set(MANUAL ${PROJECT_BINARY_DIR}/man)
if(CMAKE_CROSSCOMPILING)
  set(MANUAL ${PROJECT_SOURCE_DIR}/build/man)
else()
  set(DOCUMENTED lockstep lockstep-coordinator lockstep-axis lockstep-board lockstep-fpga lockstep-grbl lockstep-web)
  set(PROGRAMS ${DOCUMENTED})
  list(TRANSFORM PROGRAMS REPLACE "(.+)" "$<TARGET_FILE:\\1>")
  add_custom_command(OUTPUT ${MANUAL}/lockstep.1
    COMMAND ${PROJECT_SOURCE_DIR}/deploy/make-manual ${MANUAL} ${PROJECT_VERSION} ${PROGRAMS}
    DEPENDS ${DOCUMENTED} ${PROJECT_SOURCE_DIR}/deploy/make-manual VERBATIM)
  add_custom_target(manual ALL DEPENDS ${MANUAL}/lockstep.1)
endif()
install(DIRECTORY ${MANUAL}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT lockstep OPTIONAL)

install(FILES deploy/systemd/lockstep-coordinator.service deploy/systemd/lockstep-axis@.service
  deploy/systemd/lockstep-board@.service
  deploy/systemd/lockstep-grbl.service deploy/systemd/lockstep-logger.service deploy/systemd/lockstep-web.service
  DESTINATION lib/systemd/system COMPONENT lockstep)

# Installs core, the simulated device and the driver of its registers, with headers where their #include lines find
# them.
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR}-dev COMPONENT lockstep-dev)
install(TARGETS lockstep_core lockstep_sim_fpga lockstep_device_driver EXPORT lockstep
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT lockstep-dev
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lockstep)
install(DIRECTORY core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lockstep COMPONENT lockstep-dev
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inc")
file(GLOB DEVICE_HEADERS CONFIGURE_DEPENDS sim_fpga/*.hpp)
install(FILES ${DEVICE_HEADERS} ${PROJECT_BINARY_DIR}/sim_fpga/registers.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lockstep/sim_fpga COMPONENT lockstep-dev)
install(DIRECTORY sim_fpga/wiring sim_fpga/contacts DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lockstep/sim_fpga
  COMPONENT lockstep-dev FILES_MATCHING PATTERN "*.hpp")
install(FILES services/axis/device_driver.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lockstep/services/axis COMPONENT lockstep-dev)
install(DIRECTORY idl DESTINATION ${CMAKE_INSTALL_DATADIR}/lockstep COMPONENT lockstep-dev
  FILES_MATCHING PATTERN "*.idl" PATTERN "*.lcm" PATTERN "*.proto")
install(EXPORT lockstep NAMESPACE lockstep:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lockstep COMPONENT lockstep-dev)
configure_package_config_file(deploy/lockstep-config.cmake.in ${PROJECT_BINARY_DIR}/lockstep-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lockstep PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lockstep-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lockstep-config.cmake ${PROJECT_BINARY_DIR}/lockstep-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lockstep COMPONENT lockstep-dev)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # installing and packing do not first build all targets
# Builds the content of the package `lockstep`.
add_custom_target(package_files DEPENDS lockstep lockstep-coordinator lockstep-axis lockstep-board lockstep-fpga lockstep-grbl lockstep-web lockstep_lcm_python)
if(TARGET board_image)
  add_dependencies(package_files board_image)
endif()
if(TARGET manual)
  add_dependencies(package_files manual)
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lockstep)
set(CPACK_PACKAGE_VENDOR Lockstep)
set(CPACK_PACKAGE_CONTACT "the founders of Lockstep <lockstep@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Networked multi-axis stepper-motor controller")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL lockstep lockstep-dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_NAME lockstep)
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_DEPENDS "adduser, iproute2")
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_RECOMMENDS "liblcm-bin, iptables, default-jre, liblcm-java, libjchart2d-java")
set(CPACK_DEBIAN_LOCKSTEP_DESCRIPTION
  "Per-axis controller services, a coordinator that plans synchronized moves, and a
 command to run, watch, record, analyse and verify a machine.")
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/deploy/debian/postinst;${PROJECT_SOURCE_DIR}/deploy/debian/prerm;${PROJECT_SOURCE_DIR}/deploy/debian/postrm")
set(CPACK_DEBIAN_LOCKSTEP_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_DEBIAN_LOCKSTEP-DEV_PACKAGE_NAME lockstep-dev)
set(CPACK_DEBIAN_LOCKSTEP-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LOCKSTEP-DEV_PACKAGE_DEPENDS "lockstep (= ${PROJECT_VERSION}), liblcm-dev, liblcm-bin")
set(CPACK_DEBIAN_LOCKSTEP-DEV_DESCRIPTION
  "The core, to build on: step engine, planner, frames, and the axis and the coordinator as state machines
 without I/O, as a static library with headers and a CMake package.")
include(CPack)
