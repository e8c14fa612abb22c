#!/usr/bin/env bash
# Runs the README's commands as a newcomer would: in an empty Debian 12, in the order of the README,
# on a clone of the last commit in a folder whose name contains a space.
#   fresh.sh [--keep FOLDER] [NAME...]
# NAME: run, view, test or check, for those commands only. The empty system lives in memory and in
# its own mount namespace, so nothing of it remains afterwards. --keep puts it into a new folder
# instead, which remains. Needs root privileges, debootstrap, Xvfb for the viewer, and the machine's
# own package sources, which the empty system uses too.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly release=bookworm
readonly needed_megabytes=12000  # packages, three builds, and the compilers at work
readonly clone="/root/near field"
readonly usage="usage: fresh.sh [--keep FOLDER] [run|view|test|check...]"

# The README's commands, one per line, as written there.
readme_commands() {
    sed -n 's|^\(tools/scripts/[a-z]*\.sh\) *#.*|\1|p' "$root/README.md"
}

# wanted_commands NAME...: the commands with these names, in the README's order; all if there are no
# names.
wanted_commands() {
    local name command
    for name in "$@"; do
        readme_commands | grep --quiet --fixed-strings --line-regexp "tools/scripts/$name.sh" ||
            die "README.md has no command $name; $usage"
    done
    while read -r command; do
        name=$(basename "$command" .sh)
        [[ $# -gt 0 && " $* " != *" $name "* ]] || printf '%s\n' "$command"
    done < <(readme_commands)
}

require_means() {
    ((EUID == 0)) || die "an empty system can be made with root rights only"
    command -v debootstrap >/dev/null || die "there is no debootstrap (Debian package debootstrap)"
    command -v git >/dev/null || die "there is no git to clone with (Debian package git)"
    unshare --mount --pid --fork true || die "this machine allows no mount namespace of its own"
    [[ $commands != *view.sh* ]] || command -v Xvfb >/dev/null ||
        die "there is no Xvfb for the viewer's window (Debian package xvfb)"
    [[ -z $(git -C "$root" status --porcelain) ]] ||
        echo "not committed, so not part of this: $(git -C "$root" status --porcelain | wc -l) files"
}

# The machine's own Debian package source.
mirror() {
    local site
    site=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
        awk -v release="$release" '$2 == release && $3 == "main" {print $1; exit}')
    [[ -n $site ]] || die "the package sources of this machine do not have Debian's $release"
    printf '%s\n' "$site"
}

# make_place FOLDER: creates the place for the system. If the argument is empty: in memory, mounted
# over a folder that exists on every system.
make_place() {
    if [[ -n $1 ]]; then
        system=$1
        return
    fi
    local free
    free=$(awk '/^MemAvailable:/{print int($2 / 1024)}' /proc/meminfo)
    ((free >= needed_megabytes)) ||
        die "$free MiB of memory are free, and the empty system takes up to $needed_megabytes;" \
            "--keep FOLDER puts it on a disk"
    system=/mnt
    mount -t tmpfs -o "size=${needed_megabytes}m,mode=755" nearfield "$system"
}

make_system() {
    eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
    export http_proxy
    debootstrap --variant=minbase "$release" "$system" "$(mirror)" >/dev/null || {
        tail -n 20 "$system/debootstrap/debootstrap.log"
        die "debootstrap failed"
    }
    rm -rf "$system/etc/apt"
    cp -a /etc/apt "$system/etc/apt"
    cp -a --no-clobber /usr/share/keyrings/. "$system/usr/share/keyrings"
    cp /etc/resolv.conf "$system/etc/resolv.conf"
    mount -t proc proc "$system/proc"
    mount -t sysfs -o ro sysfs "$system/sys"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$system/dev/pts"
    mount -t tmpfs tmpfs "$system/dev/shm"
}

clone_project() {
    git -c safe.directory="$root" clone --quiet --no-hardlinks "$root" "$system$clone"
    echo "commit $(git -c safe.directory='*' -C "$system$clone" rev-parse HEAD)"
    echo "the system: $(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' "$system/etc/os-release")," \
        "$(find "$system/var/lib/dpkg/info" -name '*.list' | wc -l) packages"
}

# Starts an X server outside the system, as on a desktop.
start_display() {
    mkdir -p /tmp/.X11-unix "$system/tmp/.X11-unix"
    mount --bind /tmp/.X11-unix "$system/tmp/.X11-unix"
    exec {numbers}<> <(:)
    Xvfb -displayfd "$numbers" -screen 0 1600x1000x24 -nolisten tcp >/dev/null 2>&1 &
    read -r -t 30 -u "$numbers" number || die "Xvfb does not start"
    display=:$number
}

# in_system COMMAND: runs it there like a login shell, in the clone.
in_system() {
    chroot "$system" /usr/bin/env -i HOME=/root USER=root LANG=C.UTF-8 TERM="${TERM:-dumb}" \
        ${display:+DISPLAY=$display} PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        bash -c "cd '$clone' && $1"
}

run_commands() {
    local command
    while read -r command; do
        # Nobody can close the viewer's window.
        [[ $command != */view.sh ]] || command+=" --frames 120"
        step "In the empty system: $command" in_system "$command" </dev/null
    done <<<"$commands"
}

if [[ ${1-} != --inside ]]; then
    keep=
    if [[ ${1-} == --keep ]]; then
        [[ -n ${2-} && ! -e $2 ]] || die "--keep needs a folder that is not there yet; $usage"
        keep=$(realpath "$2")
        shift 2
    fi
    commands=$(wanted_commands "$@")
    require_means
    exec unshare --mount --propagation private --pid --fork --kill-child --mount-proc \
        "${BASH_SOURCE[0]}" --inside "$keep" "$commands"
fi

keep=$2
commands=$3
display=
make_place "$keep"
step "An empty Debian 12" make_system
step "A clone of the last commit" clone_project
[[ $commands != *view.sh* ]] || start_display
run_commands
# The test counts come last, after all other output.
! [[ -f $system$clone/build/release/test_counts.txt ]] || {
    printf '\n== The tests of the empty system\n'
    cat "$system$clone/build/release/test_counts.txt"
}
[[ -z $keep ]] || echo "kept: chroot '$keep', the clone is in $clone; rm -r it when done"
