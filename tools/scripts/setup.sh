#!/usr/bin/env bash
# Installs the missing Debian packages.
#   setup.sh run    to build and run the command line
#   setup.sh view   to build and run the live viewer, and for videos of simulations
#   setup.sh test   all of these, and for the tests and checks
#   setup.sh bench  to build and run the benchmark against other libraries
#   setup.sh bits   to compare answers by other compilers and on aarch64 (same_bits.sh)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

run_packages=(
    cmake ninja-build g++ pkg-config glslang-tools
    libvulkan-dev libvulkan1 mesa-vulkan-drivers
    libeigen3-dev libhwy-dev libcli11-dev nlohmann-json3-dev libpugixml-dev libcairo2-dev fonts-dejavu-core
)
viewer_packages=(libsdl2-dev libimgui-dev ffmpeg)
test_packages=(
    "${viewer_packages[@]}"
    libgtest-dev libbenchmark-dev libgeos-dev vulkan-validationlayers chromium-common clang clang-format clang-tidy
    libfreetype-dev fonts-inter-variable fonts-ebgaramond
    doxygen dpkg-dev file gdb python3
)
# The libraries that the examples use, and an X server for all windows.
test_packages+=(
    qt6-base-dev qt6-base-private-dev qt6-declarative-dev qml6-module-qtquick
    qml6-module-qtquick-window qml6-module-qtqml-workerscript xvfb xauth
)
bench_packages=(
    libgeos-dev libboost-dev libcgal-dev libpolyclipping-dev libbox2d-dev
)
bits_packages=(clang g++-aarch64-linux-gnu qemu-user)

case "$*" in
    run) wanted=("${run_packages[@]}") ;;
    view) wanted=("${run_packages[@]}" "${viewer_packages[@]}") ;;
    test) wanted=("${run_packages[@]}" "${test_packages[@]}") ;;
    bench) wanted=("${run_packages[@]}" "${bench_packages[@]}") ;;
    bits) wanted=("${run_packages[@]}" "${bits_packages[@]}") ;;
    *) die "usage: setup.sh run|view|test|bench|bits" ;;
esac

for tool in apt-get dpkg-query; do
    command -v "$tool" >/dev/null ||
        die "this system has no $tool; install what matches these Debian packages and run" \
            "again with --no-setup: ${wanted[*]}"
done

is_installed() {
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing=()
for package in "${wanted[@]}"; do
    is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    echo "all ${#wanted[@]} packages are installed"
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null ||
        die "root rights are needed to install: ${missing[*]}; run as root, install sudo," \
            "or install them and run again with --no-setup"
    as_root=(sudo)
fi
echo "missing: ${missing[*]}"
"${as_root[@]}" apt-get update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "${missing[@]}"
