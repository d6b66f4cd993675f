# Sourced by the ROS scripts after common.sh: gives the nodes a ROS network of their own on this machine, and ends what was
# started in it, and nothing else.

# ros_network LOG_FOLDER: a master's address that nobody uses, and the packages that were built.
ros_network() {
  local port
  port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
  mkdir -p "$1"
  set +u # catkin's file asks for variables that may not be set
  # shellcheck disable=SC1091
  source build/release/devel/setup.bash
  set -u
  export ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:$port ROS_LOG_DIR=$1 ROS_HOME=$1
  unset ROS_IP ROS_NAMESPACE
  ros_port=$port
}

# ros_start LOG_FILE COMMAND...: runs in the background, on its own; its process id is in ros_pid.
ros_pids=()
ros_start() {
  local log=$1
  shift
  setsid env --default-signal=INT "$@" >"$log" 2>&1 </dev/null & # bash would have them ignore it
  ros_pid=$!
  ros_pids+=("$ros_pid")
}

# Processes of this network: those that were started with its master's address.
ros_processes() {
  local file
  for file in /proc/[0-9]*/environ; do
    if { tr '\0' '\n' <"$file"; } 2>/dev/null | grep -qxF -e "ROS_MASTER_URI=$ROS_MASTER_URI" -e "ROS_MASTER_URI=$ROS_MASTER_URI/"; then
      file=${file#/proc/}
      file=${file%/environ}
      [[ $file != "$$" && $file != "$BASHPID" ]] && echo "$file"
    fi
  done
}

# ros_stop PID [SECONDS]: asks for an end, and waits for it.
ros_stop() {
  local i
  kill -INT "$1" 2>/dev/null || return 0
  for ((i = 0; i < ${2:-20} * 10; ++i)); do
    kill -0 "$1" 2>/dev/null || return 0
    sleep 0.1
  done
}

# Ends everything that ros_start began, and what that left behind.
ros_end() {
  local pid
  ((${#ros_pids[@]})) || return 0
  for pid in "${ros_pids[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  for pid in "${ros_pids[@]}"; do ros_stop "$pid"; done
  for pid in $(ros_processes); do kill -KILL "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  ros_pids=()
}

# ros_wait_for_master: until the master answers.
ros_wait_for_master() {
  local i
  for ((i = 0; i < 300; ++i)); do
    rosparam list >/dev/null 2>&1 && return 0
    sleep 0.2
  done
  fail "the ROS master did not start"
}

# ros_wait_for_file FILE: until it is there.
ros_wait_for_file() {
  local i
  for ((i = 0; i < 300; ++i)); do
    [[ -e $1 ]] && return 0
    sleep 0.2
  done
  fail "$1 did not come"
}
