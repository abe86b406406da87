# Boards for a test: hosts in namespaces, each with its own network, host name, uptime, process table and files,
# joined by a bridge, and reached from outside. Source it, call own_namespaces "$@" first, then: board NAME NUMBER UPTIME_S,
# on NAME COMMAND..., unplug NAME. $work/ssh NAME COMMAND... works like ssh.

# Starts the script again in new namespaces. These end with the script, and all boards with them.
own_namespaces() {
    if [ -z "${IN_NAMESPACES:-}" ]; then
        unshare --net --mount --pid --fork --uts true 2>/dev/null ||
            { echo "no network, mounts and processes of its own are permitted here"; exit 77; }
        IN_NAMESPACES=yes exec unshare --net --mount --pid --fork --kill-child --mount-proc -- "$0" "$@"
    fi
    work=$(mktemp -d)
    mount -t tmpfs tmpfs "$work"
    mount -t tmpfs tmpfs /run
    printf '#!/bin/bash\nname=$1\nshift\nexec nsenter --target "$(<"%s/$name.init")" --all -- "$@"\n' "$work" >"$work/ssh"
    chmod +x "$work/ssh"
    cp -a /etc "$work/etc" && mkdir -p "$work/etc/lockstep" && mount --bind "$work/etc" /etc
    ip link set lo up
    ip link add eth0 type bridge mcast_snooping 0  # as on the boards: the machine's file names one interface
    ip addr add 10.9.0.1/24 dev eth0
    ip link set eth0 up
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
        while :; do sleep 3600 & wait; done' board "$name" "$work/$name.pid" </dev/null 2>/dev/null &
    local outside=$!
    read -r _ <"$work/$name.pid"
    pgrep -P "$outside" >"$work/$name.init"
    ip link add "to-$name" type veth peer name eth0 netns "$(<"$work/$name.init")"
    ip link set "to-$name" master eth0 up
    on "$name" ip link set lo up
    on "$name" ip link set eth0 up
    on "$name" ip addr add "10.9.0.$number/24" dev eth0
}

on() { "$work/ssh" "$@"; }  # NAME COMMAND...

# Like a power cut: none of its processes can shut down.
unplug() {  # NAME
    local first
    first=$(<"$work/$1.init")
    kill -KILL "$first"
    while [ -e "/proc/$first" ]; do sleep 0.05; done
    ip link del "to-$1" 2>/dev/null || true
}
