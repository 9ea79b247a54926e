# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
# Builds and installs the ROS 2 package by itself, as colcon does, where ament_cmake is installed:
# cmake -DPACKAGE=... -DPROGRAM=... -DFOLDER=... -P build_test.cmake
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${text}")
  endif()
endfunction()
execute_process(COMMAND ${CMAKE_COMMAND} -S ${PACKAGE} -B ${FOLDER}/build
    -DTERRACUT_PROGRAM=${PROGRAM} -DCMAKE_INSTALL_PREFIX=${FOLDER}/install
  RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(text MATCHES "Could not find a package configuration file provided by \"ament_cmake\"")
  message("skipped: ament_cmake is not installed")
  return()
elseif(NOT result EQUAL 0)
  message(FATAL_ERROR "the package is not configured: ${text}")
endif()
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${CMAKE_COMMAND} --install ${FOLDER}/build)

foreach(path
    share/ament_index/resource_index/packages/terracut_ros
    share/terracut_ros/package.xml
    share/terracut_ros/launch/terracut.launch.py
    share/terracut_ros/config/node.yaml
    share/terracut_ros/nav2/costmap.yaml
    share/terracut_ros/layouts/terracut.rviz
    lib/terracut_ros/terracut)
  if(NOT EXISTS ${FOLDER}/install/${path})
    message(FATAL_ERROR "the package installs no ${path}")
  endif()
endforeach()
# `ros2 run terracut_ros terracut`
run(${FOLDER}/install/lib/terracut_ros/terracut
    --config ${FOLDER}/install/share/terracut_ros/config/node.yaml config)
