# Boots a small virtual machine whose kernel has CAN, runs the script COMMANDS with PROGRAM in it on
# virtual CAN interfaces, and has READER compare the health frames that candump saw there, by the
# file DBC, with what else the script printed. FOLDER is for what it printed. CARGO, where there is
# one, is a script that PROGRAM and a folder are given to: what it writes there, `unpack_cargo` in
# COMMANDS unpacks in the machine.
cmake_minimum_required(VERSION 3.22)
if(NOT EXISTS ${VM_SCRIPT})
  message("skipped: ../shared/tools/vcan_vm.sh, which boots the machine, is not there")
  return()
endif()
foreach(tool bash qemu-system-x86_64 busybox candump chrt cpio apt-get python3)
  find_program(path_of_${tool} ${tool})
  if(NOT path_of_${tool})
    message("skipped: ${tool} is not installed (./tools/setup --all installs it)")
    return()
  endif()
endforeach()
# A Python that has canmatrix, if there is one: the first of the path need not be the distribution's.
set(python ${path_of_python3})
execute_process(COMMAND /usr/bin/python3 -c "import canmatrix"
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  set(python /usr/bin/python3)
endif()

file(READ ${COMMANDS} commands)
if(DEFINED CARGO)
  # The machine's script takes programs alone: the files ride behind the program.
  set(cargo ${FOLDER}/cargo)
  file(REMOVE_RECURSE ${cargo})
  file(MAKE_DIRECTORY ${cargo})
  execute_process(COMMAND ${python} ${CARGO} ${PROGRAM} ${cargo} COMMAND_ERROR_IS_FATAL ANY)
  get_filename_component(name ${PROGRAM} NAME)
  execute_process(COMMAND tar -C ${cargo} --exclude *.truth -cf ${FOLDER}/cargo.tar .
    COMMAND_ERROR_IS_FATAL ANY)
  file(SIZE ${FOLDER}/cargo.tar bytes)
  execute_process(COMMAND cat ${PROGRAM} ${FOLDER}/cargo.tar OUTPUT_FILE ${cargo}/${name}
    COMMAND_ERROR_IS_FATAL ANY)
  file(CHMOD ${cargo}/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  set(PROGRAM ${cargo}/${name})
  string(PREPEND commands "unpack_cargo() { busybox tail -c ${bytes} /app/${name} | busybox tar x; }\n")
endif()
execute_process(
  COMMAND ${path_of_bash} ${VM_SCRIPT} -t 1100 -m 512 -s 2 -a ${PROGRAM} -a ${path_of_chrt} -c "${commands}"
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")
if(NOT output MATCHES "VM-UP")
  # The script keeps the kernel where it was unpacked once.
  if(DEFINED ENV{XDG_CACHE_HOME})
    set(cache $ENV{XDG_CACHE_HOME})
  else()
    set(cache $ENV{HOME}/.cache)
  endif()
  if(NOT EXISTS ${cache}/vcan_vm/kernel-std/.ok)
    message("skipped: the kernel's package could not be downloaded")
    return()
  endif()
  message(FATAL_ERROR "the virtual machine did not come up: ${result}")
endif()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the trial failed in the virtual machine: ${result}")
endif()

file(WRITE ${FOLDER}/console.txt "${output}")
execute_process(COMMAND ${python} ${READER} ${DBC} ${FOLDER}/console.txt
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the health frames are not what was sent")
endif()
