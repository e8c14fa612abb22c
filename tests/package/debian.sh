#!/usr/bin/env bash
# The contents and the dependencies of the Debian packages.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work=$(mktemp --directory)
trap 'rm -r -- "$work"' EXIT
cpack -G DEB --config "$BUILD/CPackConfig.cmake" -B "$work" >"$work/log" || {
    cat "$work/log"
    fail "cpack failed"
}

# file_of PACKAGE: its file.
file_of() { find "$work" -maxdepth 1 -name "$1_*.deb"; }
# has PACKAGE PATTERN: a path in the package matches.
has() {
    local contents
    contents=$(dpkg-deb --contents "$(file_of "$1")")
    grep --quiet --extended-regexp " \./$2( |\$)" <<<"$contents" || fail "$1 lacks $2"
}
# says PACKAGE FIELD PATTERN: a field of its control file matches.
says() {
    local text
    text=$(dpkg-deb --field "$(file_of "$1")" "$2")
    [[ $text =~ $3 ]] || fail "$1: $2 is '$text', which is not '$3'"
}

for package in libnearfield0 libnearfield-dev nearfield; do
    dpkg-deb --info "$(file_of "$package")"
    has "$package" "usr/share/doc/$package/copyright"
    has "$package" "usr/share/doc/$package/changelog.gz"
    ! dpkg-deb --contents "$(file_of "$package")" | grep -v ' root/root ' || fail "$package: not root's"
done
libraries="usr/lib/$(dpkg-architecture --query DEB_HOST_MULTIARCH)"
has libnearfield0 "$libraries/libnearfield\.so\.0 -> libnearfield\.so\.[0-9.]+"
has libnearfield-dev "$libraries/libnearfield\.(so -> libnearfield\.so\.0|a)"
has libnearfield-dev "$libraries/libnearfield\.a"
has libnearfield-dev "$libraries/cmake/nearfield/nearfield-config\.cmake"
has libnearfield-dev "$libraries/pkgconfig/nearfield\.pc"
has libnearfield-dev usr/include/nearfield/nearfield\.hpp
has nearfield usr/bin/nearfield
says libnearfield0 Depends 'libc6.*libhwy1.*libstdc\+\+6'
says libnearfield-dev Depends 'libnearfield0 \(= [0-9.]+\)'
says libnearfield-dev Depends libvulkan-dev
says nearfield Depends 'libcairo2.*libhwy1'
dpkg-deb --control "$(file_of libnearfield0)" "$work/control"
[[ -f $work/control/triggers ]] || fail "libnearfield0 does not have the linker look again"
grep --quiet '^libnearfield 0 libnearfield0' "$work/control/shlibs" || fail "libnearfield0 has no shlibs"

mkdir "$work/all"
for package in libnearfield0 libnearfield-dev nearfield; do
    dpkg-deb --extract "$(file_of "$package")" "$work/all"
done
names_nothing_of_the_project "$work/all"
