# CRUDE_REGISTRATION_CAN_PYTHON: whether the Python module can be built here: an interpreter with its headers and numpy,
# pybind11 and nlohmann-json. CRUDE_REGISTRATION_PYTHON names the interpreter; without it the one of the path is taken, or
# that of the system, which has Debian's packages.
set(CRUDE_REGISTRATION_CAN_PYTHON OFF)
if(NOT CRUDE_REGISTRATION_PYTHON)
  foreach(python python3 /usr/bin/python3)
    execute_process(
      COMMAND ${python} -c "import numpy, os, sys, sysconfig
if os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h')): print(sys.executable)"
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
    if(result EQUAL 0 AND found)
      set(CRUDE_REGISTRATION_PYTHON ${found})
      break()
    endif()
  endforeach()
endif()
set(CRUDE_REGISTRATION_PYTHON "${CRUDE_REGISTRATION_PYTHON}" CACHE FILEPATH "The interpreter of the Python module")
if(CRUDE_REGISTRATION_PYTHON)
  # Before pybind11, which would look for another one.
  set(Python_EXECUTABLE ${CRUDE_REGISTRATION_PYTHON})
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    if(NOT pybind11_DIR) # of pip's package
      execute_process(COMMAND ${CRUDE_REGISTRATION_PYTHON} -m pybind11 --cmakedir
        OUTPUT_VARIABLE pybind11_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    endif()
    find_package(pybind11 2.10 QUIET NO_MODULE)
    find_package(nlohmann_json 3.9 QUIET)
    if(pybind11_FOUND AND nlohmann_json_FOUND)
      set(CRUDE_REGISTRATION_CAN_PYTHON ON)
    endif()
  endif()
endif()
