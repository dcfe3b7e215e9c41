# Debian packages, by `cpack -G DEB` in a build that was configured with -D CMAKE_INSTALL_PREFIX=/usr:
# libcrude-registration-dev, crude-register and, each where it is built, crude-register-mpi and
# python3-crude-registration.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME crude-registration)
set(CPACK_PACKAGE_VENDOR "The Crude_registration authors")
# (No address stands for the project: who hands packages on gives one, without which lintian says bogus-mail-host.)
set(CRUDE_REGISTRATION_MAINTAINER "The Crude_registration authors <crude-registration@localhost>" CACHE STRING
  "The maintainer of the Debian packages, with an address")
set(CPACK_PACKAGE_CONTACT ${CRUDE_REGISTRATION_MAINTAINER})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_CURRENT_SOURCE_DIR}/LICENSE.md)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET crude_register_mpi)
  list(APPEND CPACK_COMPONENTS_ALL processes)
endif()
if(TARGET crude_registration_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME crude-register)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"The program aligns two range scans of one object that overlap in part, and
says how probable it is that the answer is right. It puts many scans
together, judges the motion of another program, and writes the user's own
files moved. No first guess and no parameter is needed.")

# Its page of the manual is the one of the program, and mpirun starts it.
set(CPACK_DEBIAN_PROCESSES_PACKAGE_NAME crude-register-mpi)
set(CPACK_DEBIAN_PROCESSES_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROCESSES_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROCESSES_PACKAGE_DEPENDS "crude-register, openmpi-bin")
set(CPACK_DEBIAN_PROCESSES_DESCRIPTION
"The program puts many range scans together by the processes of an MPI run, on
one machine or many: crude_register_mpi assemble takes what crude_register
assemble takes, and answers the same.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcrude-registration-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"Headers in the form of a CGAL package, in C++17, a core that is compiled
once, and the files for CMake, by which a program aligns range scans, meshes
and points that overlap in part and whose relative position is unknown.")
# What the headers include, and what the core was compiled with.
set(depends "libcgal-dev (>= 5.5.1), libeigen3-dev (>= 3.3)")
foreach(option_and_package IN ITEMS TBB=libtbb-dev PNG=libpng-dev GZIP=libboost-iostreams-dev
        JSON=nlohmann-json3-dev)
  string(REGEX MATCH "(.*)=(.*)" matched ${option_and_package})
  if(CRUDE_REGISTRATION_COMPILED_WITH_${CMAKE_MATCH_1})
    string(APPEND depends ", ${CMAKE_MATCH_2}")
  endif()
endforeach()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ${depends})

# Its name and the rest are set where the module is.
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
"global rigid registration of range scans, for Python
 The module crude_registration finds the rigid motion between two partially
 overlapping 3-D scans, assembles many, and says whether it is right.")

# What Debian wants of each package beside: its copyright and its changes, in the folder of its name.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian_files.cmake)
set(CPACK_CRUDE_REGISTRATION_SOURCE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
include(CPack)
