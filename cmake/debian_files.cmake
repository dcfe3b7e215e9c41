# Run by cpack before the packages are made: copyright and changes of each, in the folder of its name.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
find_program(GZIP gzip REQUIRED)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(doc ${root}/share/doc/${name})
  if(EXISTS ${root}/share/doc/Crude_registration)
    file(RENAME ${root}/share/doc/Crude_registration ${doc})
    file(REMOVE ${doc}/LICENSE.md) # it is the GNU GPL, which each Debian has
  endif()
  file(WRITE ${doc}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Crude_registration

Files: *
Copyright: 2026 The Crude_registration authors
License: GPL-3+
 This program is free software: you can redistribute it and/or modify it under the
 terms of the GNU General Public License as published by the Free Software Foundation,
 either version 3 of the License, or (at your option) any later version.
 .
 On Debian systems, the text of the GNU General Public License version 3 is in
 /usr/share/common-licenses/GPL-3.
")
  # of the day that the changes were last edited, so that the same source gives the same package
  file(TIMESTAMP ${CPACK_CRUDE_REGISTRATION_SOURCE_DIR}/CHANGES.md date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${doc}/changelog "crude-registration (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * See /usr/share/doc/libcrude-registration-dev/CHANGES.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  execute_process(COMMAND ${GZIP} -9nf ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)
  file(CHMOD ${doc}/copyright ${doc}/changelog.gz PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endforeach()
