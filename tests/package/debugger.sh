#!/usr/bin/env bash
# gdb's pretty printers, in a program stopped where every type has a value.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work=$(mktemp --directory)
trap 'rm -r -- "$work"' EXIT
"$CXX" -std=c++20 -g -O0 "-I$SOURCE/include" "$SOURCE/tests/package/debugged.cpp" \
    "$SOURCE/engine/base/status.cpp" -o "$work/debugged"

commands=(-ex 'set debuginfod enabled off' -ex "source $SOURCE/tools/debug/nearfield_gdb.py"
    -ex 'set print pretty off' -ex 'break look' -ex run)
names=(vector none shape query ticket feature success error value no_value)
for name in "${names[@]}"; do
    commands+=(-ex "printf \"$name: \"" -ex "output $name" -ex 'printf "\n"')
done
gdb --batch --nx "${commands[@]}" "$work/debugged" >"$work/output" 2>&1

sed -n 's/^\([a-z_]*: \)@0x[0-9a-f]*: /\1/; /^[a-z_]*: /p' "$work/output" >"$work/shown"
diff "$work/shown" - <<'EXPECTED' || { cat "$work/output"; fail "gdb shows something else"; }
vector: (1.5, -2)
none: no shape
shape: shape 7, generation 2
query: ContactQuery 3 of its batch
ticket: ticket 9
feature: vertex 4
success: ok
error: unsupported_device: "no such device" = {reason 0 = "no queue", reason 1 = "no memory"}
value: value = {value = shape 7, generation 2}
no_value: error = {error = unsupported_device: "no such device" = {reason 0 = "no queue", reason 1 = "no memory"}}
EXPECTED
