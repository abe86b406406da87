# Boards for a test: hosts in namespaces, each with a network, host name, uptime, process table and files of its own,
# joined by a bridge. Source it, call own_world "$@" first, then: board NAME NUMBER UPTIME_S, on NAME COMMAND...,
# unplug NAME.
declare -A init

# Starts the script anew in namespaces that end with it, and take all boards along.
own_world() {
    if [ -z "${OWN_WORLD:-}" ]; then
        unshare --net --mount --pid --fork --uts true 2>/dev/null ||
            { echo "no network, mounts and processes of its own are permitted here"; exit 77; }
        OWN_WORLD=yes exec unshare --net --mount --pid --fork --kill-child --mount-proc -- "$0" "$@"
    fi
    work=$(mktemp -d)
    mount -t tmpfs tmpfs "$work"
    cp -a /etc "$work/etc" && mkdir -p "$work/etc/lockstep" && mount --bind "$work/etc" /etc
    ip link set lo up
    ip link add bridge type bridge mcast_snooping 0
    ip addr add 10.9.0.1/24 dev bridge
    ip link set bridge up
    clocks=yes
    unshare --time --fork --monotonic 5 --boottime 5 true 2>/dev/null ||
        { clocks=; echo "the kernel permits no uptime of a board's own: all have the host's"; }
    trap 'rm -rf "$work"/*; umount "$work"; rmdir "$work"' EXIT
}

board() {  # NAME NUMBER UPTIME_S, beyond the host's own
    local name=$1 number=$2 uptime=$3
    rm -f "$work/$name.pid"
    mkfifo "$work/$name.pid"
    unshare --net --mount --pid --fork --kill-child --uts --mount-proc \
        ${clocks:+--time --monotonic "$uptime" --boottime "$uptime"} -- bash -c '
        hostname "$1"
        for folder in /run /dev/shm /var/lib /etc/lockstep; do mount -t tmpfs tmpfs "$folder"; done
        echo up >"$2"
        while :; do sleep 3600 & wait; done' board "$name" "$work/$name.pid" </dev/null &
    local outside=$!
    read -r _ <"$work/$name.pid"
    init[$name]=$(pgrep -P "$outside")
    ip link add "to-$name" type veth peer name eth0 netns "${init[$name]}"
    ip link set "to-$name" master bridge up
    on "$name" ip link set lo up
    on "$name" ip link set eth0 up
    on "$name" ip addr add "10.9.0.$number/24" dev eth0
    on "$name" ip route add default via 10.9.0.1
}

on() {  # NAME COMMAND...
    local name=$1
    shift
    nsenter --target "${init[$name]}" --all -- "$@"
}

# As by a power cut: nothing on it ends as it would like to.
unplug() {  # NAME
    kill -KILL "${init[$1]}"
    while [ -e "/proc/${init[$1]}" ]; do sleep 0.05; done
    ip link del "to-$1" 2>/dev/null || true
}
