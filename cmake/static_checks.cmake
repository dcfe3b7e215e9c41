# Checks that read the sources: headers that compile alone (tests), formatting (test and target check_format),
# clang-tidy (the headers: test check_tidy_headers; all programs: target check_tidy). Each is there where its tool is.

file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/include/*.h)
file(GLOB_RECURSE programs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/*.cpp
     ${PROJECT_SOURCE_DIR}/examples/*.cpp ${PROJECT_SOURCE_DIR}/benchmark/*.cpp ${PROJECT_SOURCE_DIR}/test/*.cpp)

# Every header is compiled alone, twice in a row, with all warnings as errors: by clang++ where it is there, two to three
# times faster at this than g++, which meets all headers in the programs. One file carries the compile flags of all.
# Each is taken as the compiled core declares it, so that what defines it (*_impl.h) has to include what it uses by itself;
# the internal ones after what is compiled once for all of them, the public ones with nothing before them. The umbrella
# header is compiled with all definitions.
find_program(CRUDE_REGISTRATION_HEADER_COMPILER NAMES clang++-14 clang++)
mark_as_advanced(CRUDE_REGISTRATION_HEADER_COMPILER)
if(CRUDE_REGISTRATION_HEADER_COMPILER)
  set(header_compiler ${CRUDE_REGISTRATION_HEADER_COMPILER})
else()
  set(header_compiler ${CMAKE_CXX_COMPILER})
endif()
file(WRITE ${PROJECT_BINARY_DIR}/headers/flags.cpp "")
add_library(headers_alone_flags OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/headers/flags.cpp)
target_link_libraries(headers_alone_flags PRIVATE CGAL::CGAL CGAL::Eigen3_support
  $<TARGET_NAME_IF_EXISTS:CGAL::TBB_support> $<TARGET_NAME_IF_EXISTS:PNG::PNG>
  $<TARGET_NAME_IF_EXISTS:Boost::iostreams> $<TARGET_NAME_IF_EXISTS:nlohmann_json::nlohmann_json>)
target_compile_definitions(headers_alone_flags PRIVATE
  $<TARGET_PROPERTY:Crude_registration,INTERFACE_COMPILE_DEFINITIONS>)
set(includes "$<FILTER:$<TARGET_PROPERTY:headers_alone_flags,INCLUDE_DIRECTORIES>,EXCLUDE,^/usr/include(/[^/]*-linux-[^/]*)?$>")
set(definitions "$<TARGET_PROPERTY:headers_alone_flags,COMPILE_DEFINITIONS>")
set(compile_flags ${PROJECT_BINARY_DIR}/headers/compile_flags.txt) # where clang-tidy looks for them
file(GENERATE OUTPUT ${compile_flags} CONTENT "-std=c++17\n-frounding-math\n-I${PROJECT_SOURCE_DIR}/include
$<$<BOOL:${includes}>:-isystem$<JOIN:${includes},\n-isystem>>
$<$<BOOL:${definitions}>:-D$<JOIN:${definitions},\n-D>>\n")
# What takes most of the time of most files.
set(common "")
if(header_compiler MATCHES "clang")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/headers/common.h CONTENT
    "#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>\n#include <CGAL/Surface_mesh.h>\n#include <Eigen/Dense>\n")
  set(common ${PROJECT_BINARY_DIR}/headers/common.pch)
  add_custom_command(OUTPUT ${common}
    COMMAND ${header_compiler} @${compile_flags} -x c++-header ${PROJECT_BINARY_DIR}/headers/common.h -o ${common}
    DEPENDS ${PROJECT_BINARY_DIR}/headers/common.h ${compile_flags} VERBATIM COMMENT "What the headers have in common")
endif()
# check_source(STAMPS NAME SOURCE COMMENT [AFTER_COMMON] [OPTION...]): compiled, but for the code; adds a file that says so
# to the list STAMPS.
function(check_source stamps name source comment)
  set(dependency "")
  if("AFTER_COMMON" IN_LIST ARGN)
    list(REMOVE_ITEM ARGN AFTER_COMMON)
    if(common)
      list(APPEND ARGN -include-pch ${common})
      set(dependency DEPENDS ${common})
    endif()
  endif()
  set(stamp ${PROJECT_BINARY_DIR}/headers/${name}.stamp)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${header_compiler} @${compile_flags} -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
            ${ARGN} -MMD -MT ${stamp} -MF ${stamp}.d ${source}
    COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
    ${dependency} DEPFILE ${stamp}.d COMMAND_EXPAND_LISTS VERBATIM COMMENT "${comment}")
  set(${stamps} ${${stamps}} ${stamp} PARENT_SCOPE)
endfunction()
set(header_stamps "")
set(all_headers "")
foreach(header IN LISTS headers)
  string(APPEND all_headers "#include <${header}>\n")
  string(MAKE_C_IDENTIFIER ${header} name)
  set(source ${PROJECT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n#include <${header}>\n")
  set(options -DCGAL_CRUDE_REGISTRATION_COMPILED)
  if(header STREQUAL "CGAL/Crude_registration.h")
    set(options "")
  elseif(header MATCHES "/internal/|/all_headers.h$|/crude_registration.h$")
    list(APPEND options AFTER_COMMON)
  endif()
  check_source(header_stamps ${name} ${source} "${header} alone" ${options})
endforeach()
add_custom_target(headers_alone DEPENDS ${header_stamps})
# The benchmarks, which few builds build, and the command line program, which g++ compiles.
set(program_stamps "")
file(GLOB app_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/apps/*/*.cpp)
foreach(source IN LISTS app_sources)
  string(MAKE_C_IDENTIFIER ${source} name)
  check_source(program_stamps ${name} ${PROJECT_SOURCE_DIR}/${source} "${source}" AFTER_COMMON
    -DCGAL_CRUDE_REGISTRATION_COMPILED "-DCRUDE_REGISTRATION_VERSION=\"${PROJECT_VERSION}\"")
endforeach()
if(TARGET benchmarks)
  get_target_property(names benchmarks MANUALLY_ADDED_DEPENDENCIES)
  foreach(name IN LISTS names)
    get_target_property(is_left_out ${name} EXCLUDE_FROM_ALL)
    if(is_left_out)
      check_source(program_stamps benchmark_${name} ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/${name}.cpp
        "benchmark ${name}" AFTER_COMMON -DCGAL_CRUDE_REGISTRATION_COMPILED)
    endif()
  endforeach()
endif()
add_custom_target(programs_compile DEPENDS ${program_stamps})
# What compares with other libraries, which few builds have a part in: its compilation, by the headers of those that are
# installed. The libraries themselves are not looked for: PCL alone brings hundreds of packages.
set(peer_stamps "")
set(peer_definitions "")
if(TARGET benchmarks)
  set(header_open3d open3d/geometry/PointCloud.h)
  set(header_pcl pcl/point_cloud.h)
  file(GLOB pcl_folders /usr/include/pcl-*)
  foreach(peer open3d pcl)
    string(TOUPPER ${peer} upper_peer)
    find_path(CRUDE_REGISTRATION_${upper_peer}_HEADERS ${header_${peer}} HINTS ${${peer}_folders})
    mark_as_advanced(CRUDE_REGISTRATION_${upper_peer}_HEADERS)
    set(folder ${CRUDE_REGISTRATION_${upper_peer}_HEADERS})
    if(NOT folder)
      message(STATUS "Without lib${peer}-dev: the test peers_compile does not see what compare_with_peers does with it")
      continue()
    endif()
    set(system "")
    if(NOT folder STREQUAL "/usr/include")
      set(system -isystem ${folder})
    endif()
    check_source(peer_stamps peer_${peer} ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/peers/${peer}.cpp
      "peer ${peer}" -DCGAL_CRUDE_REGISTRATION_COMPILED ${system})
    if(peer STREQUAL "pcl")
      check_source(peer_stamps peer_spin_images
        ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/peers/spin_images.cpp "spin images of pcl"
        -DCGAL_CRUDE_REGISTRATION_COMPILED ${system})
    endif()
    list(APPEND peer_definitions -DCRUDE_REGISTRATION_HAS_${upper_peer})
  endforeach()
  if(peer_definitions)
    check_source(peer_stamps compare_with_peers
      ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/compare_with_peers.cpp "compare_with_peers with its peers"
      AFTER_COMMON -DCGAL_CRUDE_REGISTRATION_COMPILED ${peer_definitions})
  endif()
endif()
add_custom_target(peers_compile DEPENDS ${peer_stamps})
if(CRUDE_REGISTRATION_WITH_TESTS)
  include(ProcessorCount)
  ProcessorCount(processors)
  set(keep_going "")
  if(CMAKE_GENERATOR MATCHES "Ninja")
    set(keep_going -- -k 0)
  endif()
  set(checks headers_alone programs_compile)
  if(peer_stamps)
    list(APPEND checks peers_compile)
  endif()
  foreach(check IN LISTS checks)
    add_test(NAME ${check}
      COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target ${check} --parallel ${processors} ${keep_going})
    set_tests_properties(${check} PROPERTIES RUN_SERIAL ON TIMEOUT 900)
  endforeach()
endif()

# Formatting: the answer depends on the version.
find_program(CRUDE_REGISTRATION_CLANG_FORMAT NAMES clang-format-14)
mark_as_advanced(CRUDE_REGISTRATION_CLANG_FORMAT)
set(absolute_headers ${headers})
list(TRANSFORM absolute_headers PREPEND ${PROJECT_SOURCE_DIR}/include/)
file(GLOB_RECURSE app_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/*.h ${PROJECT_SOURCE_DIR}/python/src/*.h
     ${PROJECT_SOURCE_DIR}/python/src/*.cpp)
if(CRUDE_REGISTRATION_CLANG_FORMAT)
  set(check_format ${CRUDE_REGISTRATION_CLANG_FORMAT} --dry-run --Werror ${absolute_headers} ${app_headers} ${programs})
  add_custom_target(check_format COMMAND ${check_format} VERBATIM)
  add_custom_target(format COMMAND ${CRUDE_REGISTRATION_CLANG_FORMAT} -i ${absolute_headers} ${app_headers} ${programs} VERBATIM)
  if(CRUDE_REGISTRATION_WITH_TESTS)
    add_test(NAME check_format COMMAND ${check_format})
  endif()
endif()

# clang-tidy with the checks of .clang-tidy: all headers in one file, and the programs, one at a time, which show it the
# templates with their arguments.
find_program(CRUDE_REGISTRATION_CLANG_TIDY NAMES clang-tidy-14 clang-tidy)
mark_as_advanced(CRUDE_REGISTRATION_CLANG_TIDY)
if(CRUDE_REGISTRATION_CLANG_TIDY)
  set(tidy ${CRUDE_REGISTRATION_CLANG_TIDY} --quiet --warnings-as-errors=* --config-file=${PROJECT_SOURCE_DIR}/.clang-tidy
      -p ${PROJECT_BINARY_DIR}/headers)
  set(all_headers_source ${PROJECT_BINARY_DIR}/headers/all_headers.cpp)
  file(CONFIGURE OUTPUT ${all_headers_source} CONTENT "${all_headers}")
  if(CRUDE_REGISTRATION_WITH_TESTS)
    add_test(NAME check_tidy_headers COMMAND ${tidy} ${all_headers_source})
    set_tests_properties(check_tidy_headers PROPERTIES TIMEOUT 900 COST 1000)
  endif()
  set(stamps "")
  foreach(program IN LISTS programs)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${program})
    if(name MATCHES "^test/(consumer|fuzz)/|/peers/|/mpi/")
      continue()
    endif()
    string(MAKE_C_IDENTIFIER ${name} stamp)
    set(stamp ${PROJECT_BINARY_DIR}/tidy/${stamp})
    add_custom_command(OUTPUT ${stamp}
      COMMAND ${tidy} ${program}
      COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
      DEPENDS ${program} ${absolute_headers} ${app_headers} ${PROJECT_SOURCE_DIR}/.clang-tidy VERBATIM
      COMMENT "clang-tidy ${name}")
    list(APPEND stamps ${stamp})
  endforeach()
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/tidy)
  add_custom_target(check_tidy DEPENDS ${stamps})
endif()
