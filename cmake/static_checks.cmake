# Checks that read the sources: headers that compile alone (tests), formatting (test and target check_format),
# clang-tidy (the headers: test check_tidy_headers; all programs: target check_tidy). Each is there where its tool is.

file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/include/*.h)
file(GLOB_RECURSE programs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/*.cpp
     ${PROJECT_SOURCE_DIR}/examples/*.cpp ${PROJECT_SOURCE_DIR}/benchmark/*.cpp
     ${PROJECT_SOURCE_DIR}/calibration/*.cpp ${PROJECT_SOURCE_DIR}/test/*.cpp)

# Every header is compiled alone, twice in a row, with all warnings as errors: by clang++ where it is there, two to three
# times faster at this than g++, which meets all headers in the programs. One file carries the compile flags of all.
# Each is taken as the compiled core declares it, so that what defines it (*_impl.h) has to include what it uses by itself;
# the umbrella header is compiled with all definitions: by clang-tidy where it is there, which has to compile it anyway,
# and says what the compiler says. What headers include of lower ones and of other libraries is
# compiled once for those that include the same, and headers that include each other are one file: header_prefixes.cmake
# says why this is as good as alone.
find_program(CRUDE_REGISTRATION_CLANG_TIDY NAMES clang-tidy-14 clang-tidy)
mark_as_advanced(CRUDE_REGISTRATION_CLANG_TIDY)
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
# The exact numbers that CGAL's kernel falls back on are its own, and not those of GMP and Boost, which take half of the
# time that the kernel takes: nothing that is checked names them. (g++ compiles the programs with those.)
set(own_numbers -DCGAL_DISABLE_GMP -DCGAL_DO_NOT_USE_BOOST_MP -UCGAL_USE_GMPXX)
list(JOIN own_numbers "\n" own_numbers)
file(GENERATE OUTPUT ${compile_flags} CONTENT "-std=c++17\n-frounding-math\n-I${PROJECT_SOURCE_DIR}/include
$<$<BOOL:${includes}>:-isystem$<JOIN:${includes},\n-isystem>>
$<$<BOOL:${definitions}>:-D$<JOIN:${definitions},\n-D>>
${own_numbers}\n")
# From the one that includes most to the one that includes least. (Their templates are instantiated once, and not by each
# file that is compiled after them.)
set(prefixes "")
if(header_compiler MATCHES "clang")
  set(prefixes scans reduced kernel geometry motions parameters)
  set(own CGAL/Crude_registration)
  set(includes_of_parameters ${own}/named_parameters.h)
  set(includes_of_motions ${own}/internal/base/Rigid_motion.h)
  set(includes_of_geometry ${own}/internal/mesh/mesh_geometry.h ${own}/named_parameters.h)
  set(includes_of_kernel CGAL/Exact_predicates_inexact_constructions_kernel.h ${includes_of_motions})
  set(includes_of_reduced ${own}/internal/reduction/Reduced_scan.h)
  set(includes_of_scans ${own}/Scan.h)
endif()
set(compiled_prefixes "")
foreach(prefix IN LISTS prefixes)
  set(content "")
  foreach(include IN LISTS includes_of_${prefix})
    string(APPEND content "#include <${include}>\n")
  endforeach()
  set(source ${PROJECT_BINARY_DIR}/headers/${prefix}.h)
  file(CONFIGURE OUTPUT ${source} CONTENT "${content}")
  set(compiled ${PROJECT_BINARY_DIR}/headers/${prefix}.pch)
  add_custom_command(OUTPUT ${compiled}
    COMMAND ${header_compiler} @${compile_flags} -DCGAL_CRUDE_REGISTRATION_COMPILED -fpch-instantiate-templates
            -MMD -MT ${compiled} -MF ${compiled}.d -x c++-header ${source} -o ${compiled}
    DEPENDS ${source} ${compile_flags} DEPFILE ${compiled}.d VERBATIM COMMENT "What headers include: ${prefix}")
  list(APPEND compiled_prefixes ${compiled})
endforeach()
# Warnings that stand for checks of clang-tidy, which takes longer to say the same (see check_tidy_headers).
set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
set(more_warnings "")
if(prefixes)
  set(more_warnings -Wreserved-identifier -Wreserved-macro-identifier -Wzero-as-null-pointer-constant -Wdeprecated)
endif()
# check_source(STAMPS NAME SOURCE COMMENT [DEPENDS FILE...] [OPTIONS OPTION...]): compiled, but for the code; adds a file
# that says so to the list STAMPS.
function(check_source stamps name source comment)
  cmake_parse_arguments(check "" "" "DEPENDS;OPTIONS" ${ARGN})
  set(stamp ${PROJECT_BINARY_DIR}/headers/${name}.stamp)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${header_compiler} @${compile_flags} -fsyntax-only ${warnings} ${more_warnings} -Werror
            ${check_OPTIONS} -MMD -MT ${stamp} -MF ${stamp}.d ${source}
    COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
    DEPENDS ${check_DEPENDS} DEPFILE ${stamp}.d COMMAND_EXPAND_LISTS VERBATIM COMMENT "${comment}")
  set(${stamps} ${${stamps}} ${stamp} PARENT_SCOPE)
endfunction()
# Programs are compiled after the headers that most of them include, whatever each includes.
set(after_most OPTIONS)
if(prefixes)
  set(most ${PROJECT_BINARY_DIR}/headers/scans.pch)
  set(after_most DEPENDS ${most} OPTIONS -include-pch ${most})
endif()
set(absolute_headers ${headers})
list(TRANSFORM absolute_headers PREPEND ${PROJECT_SOURCE_DIR}/include/)
set(header_stamps "")
set(prefix_options "")
set(all_headers "")
foreach(header IN LISTS headers)
  string(APPEND all_headers "#include <${header}>\n")
  if(header STREQUAL "CGAL/Crude_registration.h" AND CRUDE_REGISTRATION_CLANG_TIDY AND CRUDE_REGISTRATION_WITH_TESTS)
    set(all_headers "#include <${header}>\n${all_headers}")
    continue() # the first in the file of clang-tidy
  endif()
  if(header STREQUAL "CGAL/Crude_registration/all_headers.h")
    continue() # all of what the umbrella header includes (header_prefixes.cmake leaves it out, too)
  endif()
  string(MAKE_C_IDENTIFIER ${header} name)
  set(source ${PROJECT_BINARY_DIR}/headers/${name}.cpp)
  set(options "")
  if(NOT header STREQUAL "CGAL/Crude_registration.h")
    list(APPEND options -DCGAL_CRUDE_REGISTRATION_COMPILED)
  endif()
  set(prefix_option "")
  if(prefixes)
    set(prefix_option ${PROJECT_BINARY_DIR}/headers/${name}.options)
    list(APPEND prefix_options ${prefix_option} ${source})
    list(APPEND options @${prefix_option})
  else()
    file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n#include <${header}>\n")
  endif()
  check_source(header_stamps ${name} ${source} "${header} alone" DEPENDS ${source} ${prefix_option} ${compiled_prefixes}
    OPTIONS ${options})
endforeach()
if(prefixes)
  list(JOIN prefixes "|" joined_prefixes)
  add_custom_command(OUTPUT ${prefix_options}
    COMMAND ${CMAKE_COMMAND} -D include_dir=${PROJECT_SOURCE_DIR}/include -D output_dir=${PROJECT_BINARY_DIR}/headers
            -D prefixes=${joined_prefixes} -P ${PROJECT_SOURCE_DIR}/cmake/header_prefixes.cmake
    DEPENDS ${absolute_headers} ${PROJECT_SOURCE_DIR}/cmake/header_prefixes.cmake VERBATIM
    COMMENT "What each header includes")
endif()
add_custom_target(headers_alone DEPENDS ${header_stamps})
# The benchmarks, which few builds build. (What all builds build, as the command line program, g++ sees there with the same
# warnings as errors.)
# Some are compiled as one file, each in a namespace of its own, after all that they include, which takes longer than they.
set(program_stamps "")
set(programs_together 10)
if(TARGET benchmarks)
  get_target_property(names benchmarks MANUALLY_ADDED_DEPENDENCIES)
  set(number 0)
  set(folders "")
  set(groups "")
  foreach(name IN LISTS names)
    get_target_property(is_left_out ${name} EXCLUDE_FROM_ALL)
    if(is_left_out)
      get_target_property(folder ${name} SOURCE_DIR)
      list(APPEND folders ${folder})
      math(EXPR group "${number} / ${programs_together} + 1")
      math(EXPR number "${number} + 1")
      list(APPEND groups ${group})
      file(STRINGS ${folder}/${name}.cpp includes REGEX "^# *(include|if|else|elif|endif)")
      list(JOIN includes "\n" includes)
      string(APPEND includes_of_programs_${group} "${includes}\n")
      string(APPEND programs_${group} "namespace program_${name} {\n#include \"${folder}/${name}.cpp\"\n}\n")
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${name}.cpp) # what it includes
    endif()
  endforeach()
  list(REMOVE_DUPLICATES folders)
  list(TRANSFORM folders PREPEND -I)
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    set(source ${PROJECT_BINARY_DIR}/headers/programs_${group}.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "${includes_of_programs_${group}}${programs_${group}}")
    check_source(program_stamps programs_${group} ${source} "benchmarks ${group}" ${after_most} ${folders}
      -DCGAL_CRUDE_REGISTRATION_COMPILED)
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
      "peer ${peer}" OPTIONS -DCGAL_CRUDE_REGISTRATION_COMPILED ${system})
    if(peer STREQUAL "pcl")
      check_source(peer_stamps peer_spin_images
        ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/peers/spin_images.cpp "spin images of pcl"
        OPTIONS -DCGAL_CRUDE_REGISTRATION_COMPILED ${system})
    endif()
    list(APPEND peer_definitions -DCRUDE_REGISTRATION_HAS_${upper_peer})
  endforeach()
  if(peer_definitions)
    check_source(peer_stamps compare_with_peers
      ${PROJECT_SOURCE_DIR}/benchmark/Crude_registration/compare_with_peers.cpp "compare_with_peers with its peers"
      ${after_most} -DCGAL_CRUDE_REGISTRATION_COMPILED ${peer_definitions})
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
if(CRUDE_REGISTRATION_CLANG_TIDY)
  set(tidy ${CRUDE_REGISTRATION_CLANG_TIDY} --quiet --warnings-as-errors=* --config-file=${PROJECT_SOURCE_DIR}/.clang-tidy
      -p ${PROJECT_BINARY_DIR}/headers)
  set(all_headers_source ${PROJECT_BINARY_DIR}/headers/all_headers.cpp)
  file(CONFIGURE OUTPUT ${all_headers_source} CONTENT "${all_headers}")
  if(CRUDE_REGISTRATION_WITH_TESTS)
    # Without what the compiler says of each header: what is reserved, null pointers, empty bodies and unused parameters,
    # and the others, which are of what C++17 deprecates or has no more.
    set(without "")
    if(more_warnings)
      foreach(check bugprone-reserved-identifier bugprone-suspicious-semicolon misc-unused-parameters
              modernize-deprecated-ios-base-aliases modernize-replace-auto-ptr modernize-use-noexcept modernize-use-nullptr
              modernize-use-uncaught-exceptions)
        string(APPEND without ",-${check}")
      endforeach()
    endif()
    set(tidy_headers ${tidy} --checks=clang-diagnostic-*${without})
    list(TRANSFORM warnings PREPEND --extra-arg= OUTPUT_VARIABLE tidy_warnings)
    list(APPEND tidy_headers ${tidy_warnings})
    add_test(NAME check_tidy_headers COMMAND ${tidy_headers} ${all_headers_source})
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
