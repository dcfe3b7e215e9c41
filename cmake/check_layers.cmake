# Fails where a header includes one of a higher room: cmake -D include_dir=DIR -P check_layers.cmake
#
# The rooms from the bottom to the top. A header may include what is in its own room or in one below; a public room and
# the internal one of the same name are one: the public header is the door. `[^/]*` are the files of a folder itself.
cmake_minimum_required(VERSION 3.22)
set(rooms
  "named_parameters.h|Preparation_interrupted.h|IO/IO_error.h|internal/base/.*"
  "Judgement_limits.h|Registration_status.h|Registration_result.h|Assembly_status.h|Assembly_result.h|Sensor.h|Range_image.h"
  "internal/mesh/.*"
  "internal/lookup/.*"
  "(internal/)?sampling/.*"
  "(internal/)?reduction/.*"
  "(internal/)?motion/.*"
  "internal/judgement/.*"
  "(internal/)?matching/.*"
  "(internal/)?simulation/.*"
  "internal/pipeline/.*"
  "internal/assembly/.*"
  "Scan.h"
  "IO/.*"
  "register_scans.h"
  "judge_motion.h|register_scans_with_scale.h|compare_points.h|fused_points.h"
  "assemble_scans.h"
  "assemble_by_processes.h"
  "register_meshes.h"
  "all_headers.h")

function(level_of header result)
  set(level -1)
  set(i 0)
  foreach(room IN LISTS rooms)
    if(level EQUAL -1 AND header MATCHES "^(${room})$")
      set(level ${i})
    endif()
    math(EXPR i "${i} + 1")
  endforeach()
  set(${result} ${level} PARENT_SCOPE)
endfunction()

set(root ${include_dir}/CGAL/Crude_registration)
file(GLOB_RECURSE headers RELATIVE ${root} ${root}/*.h)
if(NOT headers)
  message(FATAL_ERROR "there are no headers in ${root}")
endif()
foreach(header IN LISTS headers)
  level_of(${header} level)
  if(level EQUAL -1)
    message(SEND_ERROR "${header} is in no room of cmake/check_layers.cmake")
    continue()
  endif()
  file(STRINGS ${root}/${header} lines)
  list(LENGTH lines count)
  if(count GREATER 400)
    message(SEND_ERROR "${header} has ${count} lines: more than 400")
  endif()
  file(STRINGS ${root}/${header} includes REGEX "^ *#include <CGAL/Crude_registration/")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE ".*<CGAL/Crude_registration/(.*)>.*" "\\1" included "${include}")
    level_of(${included} other)
    if(other EQUAL -1)
      message(SEND_ERROR "${header} includes ${included}, which is in no room")
    elseif(other GREATER level)
      message(SEND_ERROR "${header} includes ${included}, which is in a higher room")
    endif()
  endforeach()
endforeach()
