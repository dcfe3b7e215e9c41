# For each header of the package, what it may be compiled after and is still as good as alone:
# cmake -D include_dir=DIR -D output_dir=DIR -D prefixes=NAME|NAME... -P header_prefixes.cmake
#
# OUTPUT_DIR/NAME.h is a prefix: includes of lower headers of the package and of other libraries, compiled once to
# OUTPUT_DIR/NAME.pch. A header that includes all of them, itself or by headers of the package, sees the same names with
# the prefix before it as alone, as soon as its own includes are over; if this is so for each header, then none of them
# takes a name from a header before it. A header that is in a prefix is not compiled after it. The first prefix, of the
# largest to the smallest, whose includes are all among a header's is written as the compiler's option to
# OUTPUT_DIR/HEADER.options, which is empty if there is none.
#
# OUTPUT_DIR/HEADER.cpp is what is compiled: the header, twice in a row. For the same reason it may come after another
# header that it includes: files of the same prefix are one file where each header includes the one before it. The file
# has the name of the last; those of the others are empty.
#
# All is as the compiled core declares it: X.h does not include X_impl.h. The umbrella header, which is compiled with all
# definitions, is compiled after nothing.
cmake_minimum_required(VERSION 3.22)

function(includes_of file result)
  file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include <")
  set(names "")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*<(.*)>.*" "\\1" name "${line}")
    if(file MATCHES "_impl\\.h$" OR NOT name MATCHES "_impl\\.h$")
      list(APPEND names ${name})
    endif()
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# all_includes(HEADER RESULT): of the header and of what it includes of the package
function(all_includes header result)
  get_property(is_known GLOBAL PROPERTY "all_${header}" SET)
  if(NOT is_known)
    set_property(GLOBAL PROPERTY "all_${header}" "")
    includes_of(${include_dir}/${header} all)
    foreach(name IN LISTS all)
      if(EXISTS ${include_dir}/${name})
        all_includes(${name} more)
        list(APPEND all ${more})
      endif()
    endforeach()
    list(REMOVE_DUPLICATES all)
    set_property(GLOBAL PROPERTY "all_${header}" "${all}")
  endif()
  get_property(all GLOBAL PROPERTY "all_${header}")
  set(${result} ${all} PARENT_SCOPE)
endfunction()

string(REPLACE "|" ";" prefixes "${prefixes}")
foreach(prefix IN LISTS prefixes)
  includes_of(${output_dir}/${prefix}.h includes_${prefix})
  set(own_${prefix} "") # the headers of the package in it
  foreach(name IN LISTS includes_${prefix})
    if(EXISTS ${include_dir}/${name})
      all_includes(${name} all)
      list(APPEND own_${prefix} ${name} ${all})
    endif()
  endforeach()
endforeach()
set(umbrella CGAL/Crude_registration.h)
file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/*.h)
list(REMOVE_ITEM headers CGAL/Crude_registration/all_headers.h) # all of what the umbrella header includes
set(order "")
foreach(header IN LISTS headers)
  all_includes(${header} all_of_${header})
  set(prefix_of_${header} "")
  foreach(prefix IN LISTS prefixes)
    if(header IN_LIST own_${prefix} OR header STREQUAL umbrella)
      continue()
    endif()
    set(missing ${includes_${prefix}})
    list(REMOVE_ITEM missing ${all_of_${header}})
    if(NOT missing)
      set(prefix_of_${header} ${prefix})
      break()
    endif()
  endforeach()
  list(LENGTH all_of_${header} number)
  list(APPEND order "${number} ${header}")
endforeach()

# From the header that includes most on, each with what it includes, that with what it includes...
list(SORT order COMPARE NATURAL ORDER DESCENDING)
list(TRANSFORM order REPLACE "^[0-9]+ " "")
while(order)
  list(POP_FRONT order last)
  set(content "#include <${last}>\n#include <${last}>\n")
  set(first ${last})
  if(NOT last STREQUAL umbrella)
    foreach(header IN LISTS order)
      if(header IN_LIST all_of_${first} AND prefix_of_${header} STREQUAL "${prefix_of_${last}}" AND
         NOT header STREQUAL umbrella)
        string(PREPEND content "#include <${header}>\n#include <${header}>\n")
        string(MAKE_C_IDENTIFIER ${header} name)
        file(CONFIGURE OUTPUT ${output_dir}/${name}.options CONTENT "")
        file(CONFIGURE OUTPUT ${output_dir}/${name}.cpp CONTENT "// compiled with ${last}\n")
        list(REMOVE_ITEM order ${header})
        set(first ${header})
      endif()
    endforeach()
  endif()
  set(option "")
  if(prefix_of_${last})
    set(option "-include-pch ${output_dir}/${prefix_of_${last}}.pch\n")
  endif()
  string(MAKE_C_IDENTIFIER ${last} name)
  file(CONFIGURE OUTPUT ${output_dir}/${name}.options CONTENT "${option}")
  file(CONFIGURE OUTPUT ${output_dir}/${name}.cpp CONTENT "${content}")
endwhile()
