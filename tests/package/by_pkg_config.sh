#!/usr/bin/env bash
# Hosts find the installed package through pkg-config, static and shared, and run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work="$place/by pkg-config"
mkdir "$work"
cp "$SOURCE/tests/package/consumer/main.cpp" "$work"
cd "$work"
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name nearfield.pc)")
export PKG_CONFIG_PATH

# pkg-config escapes its output for a shell, so a shell must parse it.
declare -a compile static shared
eval "compile=($(pkg-config --cflags nearfield))"
eval "shared=($(pkg-config --libs nearfield))"
eval "static=($(pkg-config --libs --static nearfield))"
# Both libraries have the same name; this selects the archive.
static=("${static[@]/#-lnearfield/-l:libnearfield.a}")

"$CXX" -std=c++20 -fno-exceptions -fno-rtti "${compile[@]}" main.cpp -o static_host "${static[@]}"
"$CXX" -std=c++20 -DVK_NO_PROTOTYPES "${compile[@]}" main.cpp -o shared_host "${shared[@]}"
names_nothing_of_the_project "$work"

printf 'static: '
./static_host
library=$(dirname "$(find "$prefix" -name libnearfield.so)")
printf 'shared: '
LD_LIBRARY_PATH=$library ./shared_host
needs_shared static_host no
needs_shared shared_host yes
