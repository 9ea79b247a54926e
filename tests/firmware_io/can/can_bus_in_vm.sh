#!/bin/sh
# What can_bus_vm.cmake runs in the virtual machine, with busybox and nothing else.
set -e
# candump has to listen before anything is sent: the kernel's list of listeners shows that it does.
timeout 120 candump -L -n 10 vcan0,6D0:7FE >/tmp/seen &
candump=$!
until cat /proc/net/can/rcvlist_* | grep -q 'vcan0  *[0-9a-f]'; do sleep 0.1; done
# On one processor, whose queue keeps the order of what is sent.
busybox taskset 1 /app/can_bus_trial --gtest_filter='*Health*'
wait $candump
cat /tmp/seen
/app/can_bus_trial --gtest_filter='-*Health*'
