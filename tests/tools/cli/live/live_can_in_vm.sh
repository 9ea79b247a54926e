#!/bin/sh
# What can_bus_vm.cmake runs in the virtual machine, with busybox and can-utils: a whole `terracut
# live` on a real CAN interface. Every step waits for what it is about; the machine is slow.
set -e
cd /tmp
mkdir -p /dev/shm
mount -t tmpfs shm /dev/shm

say() { read -r up rest </proc/uptime; echo "live_can $up s: $*"; }
# The figures that another process sees, as of the last look().
look() { /app/terracut top live --print-json >figures 2>/dev/null || true; }
# The last number behind a name: the CAN bus comes last.
figure() { busybox sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p" figures | tail -n 1; }
state() { busybox sed -n '/"motion"/,$ s/.*"state": "\([a-z_]*\)".*/\1/p' figures; }
wait_until() { # for what, command
  for i in $(seq 400); do
    look
    if eval "$2"; then say "$1"; return 0; fi
    sleep 0.1
  done
  say "never came: $1"; cat live.err; /app/terracut top live --once; exit 1
}
more_frames() { # name, how many more than now
  frames_before=$(figure "$1")
  wait_until "$2 more $1" "[ \"\$(figure $1)\" -ge $((frames_before + $2)) ]"
}

unpack_cargo # by live_can_drive.py
# The drive's motion, which is even, for as long as the test takes.
data=$(busybox sed -n 's/.* //p;q' drive.can.log)
busybox awk -v data="$data" 'BEGIN { for (i = 0; i < 30000; i++) printf "(%.6f) can0 %s\n", 1700000000 + i / 100, data }' >car.log
drive() { canplayer -I car.log vcan0=can0 >/dev/null 2>&1 & car=$!; }

# The car is a program without priority on a slow machine, and kept from its cores for longer than a
# car's bus would be silent.
cat >slow.yaml <<END
motion:
  max_age_ms: 1000
  timeout_ms: 1000
END
candump -L vcan1,6D0:7FE >health &
candump=$!
# The sensor waits for nobody. Where its packets are late, clocks seem to have been set, and frames are
# not deskewed.
/app/chrt -f 90 /app/terracut send drive.pcap --to 127.0.0.1:2368 --loop 0 >/dev/null 2>&1 &
sensor=$!
/app/terracut live --config slow.yaml --listen 127.0.0.1:2368 --name live --metrics off --no-lock-memory \
  --deadline 10000 --patience 60 --columns 520 --calibration drive.calibration.xml --json live.json \
  --can vcan0 --dbc drive.can.dbc --health-can vcan1 >live.out 2>live.err &
live=$!
wait_until 'frames before the vehicle is heard' '[ "$(state)" = waiting ] && [ "$(figure no_ego_motion_frames)" -ge 1 ]'

drive
wait_until 'the motion is known' '[ "$(state)" = known ]'
more_frames deskewed_frames 3

cansend vcan0 20000040#0000000000000000
wait_until 'the controller left the bus' '[ "$(figure bus_off)" -ge 1 ]'

ip link set vcan0 down
kill $car 2>/dev/null || true
wait_until 'the interface is down' '[ "$(state)" = interface_down ]'
more_frames no_ego_motion_frames 2
ip link del vcan0
wait_until 'the interface is gone' '[ "$(state)" = interface_gone ]'
ip link add dev vcan0 type vcan
ip link set vcan0 mtu 72
ip link set vcan0 up
drive
wait_until 'the motion is known again' '[ "$(state)" = known ]'
more_frames deskewed_frames 2

before_flood=$(figure samples) spare_before=$(figure spare_samples) without_before=$(figure no_ego_motion_frames)
cangen vcan0 -g 0 -p 10 -I 1A0 -L 8 -D "${data#*#}" -n 4000 &
flood=$!
more_frames deskewed_frames 2
wait $flood
more_frames deskewed_frames 2
say "a flood of 4000 frames: $(($(figure samples) - before_flood)) samples, \
$(($(figure spare_samples) - spare_before)) spare, $(figure kernel_drops) dropped by the kernel, \
$(($(figure no_ego_motion_frames) - without_before)) frames without ego motion"

kill -TERM $live
wait $live || [ $? = 6 ] # frames may be missed on so slow a machine
kill $candump $sensor $car || true
cat live.out
cat health
echo "summary-begin"
cat live.json
echo "summary-end"
