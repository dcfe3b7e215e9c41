# Writes the man page and the completions of shells, which the program makes of what its commands say of themselves:
# cmake -D program=PROGRAM -D folder=FOLDER [-D gzip=GZIP] -P write_texts.cmake
cmake_minimum_required(VERSION 3.22)
file(MAKE_DIRECTORY ${folder})
foreach(option_and_file IN ITEMS man=crude_register.1 bash-completion=crude_register zsh-completion=_crude_register)
  string(REGEX MATCH "(.*)=(.*)" matched ${option_and_file})
  set(file ${folder}/${CMAKE_MATCH_2})
  execute_process(COMMAND ${program} --${CMAKE_MATCH_1} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(gzip)
  execute_process(COMMAND ${gzip} -9nf ${folder}/crude_register.1 COMMAND_ERROR_IS_FATAL ANY)
endif()
