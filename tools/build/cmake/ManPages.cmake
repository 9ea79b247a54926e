# Run by the installation of the component `service`: manual pages of PROGRAM and of each of its commands, from what their
# --help says, by help2man.
find_program(HELP2MAN help2man)
find_program(GZIP gzip)
if(NOT HELP2MAN OR NOT GZIP)
  message("No manual pages without help2man and gzip. Install them with: apt-get install help2man gzip")
  return()
endif()
set(folder $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share/man/man1)
file(MAKE_DIRECTORY ${folder})

# terracut_man_page(NAME ABOUT command-line...)
function(terracut_man_page name about)
  list(JOIN ARGN " " command)
  string(TOUPPER ${name} title)
  # Its own title is the program's, and its name of a command has a blank.
  execute_process(COMMAND ${HELP2MAN} --no-info --version-string=${VERSION} --name=${about} ${command}
    COMMAND sed "2s/TERRACUT/${title}/; 4s/^terracut[ a-z]* .-/${name} \\\\-/" COMMAND ${GZIP} -9n
    OUTPUT_FILE ${folder}/${name}.1.gz COMMAND_ERROR_IS_FATAL ANY)
endfunction()

terracut_man_page(terracut "real-time LiDAR ground segmentation" ${PROGRAM})
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\nSubcommands:(.*)\n\n.*" "\\1" help "${help}")
string(REGEX REPLACE "\n   +" " " help "${help}")
string(REGEX REPLACE "[.;] [^\n]*" "" help "${help}")  # a page's name has one sentence
string(REGEX MATCHALL "\n  [a-z]+ +[^\n]+" commands "${help}")
foreach(command IN LISTS commands)
  string(REGEX MATCH "^\n  ([a-z]+) +(.*)$" command "${command}")
  terracut_man_page(terracut-${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" ${PROGRAM} ${CMAKE_MATCH_1})
endforeach()
